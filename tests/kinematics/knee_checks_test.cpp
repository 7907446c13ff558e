#include "kinematics/knee_checks.hpp"

#include "kinematics/knee_anatomy.hpp"
#include "support/drawn_bones.hpp"
#include "support/test.hpp"

/// A femur's condyles contradict wrong axes and sides of a knee, and never right ones.

namespace condyle::kinematics {
namespace {

using test::any_pose, test::scanned;
using Code = JointNoteCode;

struct Bones {
  TriMesh femur, other;
  Side side = Side::right;
};

/// In the joint frame, turned and moved by X, with noise.
Joint knee_of(const Bones& bones, Side side, const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity(),
              double noise = 0, unsigned seed = 1) {
  const auto placed = [&](const TriMesh& bone, unsigned of_bone) {
    return test::turned(scanned(bone, Pose::Identity(), noise, seed + of_bone), turn);
  };
  Joint joint{
      "knee", JointKind::free, side, {"femur", placed(bones.femur, 0)}, {"tibia", placed(bones.other, 1)}};
  joint.anatomy = Anatomy::knee;
  return joint;
}

std::optional<Code> code_of(const Joint& joint) {
  const auto note = condyle_note(joint, Pose::Identity());
  if (!note) return std::nullopt;
  test::expect_silent(note->text, "\n");
  return note->code;
}

Eigen::Matrix3d about(const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis).toRotationMatrix();
}
Eigen::Matrix3d mirror_in(const Vec3& normal) {
  return Eigen::Matrix3d::Identity() - 2 * normal * normal.transpose();
}

/// All ways to set up a knee wrongly, and right ones.
void expect_notes(const Bones& bones, double noise = 0, unsigned seed = 1) {
  const Side right = bones.side, left = right == Side::right ? Side::left : Side::right;
  const auto code = [&](Side side, const Eigen::Matrix3d& turn) {
    return code_of(knee_of(bones, side, turn, noise, seed));
  };
  const Eigen::Matrix3d as_it_is = Eigen::Matrix3d::Identity(), in_z = mirror_in(Vec3::UnitZ()),
                        in_x = mirror_in(Vec3::UnitX());
  EXPECT_EQ(code(right, as_it_is), std::nullopt);
  EXPECT_EQ(code(left, in_z), std::nullopt) << "the mirror image is a left knee";
  for (const Vec3 axis : {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()})
    for (const double degrees : {-15.0, 15.0})
      EXPECT_EQ(code(right, about(axis, degrees)), std::nullopt) << degrees << " about " << axis.transpose();
  EXPECT_EQ(code(left, as_it_is), Code::wrong_side);
  EXPECT_EQ(code(right, in_z), Code::wrong_side) << "a mirrored mesh";
  EXPECT_EQ(code(right, about(Vec3::UnitY(), 180)), Code::axes_turned) << "LPS read as RAS";
  EXPECT_EQ(code(left, in_z * about(Vec3::UnitY(), 180)), Code::axes_turned);
  EXPECT_EQ(code(right, in_x), Code::mirrored);
  EXPECT_EQ(code(left, about(Vec3::UnitY(), 180)), Code::mirrored)
      << "medial is where it should be, front is behind";
  for (const double degrees : {-90.0, 90.0}) {
    EXPECT_EQ(code(right, about(Vec3::UnitY(), degrees)), Code::axes_turned) << degrees;
    EXPECT_EQ(code(right, about(Vec3::UnitX(), degrees)), Code::axes_not_upright) << degrees;
    EXPECT_EQ(code(right, about(Vec3::UnitZ(), degrees)), Code::axes_not_upright) << degrees;
  }
  EXPECT_EQ(code(right, about(Vec3::UnitX(), 180)), Code::axes_not_upright);
}

TEST(KneeChecks, NoteWrongAxesAndSidesOfADrawnKneeAndNoRightOnes) {
  const Bones bones{test::femur_of({}), test::tibia_of_knee()};
  expect_notes(bones);
  expect_notes(bones, 0.3, 7);
}

TEST(KneeChecks, NeedNoMoreThanTheyCanSee) {
  const TriMesh tibia = test::tibia_of_knee();
  const Bones stump{test::femur_of({.length = 60}), tibia}, no_side{test::femur_of({.lean_deg = 1}), tibia};
  const auto turned = [](const Bones& bones, double degrees) {
    return code_of(knee_of(bones, Side::right, about(Vec3::UnitY(), degrees)));
  };
  EXPECT_EQ(turned(stump, 0), std::nullopt);
  EXPECT_EQ(turned(stump, 180), std::nullopt) << "front and back of a stump are not shown";
  EXPECT_EQ(turned(stump, 90), Code::axes_turned) << "its axis is";
  EXPECT_EQ(turned(no_side, 0), std::nullopt);
  EXPECT_EQ(turned(no_side, 180), Code::axes_turned);
  EXPECT_EQ(code_of(knee_of(no_side, Side::left)), std::nullopt);
  for (const TriMesh& no_femur :
       {test::box({-30, -20, -40}, {30, 100, 40}), test::sphere(Vec3::Zero(), 25, 4), tibia})
    for (const double degrees : {0.0, 90.0, 180.0})
      EXPECT_EQ(turned({no_femur, tibia}, degrees), std::nullopt);
  EXPECT_EQ(turned({test::femur_of({}), test::box({-30, -200, -40}, {30, -100, 40})}, 180), std::nullopt)
      << "the bones are far apart";
}

TEST(KneeChecks, TakeTheMobileBodyWhereItIsPosed) {
  Joint joint = knee_of({test::femur_of({}), test::tibia_of_knee()}, Side::left);
  Pose away(Eigen::Translation3d(0, -300, 0));
  EXPECT_FALSE(condyle_note(joint, away));
  joint.mobile.mesh = Mesh(posed(away.inverse(), TriMesh(joint.mobile.mesh)));
  const auto note = condyle_note(joint, away);
  ASSERT_TRUE(note);
  EXPECT_EQ(note->code, Code::wrong_side);
  EXPECT_EQ(
      note->text,
      "the side is left, but femur is shaped as that of a right knee: it is the other side's or mirrored");
}

class SharedKneeChecks : public testing::Test {
 protected:
  void SetUp() override {
    data_ = test::shared_data();
    if (!data_) GTEST_SKIP() << "no shared data: set CONDYLE_DATA";
  }
  TriMesh read(const char* name) const { return test::read_ply(*data_ / name); }
  std::optional<std::filesystem::path> data_;
};

TEST_F(SharedKneeChecks, NoteWrongAxesAndSidesOfRealFemoraAndNoRightOnes) {
  const TriMesh lenhart = read("knee_lenhart2015_right/femur_bone.ply");
  expect_notes({lenhart, read("knee_lenhart2015_right/tibia_bone.ply")});
  expect_notes({read("hip_vhf_right/femur.ply"), test::box({-50, -440, -35}, {0, -405, 35})});
  expect_notes({lenhart, test::shifted_by(read("knee_lenhart2015_right/patella_bone.ply"), {53, 5, 4})});
}

/// Knees that are cut, rough and turned by some degrees are right too. CONDYLE_LONG_TESTS=1 makes 1280 scans.
TEST_F(SharedKneeChecks, SayNothingOfCutAndRoughFemora) {
  const bool is_long = std::getenv("CONDYLE_LONG_TESTS") != nullptr;
  const Bones knees[] = {
      {read("knee_lenhart2015_right/femur_bone.ply"), read("knee_lenhart2015_right/tibia_bone.ply")},
      {read("hip_vhf_right/femur.ply"), test::box({-50, -440, -35}, {0, -405, 35})}};
  for (const Bones& whole : knees) {
    double lowest = HUGE_VAL;
    for (const double y : whole.femur.vertices.y) lowest = std::min(lowest, y);
    for (const double rough : {0.0, 0.3, 0.6, 1.0})
      for (const double height : {1000.0, 120.0, 105.0, 95.0, 80.0})
        for (unsigned i = 0; i < (is_long ? 16u : 1u); ++i)
          for (const bool is_left : {false, true}) {
            SCOPED_TRACE(testing::Message() << rough << " mm rough, cut at " << height << ", turn " << i);
            const Vec3 normal = (Vec3::UnitY() + 0.15 * Vec3(std::sin(i), 0, std::cos(3.0 * i))).normalized();
            Bones bones = whole;
            std::erase_if(bones.femur.triangles, [&](const Triangle& t) {
              return std::any_of(t.begin(), t.end(), [&](Index v) {
                return normal.dot(whole.femur.vertices[v] - Vec3(0, lowest, 0)) > height;
              });
            });
            const Eigen::Matrix3d mirrored =
                is_left ? mirror_in(Vec3::UnitZ()) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
            const Eigen::Matrix3d turn =
                about(Vec3(std::cos(2.0 * i), std::sin(5.0 * i), 1).normalized(), 12.0) * mirrored;
            const Joint joint = knee_of(bones, is_left ? Side::left : Side::right, turn, rough, 3 * i);
            EXPECT_EQ(code_of(joint), std::nullopt);
            // Silent because nothing is wrong, not because it sees nothing.
            if (height > 900 && rough < 0.5) {
              EXPECT_TRUE(code_of(knee_of(bones, Side::right, about(Vec3::UnitY(), 180), rough, 3 * i)));
            }
          }
  }
}

/// The axis that a check sees is that of the thorough search.
TEST_F(SharedKneeChecks, SeeTheAxisOfTheThoroughSearch) {
  const TriMesh femur = read("knee_lenhart2015_right/femur_bone.ply"),
                tibia = read("knee_lenhart2015_right/tibia_bone.ply");
  for (const double rough : {0.0, 0.3, 0.6}) {
    const TriMesh scan = scanned(femur, Pose::Identity(), rough, 5);
    const KneeAnatomy thorough = knee_anatomy(scan, tibia),
                      rough_one = knee_anatomy_roughly(scan, tibia, Pose::Identity());
    ASSERT_TRUE(thorough.condyles && rough_one.condyles);
    const Cylinder &a = thorough.condyles->fit.cylinder, &b = rough_one.condyles->fit.cylinder;
    EXPECT_LT(test::degrees_between(a.direction, b.direction), 2);
    EXPECT_LT((a.point - b.point).norm(), 1.5);
    EXPECT_EQ(thorough.side, rough_one.side);
  }
}

}  // namespace
}  // namespace condyle::kinematics
