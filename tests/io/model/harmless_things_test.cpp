#include <fmt/format.h>

#include <tuple>

#include "condyle/io/mesh_file.hpp"
#include "condyle/io/model_file.hpp"
#include "support/test.hpp"

// What a joint does not need does not refuse it, and what it needs is read before anything is proposed.

namespace condyle {
namespace {

namespace fs = std::filesystem;

std::string geometry(std::string_view file, std::string_view more = "") {
  return fmt::format(
      R"(<attached_geometry><Mesh name="m"><mesh_file>{}</mesh_file>{}</Mesh></attached_geometry>)", file,
      more);
}
std::string other_body(std::string_view inside) {
  return fmt::format("<Body name=\"other\">{}</Body>", inside);
}

/// A knee of two bodies, with room for whatever else a model holds.
struct SmallKnee {
  std::string units = "meters";
  std::string femur = geometry("femur.ply");
  std::string bodies = "", joints = "", more = "";
  std::string parent_frame = "/bodyset/femur_r";

  std::string text() const {
    return fmt::format(
        R"(<OpenSimDocument Version="40000"><Model name="knee"><length_units>{}</length_units><BodySet><objects>
<Body name="femur_r">{}</Body>
<Body name="tibia_r"><attached_geometry><Mesh name="m"><mesh_file>tibia.ply</mesh_file></Mesh></attached_geometry></Body>
{}</objects></BodySet><JointSet><objects><PinJoint name="knee_r"><socket_parent_frame>{}</socket_parent_frame>
<socket_child_frame>/bodyset/tibia_r</socket_child_frame><coordinates><Coordinate name="q"/></coordinates></PinJoint>
{}</objects></JointSet>{}</Model></OpenSimDocument>)",
        units, femur, bodies, parent_frame, joints, more);
  }
};

class HarmlessThings : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* mesh : {"femur.ply", "tibia.ply", "other.ply"})
      io::write_mesh(folder_.path() / mesh, test::box({-0.02, -0.03, -0.02}, {0.03, 0.02, 0.01}));
  }

  io::Model read(const SmallKnee& knee) const {
    return io::read_model(folder_.file("model.osim", knee.text()));
  }

  /// The notes of the proposal for the knee, or why there is none.
  std::string proposed(const SmallKnee& knee) const {
    try {
      const io::ModelJointProposal made =
          io::propose_joint(read(knee), {.joint = "knee_r", .joint_file = folder_.path() / "k.toml"});
      if (!made.unreadable.empty()) return "unreadable: " + made.unreadable;
      std::string lines;
      for (const io::ModelNote& note : made.notes)
        if (note.code != io::ModelNoteCode::not_used) lines += io::to_text(note) + "\n";
      return lines;
    } catch (const std::exception& error) {
      return std::string("refused: ") + error.what();
    }
  }
  static bool has(const std::string& text, std::string_view part) { return text.find(part) != text.npos; }

  const test::TemporaryFolder folder_;
};

TEST_F(HarmlessThings, AreUnitsThatNobodySet) {
  for (const char* units : {"meters", "Meters", "metres", "m", "meter", ""})
    EXPECT_EQ(proposed({.units = units}), "") << units;
  for (const char* units : {"Unassigned", "unassigned", "UNASSIGNED", " Unassigned\n", "Unknown"})
    EXPECT_EQ(proposed({.units = units}).find("no_length_unit: length_units is '"), 0u) << units;
  for (const char* units : {"mm", "centimeters", "Unassigned mm"})
    EXPECT_TRUE(has(proposed({.units = units}), "OpenSim takes all lengths for metres")) << units;
}

TEST_F(HarmlessThings, AreJointsAndBodiesWithoutNames) {
  const std::string pin =
      R"(<PinJoint{}><socket_parent_frame>off</socket_parent_frame><socket_child_frame>/bodyset/other</socket_child_frame>
<coordinates><Coordinate name="p"/></coordinates><frames><PhysicalOffsetFrame name="off"><socket_parent>/bodyset/tibia_r</socket_parent>
</PhysicalOffsetFrame></frames></PinJoint>
)";
  const std::string nameless = fmt::format(fmt::runtime(pin), ""),
                    empty = fmt::format(fmt::runtime(pin), " name=\"\"");
  const SmallKnee knee{.bodies = "<Body name=\"other\"/>", .joints = nameless + empty};
  const std::string notes = proposed(knee);
  test::expect_says(notes, "no_name: line 6: a PinJoint of 'other' has no name, and nobody can ask for it");
  EXPECT_EQ(read(knee).joints.size(), 3u);
  EXPECT_THROW(io::joint_named(read(knee), ""), UsageError);
  test::expect_says(proposed({.bodies = "<Body/><Body name=\"\">" + geometry("x.ply") + "</Body>"}),
                    "no_name: line 4: a body has no name and is left out");
}

