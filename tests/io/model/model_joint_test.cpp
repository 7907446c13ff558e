#include <fmt/format.h>

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "condyle/io/mesh_file.hpp"
#include "condyle/io/model_file.hpp"
#include "condyle/io/provenance.hpp"
#include "io/model/pose_of_rows.hpp"
#include "io/motion/motion_text.hpp"
#include "support/mesh_bytes.hpp"
#include "support/test.hpp"

// Joint files for joints of models: wherever a joint's coordinates are, they place the child's body where the model does.

namespace condyle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using test::motion_table;

/// The model in a folder of its own, every mesh it names a box of some centimetres.
io::Model with_boxes(const fs::path& file, const fs::path& folder) {
  const fs::path copy = folder / file.filename();
  fs::copy_file(file, copy, fs::copy_options::overwrite_existing);
  const TriMesh box = test::box({-0.02, -0.03, -0.02}, {0.03, 0.02, 0.01});
  for (const io::ModelMesh& mesh : io::read_model(copy).meshes) {
    std::string name = mesh.file;
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path path = folder / "Geometry" / name;
    fs::create_directories(path.parent_path());
    if (fs::exists(path)) continue;
    if (path.extension() == ".vtp")
      io::write_mesh(path, box);
    else
      std::ofstream(path, std::ios::binary) << test::stl_files(box).front().bytes;
  }
  return io::read_model(copy);
}

io::MotionTable table_of(const Json& joint) {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> values(joint["coordinates"].size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    columns.push_back(fmt::format("/jointset/{}/{}/value", joint["joint"].get<std::string>(),
                                  joint["coordinates"][i]["name"].get<std::string>()));
    for (const Json& pose : joint["poses"]) values[i].push_back(pose["q"][i].get<double>());
  }
  return motion_table(std::move(columns), std::move(values));
}

class ModelJoints : public ::testing::TestWithParam<const char*> {};

TEST_P(ModelJoints, PlaceTheChildWhereTheModelDoes) {
  const auto data = test::shared_data();
  if (!data || !fs::exists(*data / GetParam())) GTEST_SKIP() << "no models";
  const fs::path source = *data / GetParam();
  std::ifstream file(source / "reference_poses.json");
  std::size_t joints = 0, by_columns = 0;
  const Json reference = Json::parse(file);
  for (const Json& of_model : reference["models"]) {
    const test::TemporaryFolder folder;
    const io::Model model = with_boxes(source / of_model["model"].get<std::string>(), folder.path());
    for (const Json& expected : of_model["joints"]) {
      if (expected["coordinates"].empty()) continue;
      const auto name = expected["joint"].get<std::string>();
      SCOPED_TRACE(model.path.string() + " " + name);
      io::ModelJointRequest request{.joint = name, .joint_file = {}};
      if (source.filename() == "osim_small") request.anatomy = Anatomy::knee, request.side = Side::left;
      if (name.find("subtalar") != name.npos || name.find("mtp") != name.npos)
        request.anatomy = Anatomy::ankle;
      if (io::meshes_of(model, io::joint_named(model, name), BodyRole::fixed).empty() ||
          io::meshes_of(model, io::joint_named(model, name), BodyRole::mobile).empty())
        continue;
      const io::LoadedJoint loaded = io::read_joint(model, request);
      const io::JointMotion motion = io::motion_of(loaded, table_of(expected));
      const io::Provenance from = io::provenance_of(loaded, {});
      for (std::size_t i = 0; i < motion.X_FM.size(); ++i) {
        const Eigen::Affine3d X =
            from.fixed.source_from_joint * Eigen::Affine3d(*motion.X_FM[i]) * from.mobile.joint_from_source;
        const Pose wanted = test::pose_of_rows(expected["poses"][i]["child_in_parent"]);
        EXPECT_LE((X.matrix() - wanted.matrix()).cwiseAbs().maxCoeff(), 1e-12) << expected["poses"][i]["q"];
      }
      ++joints;
      if (std::holds_alternative<std::vector<io::ColumnOfCoordinate>>(*loaded.report.file.recorded_motion))
        ++by_columns;
    }
  }
  RecordProperty("joints", static_cast<int>(joints));
  EXPECT_GE(joints, 3u);
  EXPECT_GE(by_columns, 1u);
}

INSTANTIATE_TEST_SUITE_P(Models, ModelJoints, ::testing::Values("osim_lenhart2015", "osim_gait2354"),
                         [](const auto& test) { return std::string(test.param); });

// A small model of our own: a pelvis, a femur and a shin, one of each kind of joint.

constexpr std::string_view offset =
    R"(<PhysicalOffsetFrame name="parent"><socket_parent>/bodyset/{0}</socket_parent>
<translation>0.1 -0.2 0.3</translation><orientation>0.1 0.2 -0.3</orientation></PhysicalOffsetFrame>)";

std::string axis(std::string_view name, std::string_view coordinate, std::string_view direction,
                 std::string_view function = "") {
  return fmt::format(
      R"(<TransformAxis name="{}"><coordinates>{}</coordinates><axis>{}</axis>{}</TransformAxis>)", name,
      coordinate, direction, function);
}

