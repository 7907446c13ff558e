#include <fmt/format.h>

#include "condyle/io/mesh_file.hpp"
#include "condyle/io/model_file.hpp"
#include "io/motion/motion_text.hpp"
#include "support/test.hpp"

/// Ranges and locks of a model's coordinates, and bounds of its layers: they change nothing, and what contradicts them is noted.

namespace condyle {
namespace {

/// The axes of a hip whose coordinates are columns of the joint file, and of one that the model poses.
constexpr std::string_view by_columns = "0 0 1,1 0 0,0 1 0", by_model = "1 0 0,0 0 1,0 1 0";

class ModelLimits : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"pelvis.ply", "femur.ply"})
      io::write_mesh(folder_.path() / name, test::box({-0.02, -0.03, -0.02}, {0.03, 0.02, 0.01}));
  }

  io::Model model(std::string_view axes, std::string_view flexion, std::string_view rotation,
                  std::string_view more = "") const {
    std::string joint;
    constexpr const char* names[] = {"flex", "add", "rot"};
    for (std::size_t i = 0; i < 3; ++i)
      joint += fmt::format(
          R"(<TransformAxis name="rotation{}"><coordinates>{}</coordinates><axis>{}</axis></TransformAxis>)",
          i + 1, names[i], axes.substr(6 * i, 5));
    return io::read_model(folder_.file("model.osim", fmt::format(
                                                         R"(<?xml version="1.0"?>
<OpenSimDocument Version="40500"><Model name="limits"><BodySet><objects>
<Body name="pelvis"><attached_geometry><Mesh name="p"><mesh_file>pelvis.ply</mesh_file></Mesh></attached_geometry></Body>
<Body name="femur_r"><attached_geometry><Mesh name="f"><mesh_file>femur.ply</mesh_file></Mesh></attached_geometry></Body>
</objects></BodySet><JointSet><objects><CustomJoint name="hip_r"><socket_parent_frame>/bodyset/pelvis</socket_parent_frame>
<socket_child_frame>/bodyset/femur_r</socket_child_frame><coordinates><Coordinate name="flex">{}</Coordinate>
<Coordinate name="add"/><Coordinate name="rot">{}</Coordinate></coordinates>
<SpatialTransform>{}</SpatialTransform></CustomJoint></objects></JointSet>{}</Model></OpenSimDocument>)",
                                                         flexion, rotation, joint, more)));
  }

  static io::MotionTable table(std::vector<double> flexion, std::vector<double> rotation) {
    const std::vector<double> zero(flexion.size());
    return test::motion_table({"flex", "add", "rot"}, {std::move(flexion), zero, std::move(rotation)});
  }

  static std::vector<std::string> notes_of(const io::Model& model, const io::MotionTable& table) {
    const io::LoadedJoint loaded = io::read_joint(model, {.joint = "hip_r", .joint_file = {}});
    std::vector<std::string> notes;
    for (const motion::ContactNote& note : io::motion_of(loaded, table).notes)
      notes.push_back(fmt::format("{}: {}", name_of(note.code), note.text));
    return notes;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(ModelLimits, AreNotedTheSameByColumnsAndByTheModel) {
  const std::vector<std::string> wanted = {
      "beyond_range: coordinates leave the ranges that the model gives them, and are used as they are: "
      "'hip_r/flex', -57.2958 to 85.9437 degrees, in 2 of 5 frames by up to 28.65",
      "locked_coordinate: coordinates that the model locks have other values, and are used as they are: "
      "'hip_r/rot', at 5.72958 degrees, in 1 of 5 frames by up to 11.46"};
  const io::MotionTable recorded = table({0, 1.5, 2, std::nan(""), -1.1}, {0.1, 0.1, 0.3, 0.1, 0.1});
  for (const std::string_view axes : {by_columns, by_model}) {
    SCOPED_TRACE(axes);
    const io::Model limited =
        model(axes, "<range>-1 1.5</range>", "<default_value>0.1</default_value><locked>true</locked>");
    EXPECT_EQ(notes_of(limited, recorded), wanted);
    // The same poses as without.
    const auto poses = [&](const io::Model& of) {
      return io::motion_of(io::read_joint(of, {.joint = "hip_r", .joint_file = {}}), recorded).X_FM;
    };
    const auto with = poses(limited), without = poses(model(axes, "", ""));
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i) {
      ASSERT_EQ(with[i].has_value(), without[i].has_value());
      if (with[i]) {
        EXPECT_TRUE(with[i]->isApprox(*without[i], 1e-15));
      }
    }
  }
}