TEST_F(HarmlessThings, OfAWeldWithoutANameAreItsBones) {
  const std::string weld =
      "<WeldJoint><socket_parent_frame>/bodyset/tibia_r</socket_parent_frame>"
      "<socket_child_frame>/bodyset/other</socket_child_frame></WeldJoint>";
  const io::Model model = read({.bodies = other_body(geometry("other.ply")), .joints = weld});
  EXPECT_EQ(io::meshes_of(model, io::joint_named(model, "knee_r"), BodyRole::mobile).size(), 2u);
}

TEST_F(HarmlessThings, AreOtherJointsBodiesMeshesAndForces) {
  const auto body = [&](std::string_view in) { return other_body(geometry("other.ply", in)); };
  const SmallKnee cases[] = {
      {.bodies = body("<scale_factors>1 1</scale_factors>")},
      {.bodies = body("<socket_frame>/bodyset/nowhere</socket_frame>")},
      {.bodies = other_body("<components><PhysicalOffsetFrame name=\"f\"><socket_parent>..</socket_parent>"
                            "<translation>1 nan 0</translation></PhysicalOffsetFrame></components>")},
      {.bodies = other_body("<components><PhysicalOffsetFrame name=\"f\"/></components>")},
      {.bodies = "<Body name=\"other\"/><Body name=\"other\"/>"},
      {.bodies = "<Body name=\"oth\xe9r\"/>"},
      {.joints = "<PinJoint name=\"a\xe9\"/>"},
      {.joints = "<PinJoint name=\"a\"/><PinJoint name=\"a\"/>"},
      {.joints = "<WeldJoint name=\"w\"><socket_parent_frame>/bodyset/nowhere</socket_parent_frame>"
                 "<socket_child_frame>/ground</socket_child_frame></WeldJoint>"},
      {.more = "<ConstraintSet><objects><CoordinateCouplerConstraint name=\"c\"/></objects></ConstraintSet>"},
      {.more =
           "<ContactGeometrySet><objects><Smith2018ContactMesh name=\"c\"/></objects></ContactGeometrySet>"},
      {.more = "<ForceSet><objects><Smith2018ArticularContactForce name=\"c\"/></objects></ForceSet>"},
      {.more = "<ControllerSet><objects><NewController name=\"c\"><x>1 "
               "2</x></NewController></objects></ControllerSet>"},
      {.more = "<ComponentSet><objects><SomethingFrame name=\"c\"/></objects></ComponentSet>"},
  };
  for (const SmallKnee& knee : cases) {
    const std::string notes = proposed(knee);
    EXPECT_FALSE(has(notes, "refused") || has(notes, "unreadable")) << notes << knee.text();
  }
  test::expect_says(proposed(cases[9]),
                    "left_out: line 6: constraint 'c': dependent_coordinate_name is missing");
}

TEST_F(HarmlessThings, AreNotThoseOfTheJointItself) {
  const std::pair<SmallKnee, std::string> cases[] = {
      {{.femur = geometry("femur.ply", "<scale_factors>1 1</scale_factors>")},
       "refused: " + (folder_ / "model.osim").string() +
           ": line 2: mesh 'm': scale_factors: three numbers are needed"},
      {{.bodies = "<Body name=\"tibia_r\"/>"}, "body 'tibia_r' is given twice"},
      {{.joints = "<PinJoint name=\"knee_r\"/>"}, "joint 'knee_r' is given twice"},
      {{.joints = "<WeldJoint name=\"w\"><socket_parent_frame>/bodyset/nowhere</socket_parent_frame>"
                  "<socket_child_frame>/bodyset/tibia_r</socket_child_frame></WeldJoint>"},
       "there is no body or frame '/bodyset/nowhere'"},
      {{.more = "<ComponentSet><objects><SomethingFrame name=\"c\"/></objects></ComponentSet>",
        .parent_frame = "c"},
       "frame 'c': a frame of type SomethingFrame is not read"}};
  for (const auto& [knee, says] : cases) test::expect_says(proposed(knee), says);
}

TEST_F(HarmlessThings, AreMeshesOfOtherBodiesAndNotThoseThatAreProposed) {
  const std::pair<const char*, const char*> bad[] = {
      {"nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 1\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"},
      {"no_faces.obj", "v 0 0 0\nv 1 0 0\n"},
      {"empty.ply", ""},
      {"text.stl", "this is no mesh"},
  };
  for (const auto& [name, bytes] : bad) {
    folder_.file(name, bytes);
    const std::string said = proposed({.femur = geometry(name)});
    test::expect_begins(said, "unreadable: ");
    test::expect_says(said, name);
    EXPECT_EQ(proposed({.bodies = other_body(geometry(name))}), "");
  }
}

