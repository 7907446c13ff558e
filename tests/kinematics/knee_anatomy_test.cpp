#include "kinematics/knee_anatomy.hpp"

#include <span>

#include "support/drawn_bones.hpp"
#include "support/test.hpp"

/// The frames of drawn knees with known axes, and of real ones.

namespace condyle::kinematics {
namespace {

using test::degrees_between, test::mirrored, test::scanned;

/// Largest errors of an axis that is inferred.
constexpr double most_deg = 3, most_mm = 2;

KneeAnatomy seen(const TriMesh& femur, const TriMesh& tibia, const Pose& X = Pose::Identity(),
                 double noise = 0, unsigned seed = 1) {
  return knee_anatomy(scanned(femur, X, noise, seed), scanned(tibia, X, noise, seed + 1));
}

void expect_frame(const KneeAnatomy& knee, const Pose& X, const Vec3& centre = Vec3::Zero()) {
  ASSERT_TRUE(knee.condyles) << knee.why_no_condyles;
  EXPECT_LT((knee.condyles->fit.cylinder.point - X * centre).norm(), most_mm);
  ASSERT_TRUE(knee.axes) << knee.why_no_axes;
  EXPECT_LT(degrees_between(knee.axes->right(), X.linear() * Vec3::UnitZ()), most_deg);
  EXPECT_LT(degrees_between(knee.axes->superior, X.linear() * Vec3::UnitY()), most_deg);
  EXPECT_LT(degrees_between(knee.axes->anterior, X.linear() * Vec3::UnitX()), most_deg);
}

TEST(KneeAnatomy, OfADrawnKneeIsFoundInAnyPoseWithNoise) {
  const TriMesh femur = test::femur_of({}), tibia = test::tibia_of_knee();
  for (unsigned i = 0; i < 2; ++i)
    for (const bool is_left : {false, true}) {
      SCOPED_TRACE(testing::Message() << "pose " << i << (is_left ? ", left" : ", right"));
      const Pose X = test::any_pose(i);
      const KneeAnatomy knee =
          is_left ? seen(mirrored(femur), mirrored(tibia), X, 0.3, i) : seen(femur, tibia, X, 0.3, i);
      expect_frame(knee, X);
      ASSERT_TRUE(knee.side) << knee.why_no_side;
      EXPECT_EQ(*knee.side, is_left ? Side::left : Side::right);
      EXPECT_EQ(knee.evidence.size(), 5u);
    }
}

TEST(KneeAnatomy, OfAFemurCutAboveItsCondylesHasAnAxisAndNoDirections) {
  const KneeAnatomy knee = seen(test::femur_of({.length = 60}), test::tibia_of_knee());
  ASSERT_TRUE(knee.condyles) << knee.why_no_condyles;
  EXPECT_LT(degrees_between(Vec3::UnitZ(), knee.condyles->fit.cylinder.direction), most_deg);
  EXPECT_FALSE(knee.axes);
  test::expect_says(knee.why_no_axes, "does not go on far enough");
  EXPECT_FALSE(knee.side);
}

TEST(KneeAnatomy, WithoutAShaftInFrontOfTheAxisHasNoFront) {
  const KneeAnatomy knee = seen(test::femur_of({.shaft_ahead = 6}), test::tibia_of_knee());
  ASSERT_TRUE(knee.condyles) << knee.why_no_condyles;
  EXPECT_FALSE(knee.axes);
  EXPECT_EQ(knee.why_no_axes, "shaft and condyles do not agree on front and back");
}

TEST(KneeAnatomy, WithOneSignOfTheSideOnlyHasNone) {
  const TriMesh tibia = test::tibia_of_knee();
  for (const test::DrawnFemur& drawn : {test::DrawnFemur{.lean_deg = 1}, {.ridge = 0}, {.ridge = -4}}) {
    const KneeAnatomy knee = seen(test::femur_of(drawn), tibia);
    EXPECT_TRUE(knee.axes) << knee.why_no_axes;
    EXPECT_FALSE(knee.side);
    EXPECT_FALSE(knee.why_no_side.empty());
  }
}

TEST(KneeAnatomy, WithAMobileBodyInFrontHasNoAxes) {
  const KneeAnatomy knee = seen(test::femur_of({}), test::box({42, 0, -20}, {60, 40, 20}));
  ASSERT_TRUE(knee.condyles) << knee.why_no_condyles;
  EXPECT_FALSE(knee.axes);
  test::expect_says(knee.why_no_axes, "as a tibia does");
}

TEST(KneeAnatomy, OfOtherBodiesIsEmptyWithTheReason) {
  const TriMesh femur = test::femur_of({}), tibia = test::tibia_of_knee();
  const KneeAnatomy exchanged = seen(tibia, femur);
  EXPECT_FALSE(exchanged.condyles);
  EXPECT_FALSE(exchanged.why_no_condyles.empty());
  EXPECT_FALSE(seen(test::sphere(Vec3::Zero(), 25, 4), tibia).condyles);
  EXPECT_FALSE(seen(test::box({-30, -20, -40}, {30, 100, 40}), tibia).condyles);
  EXPECT_EQ(seen(femur, test::box({-30, -200, -40}, {30, -100, 40})).why_no_condyles.substr(0, 13),
            "the bones are");
  EXPECT_EQ(knee_anatomy(femur, TriMesh{}).why_no_condyles, "a bone has no surface");
}

/// As where each mesh lies in a frame of its own: what is nearest the tibia is the femur's head.
TEST(KneeAnatomy, OfMeshesInUnrelatedFramesTakesNoHeadForCondyles) {
  FOUND_OR_SKIP(data, test::shared_data());
  const TriMesh femur = test::read_ply(*data / "hip_vhf_right/femur.ply");
  for (const TriMesh& tibia :
       {test::read_ply(*data / "knee_lenhart2015_right/tibia_bone.ply"),
        test::box({-30, 25, -30}, {30, 50, 30}), test::box({-30, -60, -60}, {30, -10, -10})}) {
    const KneeAnatomy thorough = knee_anatomy(femur, tibia),
                      rough = knee_anatomy_roughly(femur, tibia, Pose::Identity());
    for (const KneeAnatomy& knee : {thorough, rough}) {
      EXPECT_FALSE(knee.condyles);
      EXPECT_FALSE(knee.axes || knee.side);
    }
  }
  const KneeAnatomy knee =
      knee_anatomy(femur, test::read_ply(*data / "knee_lenhart2015_right/tibia_bone.ply"));
  test::expect_says(knee.why_no_condyles, "is a head, ");
  test::expect_says(knee.why_no_condyles, "do both meshes lie in one frame?");
}

class SharedKnee : public testing::Test {
 protected:
  void SetUp() override {
    FOUND_OR_SKIP(data, test::shared_data());
    femur_ = test::read_ply(*data / "knee_lenhart2015_right/femur_bone.ply");
    tibia_ = test::read_ply(*data / "knee_lenhart2015_right/tibia_bone.ply");
  }
  TriMesh femur_, tibia_;
};

/// Its model turns the knee about Z through the origin, with Y along the femur.
TEST_F(SharedKnee, HasTheAxesOfItsModelInAnyPose) {
  for (const bool is_turned : {false, true})
    for (const bool is_left : {false, true}) {
      const Pose X = is_turned ? test::any_pose(3) : Pose::Identity();
      const KneeAnatomy knee =
          is_left ? seen(mirrored(femur_), mirrored(tibia_), X) : seen(femur_, tibia_, X);
      expect_frame(knee, X, Vec3(-2, 0, 0));
      ASSERT_TRUE(knee.side) << knee.why_no_side;
      EXPECT_EQ(*knee.side, is_left ? Side::left : Side::right);
      EXPECT_GT(knee.epicondyles->to_axis_deg, 2) << "they are nearly one axis, not quite";
      EXPECT_LT(knee.epicondyles->to_axis_deg, 9);
    }
}

TEST_F(SharedKnee, HasNoCondylesOnItsTibia) {
  const KneeAnatomy exchanged = knee_anatomy(tibia_, femur_);
  EXPECT_FALSE(exchanged.condyles);
}

/// The triangles whose corners are all on one side of a plane.
TriMesh cut(const TriMesh& mesh, const Vec3& normal, double offset) {
  TriMesh kept = mesh;
  std::erase_if(kept.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](Index v) { return normal.dot(mesh.vertices[v]) > offset; });
  });
  return kept;
}