std::string coordinates(std::initializer_list<std::string_view> names) {
  std::string text = "<coordinates>";
  for (const std::string_view name : names) text += fmt::format(R"(<Coordinate name="{}"/>)", name);
  return text + "</coordinates>";
}

/// Flexion, adduction and internal rotation.
std::string rotations(std::string_view adducts, std::string_view rotates, std::string_view add = "",
                      std::string_view flex = "") {
  return axis("rotation1", "flex", "0 0 1", flex) + axis("rotation2", "add", adducts, add) +
         axis("rotation3", "rot", rotates);
}

struct Hip {
  std::string joint = rotations("1 0 0", "0 1 0");
  std::string name = "hip_r", body = "femur_r";
  std::string mesh = "<mesh_file>femur.ply</mesh_file>";
  std::string more = "";
  std::string version = "40500";

  std::string text() const {
    return fmt::format(
        R"(<?xml version="1.0"?>
<OpenSimDocument Version="{}"><Model name="small &amp; plain"><!-- one -- comment --><BodySet><objects>
<Body name="pelvis"><attached_geometry><Mesh name="p"><mesh_file>pelvis.ply</mesh_file></Mesh></attached_geometry></Body>
<Body name="{}"><attached_geometry><Mesh name="f">{}</Mesh></attached_geometry></Body>
</objects></BodySet><JointSet><objects><CustomJoint name="{}"><socket_parent_frame>parent</socket_parent_frame>
<socket_child_frame>/bodyset/{}</socket_child_frame>{}<frames>{}</frames>
<SpatialTransform>{}</SpatialTransform></CustomJoint></objects></JointSet>{}</Model></OpenSimDocument>)",
        version, body, mesh, name, body, coordinates({"flex", "add", "rot"}),
        fmt::format(fmt::runtime(offset), "pelvis"), joint, more);
  }
};

class SmallModel : public ::testing::Test {
 protected:
  void SetUp() override {
    const TriMesh box = test::box({-0.02, -0.03, -0.02}, {0.03, 0.02, 0.01});
    io::write_mesh(folder_.path() / "pelvis.ply", box);
    io::write_mesh(folder_.path() / "femur.ply", box);
  }

  fs::path written(const std::string& text) const { return folder_.file("model.osim", text); }
  io::Model model(const Hip& hip) const { return io::read_model(written(hip.text())); }
  io::LoadedJoint loaded(const Hip& hip) const {
    return io::read_joint(model(hip), {.joint = hip.name, .joint_file = {}});
  }
  io::ModelJointProposal proposed(const std::string& text) const {
    return io::propose_joint(io::read_model(written(text)), {.joint = "hip_r", .joint_file = {}});
  }

  /// The error of a refused model, or its only joint.
  std::string refusal(const std::string& text) const {
    std::string why_not;
    const std::string said = test::complaint_of([&] {
      const io::Model model = io::read_model(written(text));
      for (const io::ModelJoint& joint : model.joints) {
        if (!joint.transform) return void(why_not = joint.why_not);
        io::propose_joint(model, {.joint = joint.name, .joint_file = {}});
      }
    });
    return why_not.empty() ? said : why_not;
  }

  test::TemporaryFolder folder_;
};

bool says(const std::vector<io::ModelNote>& notes, io::ModelNoteCode code) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const io::ModelNote& note) { return note.code == code; });
}

TEST_F(SmallModel, IsAHip) {
  const io::Model model = this->model({});
  EXPECT_EQ(model.name, "small & plain");
  const io::LoadedJoint loaded = io::read_joint(model, {.joint = "hip_r", .joint_file = {}});
  EXPECT_EQ(loaded.joint.kind, JointKind::ball);
  EXPECT_EQ(loaded.joint.side, Side::right);
  EXPECT_TRUE(loaded.joint.is_hip());
  const auto& columns = std::get<std::vector<io::ColumnOfCoordinate>>(*loaded.report.file.recorded_motion);
  ASSERT_EQ(columns.size(), 3u);
  for (const io::ColumnOfCoordinate& column : columns) EXPECT_EQ(column.sign, 1);
  EXPECT_EQ(columns[2].column, "hip_r/rot");
}

TEST_F(SmallModel, OfALeftSideHasTheSignsOfItsAxes) {
  Hip hip{.name = "hip_l", .body = "femur_l"};
  const auto signs = [&] {
    const auto motion = *loaded(hip).report.file.recorded_motion;
    std::string text;
    for (const auto& column : std::get<std::vector<io::ColumnOfCoordinate>>(motion))
      text += column.sign > 0 ? '+' : '-';
    return text;
  };
  EXPECT_EQ(signs(), "+--");
  hip.joint = rotations("-1 0 0", "0 -2 0");
  EXPECT_EQ(signs(), "+++");
}

