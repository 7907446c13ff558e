#include "condyle/range_of_motion.hpp"

#include "motion/motion_cases.hpp"
#include "support/test.hpp"

/// Limits by allowed depth, where the depth is known.

namespace condyle::motion {
namespace {

using namespace test;

/// A spike on a wheel about Z: its tip, at radius 30 and 20 degrees from -Y, turns under a flat ceiling over
/// it. Rays are radial, the ceiling's plane is x = 20, so at flexion f the tip is inside when 30 sin(20 + f)
/// > 20, and its radial depth is 30 - 20 / sin(20 + f).
constexpr double tip_radius = 30, tip_angle = 20, wall = 20;

Joint spike_and_wall() {
  const double deg = std::numbers::pi / 180;
  const Vec3 tip(tip_radius * std::sin(tip_angle * deg), -tip_radius * std::cos(tip_angle * deg), 0);
  TriMesh spike;
  // A thin tetrahedron about the line from behind the centre to the tip: the centre is inside.
  const Vec3 u = tip.normalized(), v(-u.y(), u.x(), 0), w(0, 0, 1);
  for (const Vec3& p :
       {Vec3(-2 * u + 0.5 * v), Vec3(-2 * u - 0.25 * v + 0.5 * w), Vec3(-2 * u - 0.25 * v - 0.5 * w), tip})
    spike.vertices.push_back(p);
  spike.triangles = {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}};
  const Vec3 a = spike.corner(0, 0), n = (spike.corner(0, 1) - a).cross(spike.corner(0, 2) - a);
  if (n.dot(tip - a) > 0) spike = flipped(spike);
  return {
      "spike", JointKind::ball, Side::right, {"wall", box({wall, -80, -50}, {90, 80, 50})}, {"spike", spike}};
}

double limit_deg(double depth) {
  return std::asin(wall / (tip_radius - depth)) * 180 / std::numbers::pi - tip_angle;
}

TEST(DepthLimit, IsWhereTheRadialDepthIsTheAllowedOne) {
  for (const double depth : {0.0, 0.25, 2.0}) {
    const DepthLimit found = DepthRange(spike_and_wall(), {.depth_mm = depth}).limit(flexion());
    EXPECT_EQ(found.limit.end.reason, LimitReason::contact);
    // Allowed at the answer, too deep at most the tolerance after it.
    EXPECT_LE(found.limit.end.turned.degrees(), limit_deg(depth) + 1e-9);
    EXPECT_GE(found.limit.end.turned.degrees(), limit_deg(depth) - 1e-3 - 1e-9);
    EXPECT_LE(found.at_limit.depth_mm, depth + 1e-9);
    EXPECT_TRUE(found.depth_grows);
    EXPECT_EQ(found.limit.end.contact->mobile_feature, (Feature{FeatureKind::vertex, 3}));
    EXPECT_EQ(found.start_depth_mm, 0);
  }
}

TEST(DepthLimit, WithNothingAllowedIsTheExactLimit) {
  const Joint joint = spike_and_wall();
  const MotionLimit exact = RangeOfMotion(joint).limit(flexion());
  const DepthLimit found = DepthRange(joint, {.depth_mm = 0}).limit(flexion());
  EXPECT_NEAR(found.limit.end.turned.degrees(), exact.end.turned.degrees(), 1e-3);
}

TEST(DepthLimit, ReportsWhereTheStartIsTooDeepOrTheRangeEndsFirst) {
  const Joint joint = spike_and_wall();
  Motion late = flexion();
  late.start.flexion = Angle::degrees(limit_deg(1));
  const DepthLimit start = DepthRange(joint, {.depth_mm = 0.9}).limit(late);
  EXPECT_EQ(start.limit.end.reason, LimitReason::contact_at_start);
  EXPECT_NEAR(start.start_depth_mm, 1, 1e-9);
  Motion brief = flexion();
  brief.range = Angle::degrees(limit_deg(0.5));
  const DepthLimit end = DepthRange(joint, {.depth_mm = 0.6}).limit(brief);
  EXPECT_EQ(end.limit.end.reason, LimitReason::end_of_range);
  EXPECT_EQ(end.limit.end.turned, brief.range);
}

TEST(DepthLimit, RefusesWhatItCannotAnswer) {
  const Joint joint = spike_and_wall();
  EXPECT_THROW(DepthRange(joint, {.depth_mm = -1}), UsageError);
  EXPECT_THROW(DepthRange(joint, {.depth_mm = NAN}), UsageError);
  EXPECT_THROW(DepthRange(joint, {.step = Angle()}), UsageError);
  EXPECT_THROW(DepthRange(joint, {.tolerance = Angle::degrees(2)}), UsageError);
  Joint open = joint;
  TriMesh without_one = open.fixed.mesh;
  without_one.triangles.pop_back();
  open.fixed.mesh = without_one;
  EXPECT_THROW(DepthRange(open, {.depth_mm = 1}), MeshError);
}

}  // namespace
}  // namespace condyle::motion