/// Both real femora, whole and cut at several heights by oblique planes, smooth and rough: what is said agrees with what the
/// whole smooth bone shows. CONDYLE_LONG_TESTS=1 makes 480 scans.
TEST(KneeAnatomy, OfCutAndRoughFemoraAgreesWithTheWholeOnes) {
  FOUND_OR_SKIP(data, test::shared_data());
  struct Knee {
    TriMesh femur, tibia;
  };
  const Knee knees[] = {
      {test::read_ply(*data / "hip_vhf_right/femur.ply"), test::box({-50, -440, -35}, {0, -405, 35})},
      {test::read_ply(*data / "knee_lenhart2015_right/femur_bone.ply"),
       test::read_ply(*data / "knee_lenhart2015_right/tibia_bone.ply")}};
  const bool is_long = std::getenv("CONDYLE_LONG_TESTS") != nullptr;
  for (const auto& [femur, tibia] : std::span(knees).first(is_long ? 2 : 1)) {
    const KneeAnatomy whole = knee_anatomy(femur, tibia);
    ASSERT_TRUE(whole.axes);
    const Cylinder& axis = whole.condyles->fit.cylinder;
    for (const double rough : {0.0, 0.3, 0.6})
      for (const double height : {1000.0, 85.0, 70.0, 60.0, 45.0})
        for (unsigned i = 0; i < (is_long ? 16u : 1u); ++i) {
          SCOPED_TRACE(testing::Message() << rough << " mm rough, cut at " << height << ", pose " << i);
          const Vec3 normal = (Vec3::UnitY() + 0.15 * Vec3(std::sin(i), 0, std::cos(3.0 * i))).normalized();
          const Pose X = test::any_pose(i);
          const KneeAnatomy knee = knee_anatomy(
              scanned(cut(femur, normal, normal.dot(axis.point) + height), X, rough, i), posed(X, tibia));
          if (!knee.condyles) continue;
          const Cylinder& found = knee.condyles->fit.cylinder;
          const Vec3 expected = X.linear() * axis.direction;
          EXPECT_LT(degrees_between(found.direction,
                                    found.direction.dot(expected) < 0 ? Vec3(-expected) : expected),
                    most_deg);
          EXPECT_LT((found.point - X * axis.point).cross(expected).norm(), most_mm);
          // Without its head a femur's up is its shaft's, some degrees off.
          constexpr double head_or_shaft_deg = 10;
          if (knee.axes) {
            EXPECT_LT(degrees_between(knee.axes->anterior, X.linear() * whole.axes->anterior),
                      head_or_shaft_deg);
          }
          if (knee.side) {
            EXPECT_EQ(*knee.side, Side::right);
          }
        }
  }
}

/// The Visible Human's femur is in the scanner's axes, leg straight; its own landmarks lie on both condyles.
TEST(KneeAnatomy, OfAWholeFemurGoesByItsHead) {
  FOUND_OR_SKIP(data, test::shared_data());
  const TriMesh femur = test::read_ply(*data / "hip_vhf_right/femur.ply");
  const TriMesh below = test::box({-50, -440, -35}, {0, -405, 35});
  for (const bool is_left : {false, true}) {
    const KneeAnatomy knee = is_left ? seen(mirrored(femur), mirrored(below)) : seen(femur, below);
    ASSERT_TRUE(knee.axes) << knee.why_no_axes;
    ASSERT_TRUE(knee.head);
    // The fit of the data set's README.
    EXPECT_NEAR(knee.head->fit.sphere.radius, 23.857, 0.3);
    EXPECT_GT(knee.axes->anterior.x(), 0.95);
    EXPECT_GT(knee.axes->superior.y(), 0.95);
    ASSERT_TRUE(knee.side);
    EXPECT_EQ(*knee.side, is_left ? Side::left : Side::right);
  }
}

}  // namespace
}  // namespace condyle::kinematics