/// That a joint so made places the child's body where the model's functions do, at coordinates within and beyond theirs.
void expect_poses_of_model(const io::Model& model, const io::ModelJointRequest& request, JointKind kind,
                           bool by_columns) {
  const io::ModelJoint& joint = io::joint_named(model, request.joint);
  const io::LoadedJoint loaded = io::read_joint(model, request);
  EXPECT_EQ(loaded.joint.kind, kind);
  EXPECT_EQ(std::holds_alternative<std::vector<io::ColumnOfCoordinate>>(*loaded.report.file.recorded_motion),
            by_columns);
  const io::Provenance from = io::provenance_of(loaded, {});
  for (const double size : {0.0, 0.3, -1.1, 2.5}) {
    std::vector<double> q;
    std::vector<std::string> columns;
    std::vector<std::vector<double>> values;
    for (std::size_t i = 0; i < joint.coordinates.size(); ++i) {
      q.push_back(size * (1 - 0.3 * static_cast<double>(i)));
      columns.push_back(joint.coordinates[i].name), values.push_back({q.back()});
    }
    const io::MotionTable table = motion_table(std::move(columns), std::move(values));
    const Eigen::Affine3d X = from.fixed.source_from_joint *
                              Eigen::Affine3d(*io::motion_of(loaded, table).X_FM[0]) *
                              from.mobile.joint_from_source;
    EXPECT_LE((X.matrix() - io::pose_of(joint, q).matrix()).cwiseAbs().maxCoeff(), 1e-12) << size;
  }
}

std::string line(double slope, double shift) {
  return fmt::format("<LinearFunction name=\"function\"><coefficients>{} {}</coefficients></LinearFunction>",
                     slope, shift);
}

std::string constant(double value) {
  return fmt::format("<Constant name=\"function\"><value>{}</value></Constant>", value);
}

TEST_F(SmallModel, WithOffsetsKeepsThem) {
  const std::string hinge =
      axis("rotation1", "", "0 0 1", constant(0.2)) + axis("rotation2", "flex", "1 0.5 -0.2", line(-1, 0.3)) +
      axis("rotation3", "", "0 1 0.1", constant(-0.4)) + axis("translation2", "", "0 1 0", constant(0.05));
  const std::string angles = axis("rotation1", "flex", "0 0 -1", line(1, 0.3)) +
                             axis("rotation2", "add", "1 0 0", line(-1, -0.1)) +
                             axis("rotation3", "rot", "0 -1 0", line(1, 0.2));
  const std::string moved = axis("translation1", "x", "-1 0 0", line(1, 0.01)) +
                            axis("translation2", "y", "0 1 0", line(-1, 0.02)) +
                            axis("translation3", "z", "0 0 1");
  const auto with = [&](const std::string& joint, std::initializer_list<std::string_view> names) {
    return io::read_model(written(
        test::replaced(Hip{.joint = joint}.text(), coordinates({"flex", "add", "rot"}), coordinates(names))));
  };
  for (const Anatomy anatomy : {Anatomy::knee, Anatomy::ankle, Anatomy::elbow})
    for (const Side side : {Side::right, Side::left}) {
      const io::ModelJointRequest request{
          .joint = "hip_r", .joint_file = {}, .anatomy = anatomy, .side = side};
      expect_poses_of_model(with(hinge, {"flex"}), request, JointKind::hinge, true);
      expect_poses_of_model(with(angles, {"flex", "add", "rot"}), request, JointKind::ball, true);
      expect_poses_of_model(with(angles + moved, {"flex", "add", "rot", "x", "y", "z"}), request,
                            JointKind::free, true);
      // A coordinate that turns and moves is in two units at once.
      expect_poses_of_model(with(angles + axis("translation1", "flex", "1 0 0"), {"flex", "add", "rot"}),
                            request, JointKind::free, false);
    }
  for (const Anatomy anatomy : {Anatomy::hip, Anatomy::shoulder}) {
    const io::ModelJointRequest request{
        .joint = "hip_r", .joint_file = {}, .anatomy = anatomy, .side = Side::left};
    expect_poses_of_model(with(hinge, {"flex"}), request, JointKind::ball, false);
    expect_poses_of_model(with(angles, {"flex", "add", "rot"}), request, JointKind::ball,
                          anatomy == Anatomy::hip);
  }
}

TEST_F(SmallModel, ScaledFunctionsAreRadiansInOpenSim) {
  const std::string twice = "<MultiplierFunction name=\"function\"><function>" + line(0.5, 0) +
                            "</function><scale>2</scale></MultiplierFunction>";
  const Hip hip{.joint = rotations("1 0 0", "0 1 0", "", twice)};
  expect_poses_of_model(model(hip), {.joint = "hip_r", .joint_file = {}}, JointKind::ball, false);
}

TEST_F(SmallModel, OfAnotherOrderIsPosedByTheModel) {
  const Hip hip{.joint = axis("rotation1", "add", "1 0 0") + axis("rotation2", "flex", "0 0 1") +
                         axis("rotation3", "rot", "0 1 0")};
  const io::LoadedJoint joint = loaded(hip);
  EXPECT_EQ(joint.joint.kind, JointKind::ball);
  EXPECT_TRUE(std::holds_alternative<io::PosesOfModel>(*joint.report.file.recorded_motion));
}

