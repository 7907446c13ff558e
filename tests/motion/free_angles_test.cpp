#include "condyle/contact.hpp"
#include "condyle/range_of_motion.hpp"
#include "core/parallel.hpp"
#include "motion/joint_scenes.hpp"
#include "support/real_hip.hpp"
#include "support/test.hpp"

/// All free intervals of a joint angle: in closed form, and against exact tests at every step.

namespace condyle::motion {
namespace {

using namespace test;

const RotationRange half_turns{Angle::degrees(-180), Angle::degrees(180)};

TEST(FreeAngles, OfAnArmBesideAPostAreTheTwoSidesOfThePost) {
  for (const JointAngle vary : {JointAngle::flexion, JointAngle::adduction, JointAngle::internal_rotation}) {
    for (const Side side : {Side::right, Side::left}) {
      const PostJoint scene = post_joint(vary, side);
      const double far_side = two_pi - scene.limit_other_way;
      for (const double start_deg : {0., 5., -170., 130.}) {
        SCOPED_TRACE(testing::Message() << "angle " << static_cast<int>(vary) << " from " << start_deg);
        const double start = start_deg * std::numbers::pi / 180;
        const FreeAngles free =
            RangeOfMotion(scene.joint)
                .free_angles(vary, turned_by({}, vary, Angle::radians(start)), half_turns);
        ASSERT_TRUE(free.from_start.free_at_start());
        // The post takes [limit, far_side] of the full turn; the range begins and ends opposite to the start.
        double total = 0;
        for (const FreeInterval& interval : free.intervals) {
          total += (interval.high - interval.low).radians();
          for (const auto& [end, at] :
               {std::pair{interval.low, &interval.at_low}, {interval.high, &interval.at_high}}) {
            if (at->reason == LimitReason::end_of_range) {
              EXPECT_NEAR(std::abs(end.degrees()), 180, 1e-12);
              continue;
            }
            const double angle = std::remainder(end.radians() + start - (scene.limit + far_side) / 2, two_pi);
            EXPECT_NEAR(std::abs(angle), (far_side - scene.limit) / 2, 1e-11);
            EXPECT_TRUE(at->contact);
          }
        }
        EXPECT_NEAR(total, two_pi - (far_side - scene.limit), 1e-10);
        EXPECT_EQ(free.intervals.size(), 2u);
        EXPECT_TRUE(free.nearest_to_start()->holds_start());
      }
    }
  }
}

TEST(FreeAngles, OfAStartInContactAreThoseBesideIt) {
  const PostJoint scene = post_joint(JointAngle::flexion, Side::right);
  const double inside = scene.limit + 0.05, far_side = two_pi - scene.limit_other_way;
  const RangeOfMotion range(scene.joint);
  const FreeAngles free =
      range.free_angles(JointAngle::flexion, {Angle::radians(inside), {}, {}}, half_turns);
  EXPECT_FALSE(free.from_start.free_at_start());
  ASSERT_EQ(free.intervals.size(), 2u);
  EXPECT_NEAR(free.intervals[0].high.radians(), scene.limit - inside, 1e-11);
  EXPECT_NEAR(free.intervals[1].low.radians(), far_side - inside, 1e-11);
  EXPECT_EQ(free.nearest_to_start(), &free.intervals[0]);
  // A range that ends before the far side leaves one.
  const FreeAngles brief = range.free_angles(JointAngle::flexion, {Angle::radians(inside), {}, {}},
                                             {Angle::degrees(-30), Angle::degrees(1)});
  ASSERT_EQ(brief.intervals.size(), 1u);
  EXPECT_EQ(brief.intervals[0].low, Angle::degrees(-30));
  EXPECT_EQ(brief.intervals[0].at_low.reason, LimitReason::end_of_range);
}

TEST(FreeAngles, AreNoneInsideTheOtherBody) {
  const Joint joint{"swallowed",
                    JointKind::ball,
                    Side::right,
                    {"block", box({-90, -90, -90}, {90, 90, 90})},
                    {"pea", box({20, 20, 20}, {25, 25, 25})}};
  const FreeAngles free = RangeOfMotion(joint, {.overlap = {.reference_contact = ReferenceContact::accept}})
                              .free_angles(JointAngle::flexion, {}, half_turns);
  EXPECT_TRUE(free.intervals.empty());
  EXPECT_EQ(free.nearest_to_start(), nullptr);
}

TEST(FreeAngles, RefuseRangesOfMoreThanHalfATurn) {
  const RangeOfMotion range(post_joint(JointAngle::flexion, Side::right).joint);
  EXPECT_THROW(range.free_angles(JointAngle::flexion, {}, {Angle(), Angle::degrees(181)}), UsageError);
  EXPECT_THROW(range.free_angles(JointAngle::flexion, {}, {Angle::degrees(1), Angle::degrees(2)}),
               UsageError);
  EXPECT_THROW(range.free_angles(JointAngle::flexion, {}, {Angle::radians(std::nan("")), Angle()}),
               UsageError);
}

/// The joint without its bearing surface, and whether it is free at a pose: exact, surfaces alone.
struct Impinging {
  Joint joint;
  contact::JointContact contact;
};

Impinging impinging(const Joint& joint, BearingRule rule) {
  Joint part = joint;
  const auto surface = find_bearing_surface(joint).surface;
  if (surface && rule == BearingRule::leave_out) {
    TriMesh rest{joint.mobile.mesh.vertices(), {}};
    for (std::size_t t = 0; t < surface->triangles.size(); ++t)
      if (!surface->triangles[t]) rest.triangles.push_back(joint.mobile.mesh.triangles()[t]);
    part.mobile.mesh = rest;
  }
  contact::JointContact contact(part);
  return {std::move(part), std::move(contact)};
}

bool holds(const FreeAngles& free, double angle) {
  for (const FreeInterval& interval : free.intervals)
    if (interval.low.radians() <= angle && angle <= interval.high.radians()) return true;
  return false;
}

bool near_an_end(const FreeAngles& free, double angle) {
  constexpr double too_near = 1e-9;  // rad: more than a pose rounds
  for (const FreeInterval& interval : free.intervals)
    if (std::abs(interval.low.radians() - angle) < too_near ||
        std::abs(interval.high.radians() - angle) < too_near)
      return true;
  return false;
}

/// Angles at which the free intervals and an exact test at that pose say different things.
std::size_t disagreements(const Impinging& exact, const FreeAngles& free, JointAngle vary,
                          const JointAngles& start, double step_deg) {
  const auto steps = static_cast<std::size_t>(std::lround(360 / step_deg));
  std::vector<std::size_t> wrong(steps);
  core::parallel_chunks(steps, 64, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Angle by = Angle::degrees(-180 + step_deg * (static_cast<double>(i) + 0.5));
      if (near_an_end(free, by.radians())) continue;
      const bool meets =
          exact.contact.in_contact(pose_at(exact.joint.coordinates(), turned_by(start, vary, by)));
      wrong[i] = meets == holds(free, by.radians());
    }
  });
  return static_cast<std::size_t>(std::count(wrong.begin(), wrong.end(), 1u));
}

