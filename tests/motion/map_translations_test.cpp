#include "condyle/contact.hpp"
#include "condyle/motion_map.hpp"
#include "motion/joint_scenes.hpp"
#include "support/test.hpp"

/// Maps that translate a joint: against closed forms of a ball, a hinge and a slot, and against exact predicates at random poses.

namespace condyle::motion {
namespace {

using namespace test;

constexpr MapCoordinate x = MapCoordinate::translation(0), y = MapCoordinate::translation(1),
                        z = MapCoordinate::translation(2);
constexpr double border = 1e-9;  // mm or degrees

Joint free_joint(TriMesh fixed, TriMesh mobile) {
  return {
      "",           JointKind::free, Side::right, {"fixed", std::move(fixed)}, {"mobile", std::move(mobile)},
      Anatomy::knee};
}

MotionMap map_of(const Joint& joint, const MapGrid& grid) {
  return motion_map(grid, RangeOfMotion(joint, {.overlap = {.reference_contact = ReferenceContact::accept}}));
}

/// A ball of many faces is free in the hollow of a socket while it is within every plane of it: n . t + max n . R v <= d.
TEST(MapOfTranslations, OfABallInASocketWithClearanceIsWhereItIsWithinEveryFace) {
  const TriMesh hollow = sphere({0, 0, 0}, 20, 2), ball = sphere({0, 0, 0}, 19, 3);
  const Joint joint = free_joint(joined(box({-80, -80, -80}, {80, 80, 80}), flipped(hollow)), ball);
  const MapGrid grids[] = {
      {.row = {y, -0.5, 0.5, 0.25}, .column = {x, -0.4, 0.6, 0.25}, .vary = z},
      {.row = {JointAngle::flexion, -40, 50, 30}, .column = {z, -0.6, 0.6, 0.3}, .vary = x}};
  for (const MapGrid& grid : grids) {
    const MotionMap map = map_of(joint, grid);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const Pose X_FM = pose_at(joint.coordinates(), grid.start_of(i), TranslationFrame::fixed);
      double low = -50, high = 50;
      for (const Triangle& t : hollow.triangles) {
        const Vec3 &a = hollow.vertices[t[0]], &b = hollow.vertices[t[1]], &c = hollow.vertices[t[2]];
        const Vec3 n = (b - a).cross(c - a).normalized();
        double reach = -std::numeric_limits<double>::infinity();
        for (std::size_t v = 0; v < ball.vertices.size(); ++v)
          reach = std::max(reach, n.dot(posed(X_FM, ball.vertices[v])));
        const double end = (n.dot(a) - reach) / n[grid.vary.axis()];
        (n[grid.vary.axis()] > 0 ? high : low) =
            n[grid.vary.axis()] > 0 ? std::min(high, end) : std::max(low, end);
      }
      const MapPoint point = map.point(i);
      EXPECT_EQ(point.free_at_start(), low < 0 && high > 0) << i;
      ASSERT_EQ(point.intervals.size(), low < high ? 1u : 0u) << i;
      if (!(low < high)) continue;
      EXPECT_NEAR(point.intervals[0].low.value, low, border) << i;
      EXPECT_NEAR(point.intervals[0].high.value, high, border) << i;
      EXPECT_LT(point.intervals[0].high.error_bound, border) << i;
    }
  }
}

/// A rod of half length 10 and half width 1 between plates 5 from the axis, and a wall at x = 25: turned by a it reaches
/// 10 sin a + cos a up and down and 10 cos a + sin a to either side.
TEST(MapOfTranslations, OfAHingeAndASlotAreTheirClosedForms) {
  const TriMesh plates = joined(box({-20, 5, -2}, {20, 6, 2}), box({-20, -6, -2}, {20, -5, 2}));
  const Joint joint =
      free_joint(joined(plates, box({25, -9, -3}, {26, 9, 3})), box({-10, -1, -1}, {10, 1, 1}));
  const MapGrid turning{.row = {y, -2, 2, 1}, .column = {x, -3, 3, 3}, .vary = JointAngle::flexion};
  const MapGrid across{.row = {JointAngle::flexion, 0, 16, 8}, .column = {x, -2, 4, 3}, .vary = y};
  const MapGrid along{.row = across.row, .column = {y, -1, 1, 1}, .vary = x, .slide_range = {-40, 60}};
  const MotionMap turns = map_of(joint, turning), up = map_of(joint, across), on = map_of(joint, along);
  for (std::size_t i = 0; i < turning.size(); ++i) {
    const double gap = 5 - std::abs(turning.start_of(i).translation_mm.y());
    const double limit = (std::asin(gap / std::sqrt(101)) - std::atan2(1, 10)) * 180 / std::numbers::pi;
    const MapPoint point = turns.point(i);
    EXPECT_NEAR(point.negative.value, -limit, border) << i;
    EXPECT_NEAR(point.positive.value, limit, border) << i;
    ASSERT_TRUE(point.positive.contact);
    EXPECT_NEAR(std::abs(point.positive.contact->fixed_point.y()), 5, border) << "in the frame of the joint";
    EXPECT_NEAR(std::abs(point.positive.contact->mobile_point.x()), 10, border) << i;
  }
  for (std::size_t i = 0; i < across.size(); ++i) {
    const double a = across.start_of(i).angles.flexion.radians();
    const double tall = 10 * std::sin(a) + std::cos(a), wide = 10 * std::cos(a) + std::sin(a);
    const MapPoint y_free = up.point(i), x_free = on.point(i);
    EXPECT_NEAR(y_free.positive.value, 5 - tall, border) << i;
    EXPECT_NEAR(y_free.negative.value, tall - 5, border) << i;
    EXPECT_EQ(y_free.intervals.size(), 3u) << "between the plates, above and below them";
    EXPECT_EQ(y_free.intervals[0].low.value, -50);
    EXPECT_EQ(y_free.intervals[0].low.reason, LimitReason::end_of_range);
    EXPECT_NEAR(x_free.positive.value, 25 - wide, border) << i;
    EXPECT_EQ(x_free.negative.value, -40) << i;
    ASSERT_EQ(x_free.intervals.size(), 2u) << "before the wall, and behind it";
    EXPECT_NEAR(x_free.intervals[1].low.value, 26 + wide, border) << i;
  }
}

/// Translations along either frame; CONDYLE_LONG_TESTS=1 asks 5,000 poses of each map.
TEST(MapOfTranslations, ContradictsNoExactPredicateAtRandomPoses) {
  const int poses = std::getenv("CONDYLE_LONG_TESTS") != nullptr ? 5000 : 200;
  std::mt19937 random(41);
  for (const TranslationFrame frame : {TranslationFrame::fixed, TranslationFrame::joint_axes}) {
    Joint joint = bumpy_joint(Side::left);
    joint.kind = JointKind::free, joint.anatomy = Anatomy::knee, joint.translation_frame = frame;
    const contact::JointContact exact(joint);
    JointCoordinates held;
    held.angles.internal_rotation = Angle::degrees(12);
    for (const MapCoordinate vary : {MapCoordinate(JointAngle::flexion), MapCoordinate(JointAngle::adduction),
                                     MapCoordinate(JointAngle::internal_rotation), y}) {
      MapGrid grid{.row = {z, -2, 3, 2.5}, .column = {x, -3, 3, 2}, .vary = vary, .slide_range = {-20, 20}};
      if (vary != JointAngle::internal_rotation) grid.held = held;
      if (vary == JointAngle::adduction) grid.column.coordinate = JointAngle::flexion;
      const MotionMap map = map_of(joint, grid);
      int contradicted = 0, free_poses = 0;
      for (int k = 0; k < poses; ++k) {
        const std::size_t i = random() % grid.size();
        const double half = vary.is_angle() ? 180 : 20;
        const double value = std::uniform_real_distribution<double>(-half, half)(random);
        JointCoordinates at = grid.start_of(i);
        if (vary.is_angle())
          at.angles = turned_by(at.angles, vary.angle(), Angle::degrees(value));
        else
          at.translation_mm[vary.axis()] = value;
        bool free = false, near_an_end = false;
        for (const MapInterval& each : map.point(i).intervals) {
          free |= each.low.value <= value && value <= each.high.value;
          near_an_end |=
              std::min(std::abs(each.low.value - value), std::abs(each.high.value - value)) < border;
        }
        free_poses += free ? 1 : 0;
        const bool is_free = !exact.in_contact(pose_at(joint.coordinates(), at, frame));
        contradicted += !near_an_end && free != is_free ? 1 : 0;
      }
      EXPECT_EQ(contradicted, 0) << name_of(vary, joint.anatomy) << " " << name_of(frame);
      EXPECT_GT(free_poses, poses / 20);
      EXPECT_LT(free_poses, poses);
    }
  }
}

TEST(MapOfTranslations, CountsBearingContactForSlidesAndNotForRotations) {
  Joint joint = head_and_post_joint({0, 0, 0});
  joint.kind = JointKind::free;
  const RangeOfMotion range(joint);
  ASSERT_EQ(range.bearing_rule(), BearingRule::leave_out);
  const MotionMap map = motion_map(
      {.row = {JointAngle::flexion, 0, 0, 1}, .column = {JointAngle::adduction, 0, 0, 1}, .vary = y}, range);
  const MapEnd& up = map.point(0).positive;
  EXPECT_EQ(up.kind(), ContactKind::bearing);
  EXPECT_NEAR(up.value, socket_radius - head_radius, 0.5) << "to the facets of both";
}

}  // namespace
}  // namespace condyle::motion