TEST_F(ModelLimits, AreNotNotedOfWhatAFileRounds) {
  // 120 degrees are written as 2.0943951, and a locked column holds its default in as many digits.
  const io::MotionTable rounded = table({120 * std::numbers::pi / 180, 2.09439510}, {0.1, 0.10000001});
  for (const std::string_view axes : {by_columns, by_model})
    EXPECT_EQ(notes_of(model(axes, "<range>2.0943951 -2.0943951</range>",
                             "<default_value>0.1</default_value><locked>true</locked>"),
                       rounded),
              std::vector<std::string>{});
}

TEST_F(ModelLimits, HoldForWhatStandsInForAColumn) {
  io::MotionTable without = table({0.1, 0.2}, {0, 0});
  without.columns.pop_back(), without.values.pop_back();
  for (const std::string_view axes : {by_columns, by_model}) {
    const auto notes = notes_of(
        model(axes, "", "<default_value>2</default_value><range>-1 1</range><locked>true</locked>"), without);
    ASSERT_EQ(notes.size(), 1u) << "locked there, and so it is";
    test::expect_says(notes[0], "'hip_r/rot', -57.2958 to 57.2958 degrees, in 2 of 2 frames");
  }
}

TEST_F(ModelLimits, OfForcesAreShownAndPlaceNothing) {
  const auto force = [](const char* element, const char* coordinate, double lower, double upper,
                        const char* more = "") {
    return fmt::format(
        "<{0} name=\"f\"><coordinate>{1}</coordinate><lower_limit>{2}</lower_limit><upper_limit>{3}"
        "</upper_limit>{4}</{0}>",
        element, coordinate, lower, upper, more);
  };
  const io::Model held =
      model(by_columns, "", "",
            "<ForceSet><objects>" + force("CoordinateLimitForce", "flex", -30, 120) +
                force("CoordinateLinearStopForce", "/jointset/hip_r/flex", -1, 1) +
                force("CoordinateLimitForce", "rot", -1, 1, "<appliesForce>false</appliesForce>") +
                force("CoordinateLimitForce", "add", -1, 1, "<isDisabled>true</isDisabled>") +
                "</objects></ForceSet>");
  const auto& coordinates = io::joint_named(held, "hip_r").coordinates;
  // Degrees of one, radians of the other, and the narrowest of both.
  ASSERT_TRUE(coordinates[0].stop);
  EXPECT_NEAR((*coordinates[0].stop)[0], -std::numbers::pi / 6, 1e-15);
  EXPECT_EQ((*coordinates[0].stop)[1], 1);
  EXPECT_FALSE(coordinates[1].stop || coordinates[2].stop);
  EXPECT_EQ(held.ignored.at("CoordinateLimitForce"), 3u);
  EXPECT_EQ(held.ignored.at("CoordinateLinearStopForce"), 1u);
  const std::string toml =
      io::propose_joint(held, {.joint = "hip_r", .joint_file = folder_.path() / "hip.toml"}).proposal.toml;
  test::expect_says(toml, "# flex: held from -30 to 57.2958 deg by a force\n");
}

TEST_F(ModelLimits, StandInTheJointFileAndAreReadBack) {
  const io::ModelJointProposal proposal = io::propose_joint(
      model(by_columns, "<range>-1 1.5</range>", "<default_value>0.1</default_value><locked>true</locked>"),
      {.joint = "hip_r", .joint_file = folder_.path() / "hip.toml"});
  test::expect_says(proposal.proposal.toml, "range = [-57.29577951308232, 85.94366926962348] }");
  const auto columns = std::get<std::vector<io::ColumnOfCoordinate>>(
      *io::read_joint_file(folder_.file("hip.toml", proposal.proposal.toml)).recorded_motion);
  ASSERT_EQ(columns.size(), 3u);
  EXPECT_EQ(columns[0].range, (std::array{-57.29577951308232, 85.94366926962348}));
  EXPECT_FALSE(columns[0].is_locked || columns[1].range);
  EXPECT_TRUE(columns[2].is_locked);
}

TEST_F(ModelLimits, WithoutEndsAreHugeNumbersThatAJointFileHolds) {
  const io::Model endless = model(by_columns, "<range>-1e308 1e308</range>", "");
  EXPECT_EQ(notes_of(endless, table({0, 100}, {0, 0})),
            std::vector<std::string>{"unlikely_angle: flexion reaches 5730 degrees, more than two turns: is "
                                     "its column in degrees, and read as radians?"});
}