/// Random points of a map and the angles looked at: of the first ones in finer steps than of the others.
struct Thoroughness {
  int points;
  double step_deg;
  int fine_points = 0;
  double fine_step_deg = 0.01;
};

/// Results found during the search.
struct Seen {
  std::size_t islands = 0, in_contact = 0, free_elsewhere = 0;
};

Seen expect_same_as_steps(const Joint& joint, BearingRule rule, JointAngle vary, const Thoroughness& how,
                          unsigned seed) {
  const RangeOfMotion range(
      joint, {.bearing = {.rule = rule}, .overlap = {.reference_contact = ReferenceContact::accept}});
  const Impinging exact = impinging(joint, rule);
  std::mt19937 random(seed);
  const auto anywhere = [&](double low, double high) {
    return Angle::degrees(low + (high - low) * static_cast<double>(random()) / 4294967296.0);
  };
  Seen seen;
  for (int i = 0; i < how.points; ++i) {
    JointAngles start{anywhere(-20, 120), anywhere(-40, 30), anywhere(-40, 40)};
    start = turned_by(start, vary, -angle_of(start, vary));
    const FreeAngles free = range.free_angles(vary, start, half_turns);
    EXPECT_EQ(disagreements(exact, free, vary, start, i < how.fine_points ? how.fine_step_deg : how.step_deg),
              0u)
        << start.flexion.degrees() << " " << start.adduction.degrees() << " "
        << start.internal_rotation.degrees();
    seen.islands += free.intervals.size() > 1;
    seen.in_contact += !free.from_start.free_at_start();
    seen.free_elsewhere += !free.from_start.free_at_start() && !free.intervals.empty();
  }
  return seen;
}

TEST(FreeAngles, OfABumpyJointAreThoseOfExactTestsAtEveryStep) {
  for (const JointAngle vary : {JointAngle::flexion, JointAngle::adduction, JointAngle::internal_rotation})
    for (const BearingRule rule : {BearingRule::leave_out, BearingRule::count})
      expect_same_as_steps(bumpy_joint(Side::left), rule, vary, {10, 0.25}, 5);
}

/// CONDYLE_LONG_TESTS=1 takes every hundredth of a degree at all points.
Thoroughness thoroughness() {
  const char* more = std::getenv("CONDYLE_LONG_TESTS");
  return {200, 0.1, more && std::string(more) == "1" ? 200 : 20};
}

TEST(FreeAngles, OfARealHipAreThoseOfExactTestsAtEveryStep) {
  FOUND_OR_SKIP(hip, hip_vhf_right());
  const Seen seen =
      expect_same_as_steps(*hip, BearingRule::leave_out, JointAngle::internal_rotation, thoroughness(), 7);
  EXPECT_GT(seen.islands, 0u);
  EXPECT_GT(seen.in_contact, 0u);
  EXPECT_GT(seen.free_elsewhere, 0u);
}

}  // namespace
}  // namespace condyle::motion