TEST_F(SmallModel, MirroredByItsScaleKeepsItsInside) {
  const io::LoadedJoint joint =
      loaded({.mesh = "<mesh_file>femur.ply</mesh_file><scale_factors>2 1 -1</scale_factors>"});
  const MeshReport report = inspect(joint.joint.mobile.mesh);
  EXPECT_NEAR(report.signed_volume.value(), 2 * 50.0 * 50 * 30, 1e-6);
  test::expect_says(fmt::format("{}", fmt::join(joint.report.processing, "\n")), "mirrored");
}

TEST_F(SmallModel, DegreesAreOfRotationalCoordinatesOnly) {
  const std::string falling = "<SimmSpline name=\"function\"><x>-1 0 1</x><y>1 0 -1</y></SimmSpline>";
  const io::LoadedJoint joint = loaded({.joint = rotations("1 0 0", "0 1 0", falling)});
  io::MotionTable table =
      motion_table({"flex", "hip_r/add/value", "rot", "rot_u"}, {{30}, {0.2}, {NAN}, {5}}, true);
  EXPECT_FALSE(io::motion_of(joint, table).X_FM[0].has_value()) << "a gap is no pose";
  table.values[3] = {-10};
  const io::JointMotion motion = io::motion_of(joint, table);
  const JointAngles angles = angles_at(joint.joint.coordinates(), *motion.X_FM[0]);
  EXPECT_NEAR(angles.flexion.degrees(), 30, 1e-12);
  EXPECT_NEAR(angles.adduction.radians(), -0.2, 1e-14);
  EXPECT_NEAR(angles.internal_rotation.degrees(), -10, 1e-12);
  test::expect_says(fmt::format("{}", fmt::join(motion.processing, "\n")), "'add' turns the joint through");
}

TEST_F(SmallModel, CoordinatesWithoutAColumnHaveTheirDefaults) {
  const std::string text =
      test::replaced(Hip{}.text(), R"(<Coordinate name="add"/>)",
                     R"(<Coordinate name="add"><default_value>0.1</default_value></Coordinate>)");
  const io::LoadedJoint loaded =
      io::read_joint(io::read_model(written(text)), {.joint = "hip_r", .joint_file = {}});
  io::MotionTable table = motion_table({"flex"}, {{30}}, true);
  const io::JointMotion motion = io::motion_of(loaded, table);
  EXPECT_NEAR(angles_at(loaded.joint.coordinates(), *motion.X_FM[0]).adduction.radians(), 0.1, 1e-14);
  table.columns[1] = "nothing";
  EXPECT_THROW(io::motion_of(loaded, table), FileError);
}

const std::string spline = "<SimmSpline name=\"function\"><x>-1 0 1</x><y>-1 0 1</y></SimmSpline>";

/// A coupler that gives `rot` by a line over `flex`.
std::string coupler(std::string_view name, std::string_view dependent, std::string_view independent,
                    std::string_view line = "0.5 0", std::string_view more = "") {
  return fmt::format(R"(<CoordinateCouplerConstraint name="{}">
<coupled_coordinates_function><LinearFunction><coefficients>{}</coefficients></LinearFunction></coupled_coordinates_function>
<independent_coordinate_names>{}</independent_coordinate_names><dependent_coordinate_name>{}</dependent_coordinate_name>
{}</CoordinateCouplerConstraint>)",
                     name, line, independent, dependent, more);
}

Hip hip_with(const std::string& couplers) {
  return {.joint = rotations("1 0 0", "0 1 0", spline),
          .more = "<ConstraintSet><objects>" + couplers + "</objects></ConstraintSet>"};
}
/// Twice a line that is not through 0.
Hip hip_of_a_scaled_coupler() {
  return hip_with(
      coupler("c", "rot", "flex", "0.5 0.1", "<isEnforced>true</isEnforced><scale_factor>2</scale_factor>"));
}
const io::MotionTable flexed = motion_table({"flex"}, {{0.3}});

double internal_rotation(const io::LoadedJoint& joint, const io::MotionTable& table) {
  return angles_at(joint.joint.coordinates(), *io::motion_of(joint, table).X_FM[0])
      .internal_rotation.radians();
}

TEST_F(SmallModel, CouplersGiveWhatHasNoColumn) {
  EXPECT_NEAR(internal_rotation(loaded(hip_of_a_scaled_coupler()), flexed), 2 * (0.5 * 0.3 + 0.1), 1e-14);
}

TEST_F(SmallModel, CouplersMayNameCoordinatesByPaths) {
  const Hip hip = hip_with(coupler("c", "/jointset/hip_r/rot", "/jointset/hip_r/flex"));
  EXPECT_NEAR(internal_rotation(loaded(hip), flexed), 0.15, 1e-14);
}

TEST_F(SmallModel, TwoCouplersOfOneCoordinateAreRefusedByTheirNames) {
  const auto joint = loaded(hip_with(coupler("first", "rot", "flex") + coupler("second", "rot", "add")));
  test::expect_says(test::complaint_of<FileError>([&] { io::motion_of(joint, flexed); }),
                    "constraints 'first' and 'second' both give coordinate 'rot'");
}

TEST_F(SmallModel, CouplersWithoutAColumnEitherAreRefused) {
  const io::LoadedJoint joint = loaded(hip_of_a_scaled_coupler());
  EXPECT_THROW(io::motion_of(joint, motion_table({"other"}, {{0.3}})), FileError);
}

