#include "condyle/impingement_zone.hpp"

#include "motion/joint_scenes.hpp"
#include "motion/rom/socket_hour.hpp"
#include "support/test.hpp"

/// Clock faces, necks and zones with known geometry.

namespace condyle::motion {
namespace {

using namespace test;

constexpr double deg = std::numbers::pi / 180;

TEST(ClockFace, SaysTwelveForSuperiorAndThreeForAnterior) {
  const ClockFace clock = sagittal_clock();
  EXPECT_EQ(clock.hour_of({0, 1, 5}), 0);
  EXPECT_DOUBLE_EQ(clock.hour_of({1, 0, -7}), 3);
  EXPECT_DOUBLE_EQ(clock.hour_of({0, -1, 0}), 6);
  EXPECT_DOUBLE_EQ(clock.hour_of({-2, 0, 0}), 9);
  EXPECT_DOUBLE_EQ(clock.hour_of({1, 1, 0}), 1.5);
  EXPECT_EQ(clock.hour_of({0, 0, 1}), 0) << "along the normal";
}

TEST(ClockFace, ReadsTheSameOnBothSidesOfTheBody) {
  // An opening 40 degrees down and 15 forwards, right and mirrored left.
  const Vec3 right(std::sin(15 * deg), -std::sin(40 * deg), std::cos(40 * deg)),
      left(right.x(), right.y(), -right.z());
  const ClockFace one = clock_face(right), other = clock_face(left), reversed = clock_face(-right);
  for (int k = 0; k < 24; ++k) {
    const double t = k * 15 * deg;
    const Vec3 p = std::cos(t) * one.twelve + std::sin(t) * one.three + 3 * right;
    EXPECT_NEAR(one.hour_of(p), k * 0.5, 1e-12);
    EXPECT_NEAR(other.hour_of({p.x(), p.y(), -p.z()}), k * 0.5, 1e-12);
    EXPECT_NEAR(reversed.hour_of(p), k * 0.5, 1e-12);
  }
  EXPECT_GT(one.twelve.y(), 0);
  EXPECT_GT(one.three.x(), 0);
}

TEST(ClockFace, RefusesPlanesWithoutTwelveOrThree) {
  for (const Vec3& normal : {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(NAN, 0, 1)})
    EXPECT_THROW(clock_face(normal), UsageError);
}

/// A bowl about the origin, open along `opening`, whose rim is cut away around `notch`.
TriMesh bowl(const Vec3& opening, const Vec3& notch, double notch_width_deg) {
  TriMesh shell = sphere({0, 0, 0}, 27, 5), bowl{shell.vertices, {}};
  for (const Triangle& t : shell.triangles) {
    const Vec3 middle = (shell.vertices[t[0]] + shell.vertices[t[1]] + shell.vertices[t[2]]) / 81;
    const Vec3 in_plane = (middle - middle.dot(opening) * opening).normalized();
    const bool in_notch = in_plane.dot(notch) > std::cos(notch_width_deg / 2 * deg);
    if (middle.dot(opening) < (in_notch ? -0.55 : 0.0)) bowl.triangles.push_back({t[0], t[2], t[1]});
  }
  return bowl;
}

TEST(RimClock, LiesInThePlaneOfTheRimWithSixAtTheNotch) {
  for (const double side : {1.0, -1.0}) {
    // Opening to the side, down and forwards, the notch down and a little forwards.
    const Vec3 opening = Vec3(0.3, -0.65, side * 0.7).normalized();
    const Vec3 notch = (Vec3(0.25, -1, 0) - Vec3(0.25, -1, 0).dot(opening) * opening).normalized();
    const auto clock = find_rim_clock(bowl(opening, notch, 50), {{0, 0, 0}, 24});
    ASSERT_TRUE(clock);
    // Sectors are 10 degrees wide and triangles of the bowl 3.
    EXPECT_GT(clock->twelve.dot(-notch), std::cos(7 * deg));
    EXPECT_LT(std::abs(clock->twelve.dot(opening)), std::sin(5 * deg));
    EXPECT_LT(std::abs(clock->three.dot(opening)), std::sin(5 * deg));
    EXPECT_GT(clock->three.x(), 0);
    EXPECT_NEAR(clock->hour_of(notch), 6, 0.25);
  }
}

TEST(RimClock, IsNotInventedWithoutANotchOrARim) {
  EXPECT_FALSE(find_rim_clock(bowl(Vec3::UnitZ(), Vec3::UnitX(), 0), {{0, 0, 0}, 24}));
  EXPECT_FALSE(find_rim_clock(box({100, 100, 100}, {110, 110, 110}), {{0, 0, 0}, 24}));
}

/// A head of radius 24 with a bar of half width 9 along the direction.
TriMesh head_and_neck(const Vec3& direction) {
  TriMesh bar = box({-9, -9, 10}, {9, 9, 80});
  // Split along its length, so that triangles fit into the shell.
  bar = TriMesh{};
  for (int k = 0; k < 35; ++k) bar = joined(bar, box({-9, -9, 10. + 2 * k}, {9, 9, 12. + 2 * k}));
  Pose X = Pose::Identity();
  const Vec3 about = Vec3::UnitZ().cross(direction).normalized();
  X.linear() = Eigen::AngleAxisd(std::acos(direction.z()), about).toRotationMatrix();
  return joined(sphere({0, 0, 0}, 24, 3), posed(X, bar));
}

TEST(NeckAxis, IsTheDirectionOfTheBarThatLeavesTheHead) {
  for (const Vec3& d : {Vec3(0.2, -0.6, 0.77), Vec3(0, -1, 0), Vec3(-0.5, -0.5, -0.7)}) {
    const auto neck = find_neck_axis(head_and_neck(d.normalized()), 24);
    ASSERT_TRUE(neck);
    // The bar's triangles are symmetric about its axis under a half turn in pairs of sides only: each square
    // end is cut along one diagonal, but ends of neighbouring pieces lie on each other and their areas cancel
    // across the axis to the corner triangles in the shell's border, below 2 mm of 34.
    EXPECT_GT(neck->direction.dot(d.normalized()), std::cos(2.0 / 34));
  }
}

TEST(NeckAxis, IsNotInventedForABall) {
  EXPECT_FALSE(find_neck_axis(sphere({0, 0, 0}, 24, 3), 24));
  EXPECT_FALSE(find_neck_axis(sphere({0, 0, 0}, 33, 3), 24)) << "a shell all around";
}

TEST(ImpingementZone, OfAnArmInAPostIsWhereTheyMeet) {
  const PostJoint scene = post_joint(JointAngle::flexion, Side::right);
  const MotionLimit limit = RangeOfMotion(scene.joint).limit(hip_motions().front());
  const auto zone = ZoneFinder(scene.joint, {.past = Angle::degrees(4)}).zone(limit);
  ASSERT_TRUE(zone);
  EXPECT_NEAR(*zone->contact_hour, std::atan2(post_x, post_y) / deg / 30, 1e-9);
  ASSERT_TRUE(zone->fixed.centroid_mm && zone->mobile.centroid_mm);
  // Areas and centroids once more, from the triangles named.
  const TriMesh& mesh = scene.joint.fixed.mesh;
  double area = 0;
  for (const Index t : zone->fixed.triangles)
    area += (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).norm() / 2;
  EXPECT_NEAR(zone->fixed.area_mm2, area, 1e-9);
  EXPECT_TRUE(std::is_sorted(zone->fixed.triangles.begin(), zone->fixed.triangles.end()));
  // The arm (2 mm thick) passes through the post's faces; no vertex of either is in the other.
  for (const double depth : zone->mobile.radial_depth_mm) EXPECT_EQ(depth, 0);
  EXPECT_EQ(zone->fixed.radial_depth_mm.size(), mesh.vertices.size());
  EXPECT_FALSE(zone->contact_neck_angle) << "an arm has no head and no neck";
}

TEST(ImpingementZone, ExistsOnlyWhereAMotionEndedByContact) {
  const PostJoint scene = post_joint(JointAngle::flexion, Side::right);
  const ZoneFinder finder(scene.joint);
  const RangeOfMotion range(scene.joint);
  Motion brief = hip_motions().front();
  brief.range = Angle::degrees(3);
  EXPECT_FALSE(finder.zone(range.limit(brief)));
}

TEST(SocketHour, EndsAtOneAndAHalfAndATenthHeadRadii) {
  BearingSurface surface;
  surface.head = {Vec3::Zero(), 25};
  const Vec3 towards = Vec3(1, 1, -1).normalized();
  const auto hour = [&](const std::optional<BearingSurface>& bearing, double distance) {
    return motion::socket_hour(sagittal_clock(), bearing, distance * towards);
  };
  EXPECT_DOUBLE_EQ(hour(surface, 39.999).value(), 1.5);
  EXPECT_FALSE(hour(surface, 40.001));
  EXPECT_DOUBLE_EQ(hour(std::nullopt, 40.001).value(), 1.5) << "no head, no rim to be far from";
}

/// A head of head_radius with an arm below it, and a post in front of the arm whose top is this far below the centre.
Joint arm_and_post_at(double below) {
  Joint joint = head_and_post_joint(Vec3::Zero());
  joint.fixed.mesh =
      joined(box({12, -below - 4, -5}, {16, -below, 5}), socket(Vec3::Zero(), socket_radius, 28, 4));
  joint.mobile.mesh = joined(box({-1, -60, -1}, {1, -19, 1}), sphere(Vec3::Zero(), head_radius, 4));
  return joint;
}

TEST(ImpingementZone, HasAnHourOnlyWhereARimMayBe) {
  std::size_t near = 0, far = 0;
  for (double below = 25; below < 32; below += 0.25) {
    const Joint joint = arm_and_post_at(below);
    MotionLimit limit = RangeOfMotion(joint).limit(hip_motions().front());
    const ZoneFinder finder(joint);
    const auto zone = finder.zone(limit);
    ASSERT_TRUE(zone && zone->fixed.centroid_mm) << below;
    const bool at_rim = zone->fixed.centroid_mm->norm() <= 1.6 * head_radius;
    EXPECT_EQ(zone->zone_hour.has_value(), at_rim) << below;
    ++(at_rim ? near : far);
  }
  EXPECT_GT(near, 4u);
  EXPECT_GT(far, 4u);
  const Joint joint = arm_and_post_at(25);
  MotionLimit limit = RangeOfMotion(joint).limit(hip_motions().front());
  const ZoneFinder finder(joint);
  Vec3& point = limit.end.contact->fixed_point;
  for (const double radii : {1.599, 1.601}) {
    point *= radii * head_radius / point.norm();
    EXPECT_EQ(finder.zone(limit)->contact_hour.has_value(), radii < 1.6) << radii;
  }
}

TEST(ImpingementZone, RefusesAnglesPastTheLimitThatMakeNoSense) {
  const Joint joint = post_joint(JointAngle::flexion, Side::right).joint;
  for (const double past : {-1.0, 181.0, static_cast<double>(NAN)})
    EXPECT_THROW(ZoneFinder(joint, {.past = Angle::degrees(past)}), UsageError);
}

}  // namespace
}  // namespace condyle::motion