TEST_F(HarmlessThings, AreLettersOfFolders) {
  fs::create_directories(folder_.path() / "geometry/Sub");
  for (const char* name : {"geometry/a.ply", "geometry/Sub/B.ply"})
    fs::copy_file(folder_.path() / "femur.ply", folder_.path() / name);
  const auto notes = [&](std::string_view file) { return proposed({.femur = geometry(file)}); };
  EXPECT_EQ(notes("a.ply"), "") << "geometry is the folder Geometry";
  EXPECT_EQ(notes("A.PLY"), "other_case: mesh 'A.PLY' was found as 'a.ply'\n");
  EXPECT_EQ(notes("sub\\b.ply"), "other_case: mesh 'sub\\b.ply' was found as 'B.ply'\n");
  EXPECT_EQ(notes("SUB/B.ply"), "other_case: mesh 'SUB/B.ply' was found as " +
                                    (folder_.path() / "geometry/Sub/B.ply").string() + "\n");
  EXPECT_EQ(notes("GEOMETRY/a.ply").find("other_case: "), 0u);
  fs::create_directories(folder_.path() / "Geometry");
  EXPECT_EQ(notes("a.ply").find("other_case: mesh 'a.ply' was found as "), 0u)
      << "in the other of two folders";
}

/// Points of a frame, each on the femur.
std::string stations(std::string_view ab, std::string_view across, std::string_view names = "a b c o") {
  const auto station = [](std::string_view name, std::string_view at) {
    return fmt::format(
        "<Station name=\"{}\"><socket_parent_frame>..</socket_parent_frame><location>{}</location></Station>",
        name, at);
  };
  std::string text = "<components>" + station("a", "0.1 0 0") + station("b", "0.1 0 0.2") +
                     station("c", "0.4 0 0.1") + station("o", "0 -0.4 0.05") +
                     "<StationDefinedFrame name=\"at_knee\">";
  constexpr std::array sockets = {"point_a", "point_b", "point_c", "origin_point"};
  for (std::size_t i = 0; i < sockets.size(); ++i)
    text += fmt::format("<socket_{0}>/bodyset/femur_r/{1}</socket_{0}>", sockets[i], names[2 * i]);
  return text + fmt::format(
                    "<ab_axis>{}</ab_axis><ab_x_ac_axis>{}</ab_x_ac_axis></StationDefinedFrame></components>",
                    ab, across);
}

TEST_F(HarmlessThings, AreFramesThatStationsDefine) {
  const auto frame = [&](std::string_view ab, std::string_view across) {
    const SmallKnee knee{.femur = stations(ab, across), .parent_frame = "/bodyset/femur_r/at_knee"};
    const io::Model model = read(knee);
    return io::joint_named(model, "knee_r").X_PF;
  };
  // a to b is along Z; a to b by a to c along Y.
  const auto columns = [](const Vec3& x, const Vec3& y, const Vec3& z) {
    Eigen::Matrix3d R;
    R << x, y, z;
    return R;
  };
  const Vec3 X = Vec3::UnitX(), Y = Vec3::UnitY(), Z = Vec3::UnitZ();
  const std::tuple<const char*, const char*, Eigen::Matrix3d> cases[] = {
      {"+z", "+y", columns(X, Y, Z)},  {"z", "Y", columns(X, Y, Z)},    {"+x", "+y", columns(Z, Y, -X)},
      {"-x", "+y", columns(-Z, Y, X)}, {"+y", "-z", columns(X, Z, -Y)}, {"-z", "-x", columns(-Y, -X, -Z)}};
  for (const auto& [ab, across, R] : cases) {
    const Pose X_PF = frame(ab, across);
    EXPECT_LE((X_PF.linear() - R).cwiseAbs().maxCoeff(), 1e-15) << ab << " " << across << "\n"
                                                                << X_PF.linear();
    EXPECT_EQ(X_PF.translation(), Vec3(0, -0.4, 0.05));
  }
}

TEST_F(HarmlessThings, AreStationsThatMakeNoFrame) {
  const std::tuple<std::string, const char*> cases[] = {
      {stations("+x", "-x"), "frame 'at_knee': ab_axis and ab_x_ac_axis are one axis"},
      {stations("+w", "+y"), "ab_axis: '+w' is no axis"},
      {stations("+x", "+y", "a b b o"), "its points a, b and c lie on a line"},
      {stations("+x", "+y", "a b n o"), "there is no point '/bodyset/femur_r/n'"}};
  for (const auto& [components, why] : cases) {
    const std::string femur = geometry("femur.ply") + components;
    test::expect_says(proposed({.femur = femur, .parent_frame = "/bodyset/femur_r/at_knee"}), why);
    EXPECT_FALSE(has(proposed({.femur = femur}), "refused")) << "nothing hangs on it";
  }
}

}  // namespace
}  // namespace condyle