TEST_F(SmallModel, TakesColumnsOfItsJointOnly) {
  const io::LoadedJoint joint = loaded({});
  const auto flexion = [&](std::vector<std::string> names) {
    std::vector<std::vector<double>> values;
    for (std::size_t i = 1; i <= names.size(); ++i) values.push_back({0.1 * static_cast<double>(i)});
    const io::JointMotion motion = io::motion_of(joint, motion_table(std::move(names), std::move(values)));
    return angles_at(joint.joint.coordinates(), *motion.X_FM[0]).flexion.radians();
  };
  EXPECT_NEAR(flexion({"flex"}), 0.1, 1e-14);
  EXPECT_NEAR(flexion({"hip_r/flex/value"}), 0.1, 1e-14);
  EXPECT_NEAR(flexion({"/jointset/hip_l/flex/value", "/jointset/hip_r/flex/value"}), 0.2, 1e-14);
  EXPECT_THROW(flexion({"/jointset/hip_l/flex/value"}), FileError);
  EXPECT_THROW(flexion({"flex", "/jointset/hip_r/flex/value"}), FileError) << "either";
  EXPECT_THROW(flexion({"/jointset/chip_r/flex/value"}), FileError);
  EXPECT_THROW(flexion({"/jointset/hip_r/flex/speed"}), FileError);
}

TEST_F(SmallModel, IsReversedUpToVersion30513) {
  const auto parent_of = [&](std::string_view version) {
    const std::string text = test::replaced(Hip{.version = std::string(version)}.text(), "<SpatialTransform>",
                                            "<reverse>true</reverse><SpatialTransform>");
    const io::Model model = io::read_model(written(text));
    return model.joints.front().parent_body +
           (says(model.notes, io::ModelNoteCode::reverse_passed_over) ? ", said" : "");
  };
  EXPECT_EQ(parent_of("40500"), "pelvis, said");
  EXPECT_EQ(parent_of("30514"), "pelvis, said");
  EXPECT_EQ(parent_of("30513"), "femur_r");
}

TEST_F(SmallModel, SaysThatItsChildIsTheProximalBone) {
  EXPECT_FALSE(says(proposed(Hip{}.text()).notes, io::ModelNoteCode::exchanged_bodies));
  std::string text = Hip{.name = "knee_r", .body = "tibia_r"}.text();
  for (std::size_t at = text.find("pelvis"); at != text.npos; at = text.find("pelvis", at + 1))
    text.replace(at, 6, "talus0");
  const io::ModelJointProposal ankle = io::propose_joint(
      io::read_model(written(text)), {.joint = "knee_r", .joint_file = {}, .anatomy = Anatomy::ankle});
  EXPECT_TRUE(says(ankle.notes, io::ModelNoteCode::exchanged_bodies));
}

TEST_F(SmallModel, SaysThatItsFrameIsTurnedInItsBody) {
  for (const auto& [orientation, is_turned] : {std::pair("0 0 0", false),
                                               {"0.5 0 0", false},
                                               {"0 0.5 0", false},
                                               {"0 0 -0.5", false},
                                               {"0.55 0 0", true},
                                               {"0 0.9 0", true},
                                               {"0 3.14159 0", true},
                                               {"0 0 -1.5708", true}}) {
    std::string text = Hip().text();
    text.insert(text.find("<translation>"), fmt::format("<orientation>{}</orientation>", orientation));
    EXPECT_EQ(says(proposed(text).notes, io::ModelNoteCode::turned_frame), is_turned) << orientation;
  }
}

TEST_F(SmallModel, SaysThatItIsGivenOtherwiseThanItIsCalled) {
  const auto codes = [&](std::optional<Anatomy> anatomy, std::optional<Side> side) {
    std::string text;
    for (const io::ModelNote& note :
         io::propose_joint(model({}), {.joint = "hip_r", .joint_file = {}, .anatomy = anatomy, .side = side})
             .notes)
      text += std::string(name_of(note.code)) + " ";
    return text;
  };
  EXPECT_EQ(codes({}, {}), "");
  EXPECT_EQ(codes(Anatomy::hip, Side::right), "");
  EXPECT_EQ(codes({}, Side::left), "given_otherwise ");
  EXPECT_EQ(codes(Anatomy::knee, {}), "given_otherwise ");
}

TEST_F(SmallModel, NeedsTwoBodiesThatMove) {
  test::expect_says(refusal(test::replaced(Hip{}.text(), "/bodyset/femur_r</socket_child",
                                           "/bodyset/pelvis</socket_child")),
                    "on both sides");
  std::string weld = Hip{}.text();
  for (const std::string_view name : {"<CustomJoint", "</CustomJoint"})
    weld.replace(weld.find(name), name.size(), std::string(name.substr(0, name.find('C'))) + "WeldJoint");
  test::expect_says(refusal(test::replaced(weld, coordinates({"flex", "add", "rot"}), "")), "does not move");
}

