#include "condyle/range_of_motion.hpp"

#include "condyle/contact.hpp"
#include "motion/joint_scenes.hpp"
#include "support/test.hpp"

/// Paths in several angles: never past a contact, by exact triangle tests; along one angle the exact limit.

namespace condyle::motion {
namespace {

using namespace test;

constexpr Angle tolerance = Angle::degrees(1e-3);

JointAngles degrees(double flexion, double adduction, double rotation) {
  return {Angle::degrees(flexion), Angle::degrees(adduction), Angle::degrees(rotation)};
}

TEST(PathLimit, AlongOneAngleStopsJustShortOfTheExactLimit) {
  for (const JointAngle vary : {JointAngle::flexion, JointAngle::adduction, JointAngle::internal_rotation}) {
    const PostJoint scene = post_joint(vary, Side::left);
    const std::vector<JointAngles> path{{}, turned_by({}, vary, Angle::degrees(170))};
    const PathLimit limit = PathFinder(scene.joint).limit(path, tolerance);
    EXPECT_EQ(limit.reason, LimitReason::contact);
    const double reached = angle_of(limit.at, vary).radians();
    EXPECT_LT(reached, scene.limit);
    // The last step began within the tolerance of contact as seen from the arm's far end (radius 100.01), and
    // the post's edge (89.44) is approached along its circle, up to a cosine that is 1 to four digits.
    EXPECT_GT(reached, scene.limit - tolerance.radians() * 1.2 * 100.01 / 89.44);
  }
}

TEST(PathLimit, OnDiagonalPathsIsNeverPastAContactAndEndsBesideOne) {
  const Joint joint = bumpy_joint(Side::right);
  const PathFinder finder(joint);
  const contact::JointContact exact(joint.fixed.mesh, joint.mobile.mesh);
  std::size_t contacts = 0;
  for (const JointAngles& end : {degrees(80, 20, 10), degrees(-60, 30, 40), degrees(40, -50, -60),
                                 degrees(10, 15, 170), degrees(-90, -40, -30)}) {
    const std::vector<JointAngles> path{{}, end};
    const PathLimit limit = finder.limit(path, tolerance);
    const auto at = [&](double fraction) {
      JointAngles angles;
      for (const JointAngle a : {JointAngle::flexion, JointAngle::adduction, JointAngle::internal_rotation})
        angles = turned_by(angles, a, angle_of(end, a) * fraction);
      return pose_at({.side = Side::right}, angles);
    };
    for (int k = 0; k <= 50; ++k) EXPECT_TRUE(exact.pairs(at(limit.fraction * k / 50)).empty());
    if (limit.reason != LimitReason::contact) continue;
    ++contacts;
    // Within the tolerance at the mobile triangle's largest radius, here below 50 mm.
    EXPECT_LE(limit.distance_mm, tolerance.radians() * 50);
    const Vec3 m = at(limit.fraction) * limit.contact->mobile_point;
    EXPECT_NEAR((m - limit.contact->fixed_point).norm(), limit.distance_mm, 1e-9);
    EXPECT_FALSE(exact.pairs(at(limit.fraction + 0.01)).empty());
  }
  EXPECT_GE(contacts, 3u);
}

TEST(PathLimit, RunsThroughItsWaypointsAndReportsWhichSegmentItEndsOn) {
  const PostJoint scene = post_joint(JointAngle::flexion, Side::right);
  const PathFinder finder(scene.joint);
  const std::vector<JointAngles> around{{}, degrees(-40, 10, 20), degrees(0, -5, 0)};
  const PathLimit whole = finder.limit(around);
  EXPECT_EQ(whole.reason, LimitReason::end_of_range);
  EXPECT_EQ(whole.at, around.back());
  EXPECT_EQ(whole.segment, 1u);
  EXPECT_EQ(whole.fraction, 1.0);
  const std::vector<JointAngles> into{{}, degrees(-40, 0, 0), degrees(80, 0, 0)};
  const PathLimit stopped = finder.limit(into);
  EXPECT_EQ(stopped.segment, 1u);
  EXPECT_NEAR(stopped.at.flexion.radians(), scene.limit, tolerance.radians() * 1.4);
}

TEST(PathLimit, StartingInContactIsReported) {
  const PathFinder finder(overlapping_joint(), {.overlap = {.reference_contact = ReferenceContact::accept}});
  const std::vector<JointAngles> path{{}, degrees(10, 10, 10)};
  const PathLimit limit = finder.limit(path);
  EXPECT_EQ(limit.reason, LimitReason::contact_at_start);
  EXPECT_EQ(limit.fraction, 0.0);
  EXPECT_TRUE(limit.contact);
}

TEST(PathLimit, RefusesPathsThatMakeNoSense) {
  const PathFinder finder(post_joint(JointAngle::flexion, Side::right).joint);
  const auto refused = [&](std::vector<JointAngles> path, Angle t = tolerance) {
    EXPECT_THROW(finder.limit(path, t), UsageError);
  };
  refused({});
  refused({JointAngles{}});
  refused({JointAngles{}, degrees(400, 0, 0)});
  refused({JointAngles{}, degrees(INFINITY, 0, 0)});
  refused({JointAngles{}, degrees(1, 0, 0)}, Angle());
}

}  // namespace
}  // namespace condyle::motion