TEST_F(ModelLimits, OfAnglesInTheWrongUnitAreNotedByTheModelToo) {
  for (const std::string_view axes : {by_columns, by_model}) {
    const auto notes = notes_of(model(axes, "", ""), table({0, 60}, {0, 0}));
    ASSERT_EQ(notes.size(), 1u) << axes;
    EXPECT_EQ(notes[0].find("unlikely_angle: "), 0u) << notes[0];
  }
}

// A layer that is measured.

constexpr std::string_view cartilages = R"(<ContactGeometrySet><objects>
<Smith2018ContactMesh name="a"><socket_frame>/bodyset/pelvis</socket_frame><mesh_file>pelvis.ply</mesh_file><elastic_modulus>1e7</elastic_modulus>
<poissons_ratio>0.45</poissons_ratio><thickness>0.003</thickness></Smith2018ContactMesh>
<Smith2018ContactMesh name="b"><socket_frame>/bodyset/femur_r</socket_frame><mesh_file>femur.ply</mesh_file><elastic_modulus>1e7</elastic_modulus>
<poissons_ratio>0.45</poissons_ratio><use_variable_thickness>true</use_variable_thickness><mesh_back_file>inner.ply</mesh_back_file>
<min_thickness>{}</min_thickness><max_thickness>{}</max_thickness></Smith2018ContactMesh></objects></ContactGeometrySet>
<ForceSet><objects><Smith2018ArticularContactForce name="k"><socket_casting_mesh>/contactgeometryset/b</socket_casting_mesh>
<socket_target_mesh>/contactgeometryset/a</socket_target_mesh><max_proximity>{}</max_proximity></Smith2018ArticularContactForce></objects></ForceSet>)";

class ModelLayers : public ModelLimits {
 protected:
  void SetUp() override {
    ModelLimits::SetUp();
    // Concentric balls: 4 mm from one to the other everywhere.
    io::write_mesh(folder_ / "femur.ply", test::scaled_by(test::sphere({0, 0, 0}, 24, 3), 0.001));
    io::write_mesh(folder_ / "inner.ply", test::scaled_by(test::sphere({0, 0, 0}, 20, 3), 0.001));
  }
  io::Model with(std::string_view least, std::string_view greatest, std::string_view reach = "0.02") const {
    return model(by_columns, "", "", fmt::format(fmt::runtime(cartilages), least, greatest, reach));
  }
  static std::vector<motion::ContactNote> layer_notes(const io::Model& model) {
    const io::LoadedJoint loaded = io::read_joint(model, {.joint = "hip_r", .joint_file = {}});
    const io::ContactEntry& entry = *loaded.report.file.contact;
    const io::ContactSurfaces surfaces = io::surfaces_of(entry, loaded.joint);
    return motion::check_layers(surfaces.fixed.mesh, surfaces.mobile.mesh,
                                io::elastic_options(entry, surfaces, loaded));
  }
  static std::string refusal(const io::Model& model) {
    return test::complaint_of<FileError>(
        [&] { io::propose_joint(model, {.joint = "hip_r", .joint_file = {}}); });
  }
};

TEST_F(ModelLayers, BeyondTheirBoundsAreNoted) {
  const auto has = [&](const io::Model& model, motion::ContactNoteCode code) {
    const auto notes = layer_notes(model);
    return std::any_of(notes.begin(), notes.end(),
                       [&](const motion::ContactNote& note) { return note.code == code; });
  };
  EXPECT_FALSE(has(with("0.001", "0.01"), motion::ContactNoteCode::thickness_beyond_bounds));
  EXPECT_TRUE(has(with("0.001", "0.003"), motion::ContactNoteCode::thickness_beyond_bounds));
  EXPECT_TRUE(has(with("0.005", "0.01"), motion::ContactNoteCode::thickness_beyond_bounds));
}

TEST_F(ModelLayers, OfNumbersThatNoLayerHasAreRefused) {
  test::expect_says(refusal(with("0.005", "0.003")),
                    "min_thickness 0.005 of 'b' must be above 0 and at most max_thickness, 0.003");
  test::expect_says(refusal(with("0", "0.003")), "min_thickness 0 of 'b'");
  test::expect_says(refusal(with("0.001", "0.003", "0")), "max_proximity 0 is not above 0");
}

}  // namespace
}  // namespace condyle
