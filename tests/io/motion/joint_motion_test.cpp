#include "condyle/io/joint_file.hpp"

#include <fmt/format.h>

#include "condyle/io/mesh_file.hpp"
#include "io/motion/some_pose.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

/// Recorded poses of both bodies become poses of the joint, whatever its frame.

namespace condyle {
namespace {

/// Where the mobile body's frame is in the fixed body's, and the fixed body's in that of a laboratory.
const Pose X_FM_recorded = test::some_pose(0.6, {1, -2, 3}, {12, -40, 7});
const Pose X_LF = test::some_pose(2.1, {3, 1, -1}, {500, 120, -80});

/// A mobile body, and as the fixed one the same where the recording has it: in the pose read, each vertex of the one is at
/// that of the other, without any arithmetic of frames here.
class RecordedBodies {
 public:
  /// Lengths of all files are in mm / mm_per_unit.
  explicit RecordedBodies(double mm_per_unit, const Pose& X_FM = X_FM_recorded) {
    const auto scaled = [&](const TriMesh& mesh) {
      TriMesh out = mesh;
      for (auto* of : {&out.vertices.x, &out.vertices.y, &out.vertices.z})
        for (double& value : *of) value /= mm_per_unit;
      return out;
    };
    const TriMesh body = test::box({-11, -95, -7}, {13, -20, 9});
    io::write_mesh(folder_ / "mobile.ply", scaled(body));
    io::write_mesh(folder_ / "fixed.ply", scaled(posed(X_FM, Mesh(body))));
    std::string names, numbers;
    const auto add = [&](const char* name, const Pose& X) {
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) {
          const bool is_length = column == 3 && row < 3;
          names += fmt::format("{}{}_T{}{}", names.empty() ? "" : ",", name, row + 1, column + 1);
          numbers += fmt::format("{}{}", numbers.empty() ? "" : ",",
                                 X.matrix()(row, column) / (is_length ? mm_per_unit : 1));
        }
    };
    add("F", X_LF), add("M", X_LF * X_FM);
    folder_.file("motion.csv", names + "\n" + numbers + "\n");
  }

  /// The joint with this in its tables, and the motion it has.
  std::string joint(const std::string& kind, const std::string& units, const std::string& of_fixed,
                    const std::string& of_mobile, const std::string& more,
                    std::string_view centre = "[0, 0, 0]", std::string_view axes = test::plain_axes) const {
    return test::joint_text(
        {.kind = kind,
         .units = units,
         .keys = kind == "free" ? "joint = \"knee\"\n" : "",
         .fixed = "mesh = \"fixed.ply\"\n" + of_fixed,
         .mobile = "mesh = \"mobile.ply\"\n" + of_mobile,
         .centre = centre,
         .axes = axes,
         .more = more + "\n[recorded_motion]\nfixed_body = \"F\"\nmobile_body = \"M\"\nunits = \"" + units +
                 "\"\n"});
  }
  void expect_bodies_together(const std::string& joint_file) const {
    const io::LoadedJoint loaded = io::read_joint(folder_.file("knee.toml", joint_file));
    const io::JointMotion motion = io::motion_of(loaded, io::read_motion_table(folder_ / "motion.csv"));
    ASSERT_EQ(motion.X_FM.size(), 1u);
    const auto &fixed = loaded.joint.fixed.mesh, &mobile = loaded.joint.mobile.mesh;
    ASSERT_EQ(fixed.vertices().size(), mobile.vertices().size());
    for (std::size_t v = 0; v < fixed.vertices().size(); ++v) {
      // Some ten products of coordinates below 1000 mm, each rounded.
      EXPECT_LE((*motion.X_FM[0] * mobile.vertices()[v] - fixed.vertices()[v]).norm(), 1e-11) << joint_file;
    }
  }
  const test::TemporaryFolder& folder() const { return folder_; }