TEST_F(SmallModel, ReadsNumbersBesideACommentAndRefusesOnesWithACommentInThem) {
  const auto with = [](std::string_view translation) {
    return test::replaced(Hip{}.text(), "0.1 -0.2 0.3</translation>",
                          std::string(translation) + "</translation>");
  };
  for (const char* translation :
       {"9 <!-- x -->1 2", "9<!-- x --> 1 2", "<!-- x -->9 1 2<!-- y --><!-- z -->"}) {
    const io::Model model = io::read_model(written(with(translation)));
    EXPECT_EQ(io::joint_named(model, "hip_r").X_PF.translation(), Vec3(9, 1, 2)) << translation;
  }
  for (const char* translation : {"9<!-- x -->1 1 2", "9<!-- x --><!-- y -->1 1 2", "9 1 2<!---->5"})
    test::expect_says(refusal(with(translation)), "translation: a comment stands inside a number");
}

TEST_F(SmallModel, HasWeldsThatAgreeWhereBodiesAre) {
  const auto weld = [](const char* name, const char* parent, const char* child, const char* along) {
    return fmt::format(R"(<WeldJoint name="{0}"><socket_parent_frame>{0}_p</socket_parent_frame>
<socket_child_frame>/bodyset/{2}</socket_child_frame><frames><PhysicalOffsetFrame name="{0}_p"><socket_parent>/bodyset/{1}</socket_parent>
<translation>{3} 0 0</translation></PhysicalOffsetFrame></frames></WeldJoint>)",
                       name, parent, child, along);
  };
  const auto with = [&](const std::string& welds) {
    std::string text = Hip{}.text();
    text.insert(text.find("<Body name=\"femur_r\""), "<Body name=\"a\"/><Body name=\"b\"/>");
    return text.insert(text.find("<CustomJoint"), welds);
  };
  const std::string chain = weld("w1", "femur_r", "a", "0.1") + weld("w2", "a", "b", "0.2");
  const io::Model closed = io::read_model(written(with(chain + weld("w3", "b", "femur_r", "-0.3"))));
  test::expect_says(io::propose_joint(closed, {.joint = "hip_r", .joint_file = {}}).proposal.toml, "femur");
  const io::Model open = io::read_model(written(with(chain + weld("w3", "b", "femur_r", "-0.31"))));
  test::expect_says(
      test::complaint_of<FileError>([&] { io::propose_joint(open, {.joint = "hip_r", .joint_file = {}}); }),
      "where other welds do not have it");
}

TEST_F(SmallModel, NamesFilesFromWhereTheJointFileReallyIs) {
  const io::Model model = this->model({});
  fs::create_directories(folder_.path() / "out/deep");
  fs::create_directory_symlink(folder_.path() / "out/deep", folder_.path() / "link");
  const auto mesh_line = [&](const fs::path& joint_file) {
    const std::string toml =
        io::propose_joint(model, {.joint = "hip_r", .joint_file = joint_file}).proposal.toml;
    const std::size_t at = toml.find("mesh = ");
    return toml.substr(at, toml.find('\n', at) - at);
  };
  EXPECT_EQ(mesh_line(folder_.path() / "out/hip.toml"), "mesh = '../pelvis.ply'");
  EXPECT_EQ(mesh_line(folder_.path() / "out/deep/../../out/hip.toml"), "mesh = '../pelvis.ply'");
  EXPECT_EQ(mesh_line(folder_.path() / "link/hip.toml"), "mesh = '../../pelvis.ply'");
  EXPECT_EQ(mesh_line(folder_.path() / "hip.toml"), "mesh = 'pelvis.ply'");
}

TEST_F(SmallModel, SaysWhatNobodyMeansOfItsMeshes) {
  const auto notes_of = [&](const std::string& mesh) {
    std::string codes;
    for (const io::ModelNote& note :
         io::propose_joint(model({.mesh = mesh}), {.joint = "hip_r", .joint_file = {}}).notes)
      codes += fmt::format("{} ", name_of(note.code));
    return codes;
  };
  const std::string file = "<mesh_file>femur.ply</mesh_file>";
  EXPECT_EQ(notes_of(file + "<scale_factors>0.7 1.3 1</scale_factors>"), "");
  EXPECT_EQ(notes_of(file + "<scale_factors>0.001 1 1</scale_factors>"), "uneven_scale ");
  EXPECT_EQ(notes_of(file + "<scale_factors>1 -2.1 1</scale_factors>"), "mirrored uneven_scale ");
  const std::string again = "</Mesh><Mesh name=\"g\">" + file;
  EXPECT_EQ(notes_of(file + again), "repeated_mesh ");
  EXPECT_EQ(notes_of(file + again + "<scale_factors>1 1 1.1</scale_factors>"), "") << "another mesh";
  const io::LoadedJoint once =
      io::read_joint(model({.mesh = file + again}), {.joint = "hip_r", .joint_file = {}});
  EXPECT_EQ(once.joint.mobile.mesh.triangles().size(), 12u);
  EXPECT_TRUE(once.joint.mobile.parts.empty());
}

TEST_F(SmallModel, FindsMeshesInAnyCaseAndSaysSo) {
  const io::Model model = this->model({.mesh = "<mesh_file>FEMUR.PLY</mesh_file>"});
  ASSERT_TRUE(model.meshes[1].path);
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_EQ(io::to_text(model.notes[0]), "other_case: mesh 'FEMUR.PLY' was found as 'femur.ply'");
}