 private:
  test::TemporaryFolder folder_;
};

TEST(JointMotion, RecordedPosesMoveTheMeshesAlikeInAnyJointFrame) {
  const RecordedBodies bodies(1);
  const auto origin = "[0, 0, 0]", elsewhere = "[5, -6, 70]",
             turned = "anterior = [0, -0.6, 0.8]\nsuperior = [0, 0.8, 0.6]\n";
  const std::string posed_body = "pose = [0.6, -0.8, 0, 5,  0.8, 0.6, 0, -6,  0, 0, 1, 7,  0, 0, 0, 1]";
  const std::string in_reference = "[reference_pose]\nflexion = 33\nadduction = -4\nx = 3\nz = -8";
  for (const auto& [centre, axes] : {std::pair{origin, test::plain_axes.data()},
                                     {elsewhere, test::plain_axes.data()},
                                     {elsewhere, turned}})
    for (const std::string& of_fixed : {std::string(), posed_body})
      for (const std::string& of_mobile : {std::string(), posed_body})
        for (const std::string& more : {std::string(), in_reference})
          bodies.expect_bodies_together(bodies.joint("free", "mm", of_fixed, of_mobile, more, centre, axes));
}

TEST(JointMotion, RecordedPosesInMetresAreThoseInMillimetres) {
  const RecordedBodies bodies(1000);
  bodies.expect_bodies_together(bodies.joint(
      "free", "m", "", "pose = [0.6, -0.8, 0, 0.005,  0.8, 0.6, 0, -0.006,  0, 0, 1, 0.007,  0, 0, 0, 1]",
      "[reference_pose]\nflexion = 33\nx = 0.003", "[0.005, -0.006, 0.07]",
      "anterior = [0, -0.6, 0.8]\nsuperior = [0, 0.8, 0.6]\n"));
}

/// Along the joint's axes a bent knee's y is along the tibia: at 90 degrees of flexion the femur's X.
TEST(JointMotion, TranslationsAreRecordedAlongTheAxesThatTheJointNames) {
  const test::TemporaryFolder folder;
  io::write_mesh(folder / "body.ply", test::box({-11, -95, -7}, {13, -20, 9}));
  const io::MotionTable table = io::read_motion_table(
      folder.file("bent.csv", "time,flexion_deg,x_mm,y_mm,z_mm\n0,90,1,10,2\n1,0,1,10,2\n"));
  for (const bool along_joint : {false, true}) {
    const io::LoadedJoint knee = io::read_joint(folder.file(
        "knee.toml", test::joint_text({.kind = "free",
                                       .keys = "joint = \"knee\"\ntranslation_frame = \"" +
                                               std::string(along_joint ? "joint_axes" : "fixed") + "\"\n",
                                       .fixed = "mesh = \"body.ply\"",
                                       .mobile = "mesh = \"body.ply\""})));
    const io::JointMotion motion = io::motion_of(knee, table);
    const Vec3 bent = along_joint ? Vec3(10, -1, 2) : Vec3(1, 10, 2);
    EXPECT_LE((motion.X_FM[0]->translation() - bent).norm(), 1e-14) << along_joint;
    EXPECT_EQ(motion.X_FM[1]->translation(), Vec3(1, 10, 2)) << "the same at zero angles";
  }
}

/// Turns about a point that stays where it is: a ball there, and no ball anywhere else.
TEST(JointMotion, ABallDoesNotTranslate) {
  const Vec3 centre(5, -6, 70);
  Pose about_centre = test::some_pose(0.6, {1, -2, 3}, Vec3::Zero());
  about_centre.translation() = centre - about_centre.linear() * centre;
  const RecordedBodies bodies(1, about_centre);
  bodies.expect_bodies_together(bodies.joint("ball", "mm", "", "", "", "[5, -6, 70]"));
  const io::LoadedJoint off =
      io::read_joint(bodies.folder().file("off.toml", bodies.joint("ball", "mm", "", "", "")));
  EXPECT_EQ(test::complaint_of<FileError>(
                [&] { io::motion_of(off, io::read_motion_table(bodies.folder() / "motion.csv")); }),
            fmt::format("{}: line 2: the mobile body's centre is {:.3f} mm from the fixed "
                        "body's, and a ball does not translate",
                        (bodies.folder() / "motion.csv").string(), about_centre.translation().norm()));
}

/// What condyle motion writes: its coordinates are the joint's own, whatever columns the recording had.
TEST(JointMotion, CurvesOfAMotionAreReadAgain) {
  const RecordedBodies bodies(1);
  const auto read = [&](const std::string& mapping, const char* table) {
    std::string file = bodies.joint("free", "mm", "", "", "");
    file = file.substr(0, file.find("[recorded_motion]")) + mapping;
    const io::LoadedJoint joint = io::read_joint(bodies.folder().file("knee.toml", file));
    const io::JointMotion motion =
        io::motion_of(joint, io::read_motion_table(bodies.folder().file("curves.csv", table)));
    EXPECT_TRUE(motion.times.in_seconds);
    EXPECT_EQ(motion.times.values, (std::vector<double>{0.5, 0.75}));
    const JointCoordinates at = io::coordinates_of(joint.joint, motion)[1];
    EXPECT_NEAR(at.translation_mm.y(), 4, 1e-12);
    bool is_noted = false;
    for (const std::string& remark : motion.processing)
      is_noted |= remark.find("not [recorded_motion]") != remark.npos;
    return std::pair(at.angles.flexion.degrees(), is_noted);
  };
  const auto curves =
      "time_s,smallest_gap_mm,flexion_deg,adduction_deg,internal_rotation_deg,x_mm,y_mm,z_mm\n"
      "0.5,1.5,0,0,0,0,0,0\n0.75,2.5,30,0,0,0,4,0\n";
  for (const char* mapping : {"[recorded_motion]\nfixed_body = \"F\"\nmobile_body = \"M\"\nunits = \"mm\"\n",
                              "[recorded_motion]\nflexion = \"knee_flex_r\"\n",
                              "[recorded_motion]\nmodel = \"knee.osim\"\njoint = \"knee_r\"\n"}) {
    const auto [flexion_deg, is_noted] = read(mapping, curves);
    EXPECT_NEAR(flexion_deg, 30, 1e-12) << mapping;
    EXPECT_TRUE(is_noted) << mapping;
  }
  EXPECT_FALSE(read("", curves).second) << "nothing else was to be read";
  const std::string turned =
      "[recorded_motion]\nflexion = { column = \"flexion_deg\", unit = \"deg\", sign = -1 }\n"
      "y = { column = \"y_mm\", unit = \"mm\" }\n";
  EXPECT_NEAR(read(turned, curves).first, -30, 1e-12) << "a mapping that names the column counts";
}

TEST(JointMotion, NotesTimesThatLookLikeMilliseconds) {
  const test::TemporaryFolder folder;
  io::write_mesh(folder / "fixed.ply", test::box({1, 1, 1}, {2, 2, 2}));
  io::write_mesh(folder / "mobile.ply", test::box({-2, -2, -2}, {-1, -1, -1}));
  const io::LoadedJoint joint = io::read_joint(folder.file("hip.toml", test::joint_text({})));
  const auto codes = [&](const char* table) {
    std::vector<motion::ContactNoteCode> found;
    for (const auto& note : io::motion_of(joint, io::read_motion_table(folder.file("m.csv", table))).notes)
      found.push_back(note.code);
    return found;
  };
  EXPECT_EQ(codes("time,flexion_deg\n500,10\n510,20\n520,30\n"),
            std::vector{motion::ContactNoteCode::unlikely_times});
  EXPECT_TRUE(codes("time,flexion_deg\n0.5,10\n0.51,20\n0.52,30\n").empty());
  EXPECT_TRUE(codes("time,flexion_deg\n0,10\n1,20\n2,30\n").empty());
  EXPECT_EQ(codes("time_s,flexion_deg\n500,10\n510,20\n520,30\n").size(), 1u);
  EXPECT_TRUE(codes("frame,flexion_deg\n500,10\n510,20\n520,30\n").empty()) << "numbers of frames";
}

}  // namespace
}  // namespace condyle