TEST_F(SmallModel, WithoutMeshesNamesWhereTheyWereLookedFor) {
  const io::Model model = this->model({.mesh = "<mesh_file>none.vtp</mesh_file>"});
  const io::ModelJointProposal proposed = io::propose_joint(model, {.joint = "hip_r", .joint_file = {}});
  test::expect_says(proposed.missing_body, "no mesh of body 'femur_r' was found; looked for");
  test::expect_says(proposed.missing_body, "Geometry/none.vtp");
  fs::remove(folder_.path() / "pelvis.ply");
  const io::ModelJointProposal neither =
      io::propose_joint(io::read_model(folder_.path() / "model.osim"), {.joint = "hip_r", .joint_file = {}});
  for (const char* body : {"no mesh of body 'pelvis'", "no mesh of body 'femur_r'"})
    test::expect_says(neither.missing_body, body);
  test::expect_says(proposed.proposal.toml, "none.vtp");
  EXPECT_THROW(io::read_joint(model, {.joint = "hip_r", .joint_file = {}}), FileError);
}

TEST_F(SmallModel, RefusesInOneLine) {
  const Hip hip;
  const auto replaced = [&](std::string_view what, std::string_view with) {
    return test::replaced(hip.text(), what, with);
  };
  const std::string deep = [] {
    std::string open, close;
    for (int i = 0; i < 300; ++i) open += "<a>", close += "</a>";
    return open + close;
  }();
  const std::pair<std::string, std::string> cases[] = {
      {replaced("40500", "40700"), "line 2: version 40700 is after 40600"},
      {replaced("40500", "10400"), "line 2: version 10400 is before 10500"},
      {replaced("40500", "new"), "Version 'new' is no number"},
      {replaced("<Model name", "<Muddle name"), "'</Model>' closes what is not open"},
      {replaced("0.1 -0.2 0.3", "0.1 -0.2"), "translation: three numbers are needed, not 2"},
      {replaced("0.1 -0.2 0.3", "0.1 nan 0.3"), "translation: 'nan' is not finite"},
      {replaced("0.1 -0.2 0.3", "0.1 x 0.3"), "translation: 'x' is no number"},
      {replaced("<axis>1 0 0</axis>", "<axis>0 0 0</axis>"),
       "joint 'hip_r': rotation2: axis: has no direction"},
      {replaced("<axis>1 0 0</axis>", "<axis>0 0 3</axis>"), "rotation1 and rotation2 are about one axis"},
      {replaced("<coordinates>add</coordinates>", "<coordinates>ad</coordinates>"),
       "rotation2: coordinate 'ad' is none of this joint's"},
      {replaced("<coordinates>add</coordinates>", "<coordinates/>"), "coordinate 'add' is used by no axis"},
      {replaced("<coordinates>add</coordinates>", "<coordinates>add rot</coordinates>"),
       "2 coordinates and no function of them"},
      {replaced("rotation2", "rotation4"), "'rotation4' is no name of a TransformAxis"},
      {replaced("rotation2", "rotation1"), "rotation1 is given twice"},
      {replaced("socket_parent_frame>parent<", "socket_parent_frame>other<"),
       "there is no body or frame 'other'"},
      {test::replaced(replaced("<CustomJoint", "<EllipsoidJoint"), "</CustomJoint", "</EllipsoidJoint"),
       "a joint of type EllipsoidJoint is not read"},
      {replaced("<objects>\n<Body", "<!DOCTYPE a><objects>\n<Body"), "'<!DOCTYPE' is not read"},
      {replaced("<objects>\n<Body", deep + "<objects>\n<Body"), "elements nested deeper than 200"},
      {replaced("hip_r", "hip\xe9_r"), "its name is not UTF-8"},
      {replaced("femur.ply", "fe&#27;mur.ply"), "mesh_file has a control character"},
      {"{}", "no XML tag"},
      {"\xff\xfe<" + std::string(1, '\0'), "line 1: is UTF-16: save it as UTF-8"},
      {"<html></html>", "no OpenSim model: it begins with 'html'"},
  };
  for (const auto& [text, wanted] : cases) {
    std::string line = refusal(text);
    test::expect_says(line, "model.osim: ");
    EXPECT_NE(line.find(wanted), std::string::npos) << line << "\n  wanted: " << wanted;
    test::expect_silent(line, "\n");
  }
}

/// A joint of the body that frames hang on in many ways, each 1, 2, ... m along X.
std::string with_frames(std::string_view parent_socket) {
  const auto frame = [](std::string_view name, std::string_view parent, int along,
                        std::string_view inside = "") {
    return fmt::format(
        R"(<PhysicalOffsetFrame name="{}"><socket_parent>{}</socket_parent><translation>{} 0 0</translation>
<components>{}</components></PhysicalOffsetFrame>)",
        name, parent, along, inside);
  };
  return fmt::format(
      R"(<OpenSimDocument Version="40000"><Model name="m"><BodySet><objects>
<Body name="pelvis"><components>{}{}</components></Body>
<Body name="femur_r"><components>{}</components></Body></objects></BodySet>
<JointSet><objects><PinJoint name="pelvis"><socket_parent_frame>{}</socket_parent_frame>
<socket_child_frame>/bodyset/femur_r</socket_child_frame>{}<frames>{}{}</frames></PinJoint></objects></JointSet></Model></OpenSimDocument>)",
      frame("F1", "..", 1, frame("F2", "..", 10) + frame("F3", "../..", 100)), frame("off", "..", 1000),
      frame("F1", "..", 2, frame("F2", "..", 20)), parent_socket, coordinates({"q"}),
      frame("off", "/bodyset/pelvis", 5), frame("femur_r", "/bodyset/femur_r", 7));
}

TEST_F(SmallModel, FollowsSocketsAsTheyArePaths) {
  const std::pair<std::string_view, int> cases[] = {
      {"/bodyset/pelvis", 0},
      {"/bodyset/pelvis/F1", 1},
      {"/bodyset/femur_r/F1", 2},
      {"/bodyset/femur_r/F1/F2", -1},
      {"F3", 100},
      {"off", 5},
      {"femur_r", 7},
  };
  for (const auto& [socket, along] : cases) {
    SCOPED_TRACE(socket);
    const io::Model model = io::read_model(written(with_frames(socket)));
    const io::ModelJoint& joint = model.joints.front();
    if (along < 0) {
      test::expect_says(joint.why_not, "could be one of several frames");
      continue;
    }
    EXPECT_EQ(joint.why_not, "");
    EXPECT_EQ(joint.X_PF.translation(), Vec3(along, 0, 0));
  }
  for (const char* socket : {"/bodyset/pelvis/F9", "/bodyset/femur_r/off", "F1", ".."})
    EXPECT_FALSE(io::read_model(written(with_frames(socket))).joints.front().transform) << socket;
}

TEST_F(SmallModel, RefusesFunctionsThatItDoesNotRead) {
  for (const char* function :
       {"<FiberForceLengthCurve name=\"function\"/>", "<Polynomial name=\"function\"/>", "<GCVSpline/>",
        "<Polynomial/>", "<function><Constant/><Constant/></function>",
        "<Constant><value>1</value></Constant><Constant><value>2</value></Constant>"}) {
    const std::string said = refusal(Hip{.joint = rotations("1 0 0", "0 1 0", "", function)}.text());
    test::expect_says(said, "rotation1: ");
    EXPECT_TRUE(said.find("is not read") != said.npos || said.find("more than one") != said.npos ||
                said.find("a second function") != said.npos)
        << said;
  }
}

TEST_F(SmallModel, RefusesCouplersOfAnotherNumberOfCoordinates) {
  for (const char* slopes : {"1 2 0", "0", "1 2 3 0"}) {
    std::string text = coupler("c", "rot", "flex", slopes);
    text = test::replaced(text, "<LinearFunction>", "<MultiplierFunction><function><LinearFunction>");
    text = test::replaced(text, "</LinearFunction>", "</LinearFunction></function></MultiplierFunction>");
    const io::LoadedJoint joint = loaded(hip_with(text));
    EXPECT_THROW(io::motion_of(joint, flexed), FileError) << slopes;
  }
}

TEST_F(SmallModel, ReadsMeshesOfTheModelItself) {
  const io::Model model = this->model(
      {.more =
           "<components><Mesh "
           "name=\"a\"><socket_frame>/bodyset/femur_r</socket_frame><mesh_file>pelvis.ply</mesh_file></Mesh>"
           "<Mesh name=\"b\"><mesh_file>femur.ply</mesh_file></Mesh></components>"});
  ASSERT_EQ(model.meshes.size(), 3u);
  EXPECT_EQ(model.meshes[2].body, "femur_r");
  EXPECT_EQ(model.ignored.at("Mesh of no frame"), 1u);
}

// Contacts name their meshes.
TEST_F(SmallModel, RefusesContactMeshesOfOneName) {
  const std::string mesh =
      "<Smith2018ContactMesh name=\"a\"><socket_frame>/bodyset/pelvis</socket_frame>"
      "<mesh_file>pelvis.ply</mesh_file></Smith2018ContactMesh>";
  const Hip hip{.more = "<ContactGeometrySet><objects>" + mesh + mesh +
                        "</objects></ContactGeometrySet><ForceSet><objects><Smith2018ArticularContactForce "
                        "name=\"k\"><socket_casting_mesh>a</socket_casting_mesh>"
                        "<socket_target_mesh>a</socket_target_mesh></Smith2018ArticularContactForce>"
                        "</objects></ForceSet>"};
  test::expect_says(refusal(hip.text()), "contact mesh 'a' is given twice");
}

TEST_F(SmallModel, AsksForWhatNamesDoNotTell) {
  test::expect_says(refusal(Hip{.name = "hip", .body = "femur"}.text()), "give its side");
  test::expect_says(refusal(Hip{.name = "hip_r", .body = "femur_l"}.text()), "give its side");
  test::expect_says(refusal(Hip{.name = "joint_r", .body = "body_r"}.text()),
                    "say whether it is a hip, knee");
}

}  // namespace
}  // namespace condyle
