#include "condyle/answer.hpp"
#include "support/real_hip.hpp"
#include "support/test.hpp"

/// One rule for what a pose is to the limits of its joint: against the limits of motions that start there, one by one.

namespace condyle::test {
namespace {

using enum JointAngle;
using motion::LimitReason;

JointAngles degrees(double f, double a, double r) {
  return {Angle::degrees(f), Angle::degrees(a), Angle::degrees(r)};
}

PoseStanding standing_at(const Joint& joint, const motion::RangeOfMotion& limits, const JointAngles& at,
                         const Vec3& translation = Vec3::Zero()) {
  Pose X_FM = pose_at(joint.coordinates(), at);
  X_FM.translation() = translation;
  return pose_standing(limits, at, translation, contact::JointContact(joint).in_contact(X_FM));
}

/// An arm that hangs from the centre beside a wall, x = 40: neither has a head.
const Joint arm{.name = "arm",
                .kind = JointKind::ball,
                .side = Side::right,
                .fixed = {"wall", box({40, -120, -50}, {60, -20, 50})},
                .mobile = {"arm", box({-1, -100, -2}, {1, -10, 2})}};

TEST(PoseState, OfAHipIsWhatItsLimitsSay) {
  FOUND_OR_SKIP(hip, hip_vhf_right());
  const auto limits = limits_of_poses(*hip);
  ASSERT_TRUE(limits);
  // The bearing surfaces meet from some 91 degrees of internal rotation on, and motions end at 102.6.
  const PoseStanding bearing = standing_at(*hip, *limits, degrees(0, 0, 95));
  EXPECT_EQ(bearing.state, PoseState::bearing);
  EXPECT_GT(bearing.clearance_mm, 0);
  EXPECT_EQ(standing_at(*hip, *limits, degrees(0, 0, 0)).state, PoseState::free);
  for (const JointAngles& at :
       {degrees(0, 0, 95), degrees(0, 0, 0), degrees(80, 10, 20), degrees(-10, -5, 8)}) {
    const PoseStanding standing = standing_at(*hip, *limits, at);
    ASSERT_TRUE(standing.nearest);
    Angle least = Angle::degrees(181);
    for (const JointAngle vary : all_joint_angles)
      for (const RotationSense sense : {RotationSense::negative, RotationSense::positive})
        if (const auto end = limits->limit({"any", vary, sense, at, Angle::degrees(180)}).end;
            end.reason == LimitReason::contact)
          least = std::min(least, end.turned);
    EXPECT_EQ(standing.nearest->end.turned, least);
    // Just before the end, at it, and past it.
    const auto& [end, vary, sense] = *standing.nearest;
    for (const auto& [past_deg, state] : {std::pair(-0.06, standing.state),
                                          {-0.04, PoseState::at_limit},
                                          {0.04, PoseState::at_limit},
                                          {0.5, PoseState::impinging}}) {
      const PoseStanding there =
          standing_at(*hip, *limits,
                      motion::turned_by(at, vary, (end.turned + Angle::degrees(past_deg)) * sign_of(sense)));
      if (past_deg > -0.05) {
        EXPECT_EQ(there.state, state) << past_deg;
      }
      EXPECT_EQ(there.clearance_mm == 0, past_deg > 0) << past_deg;
      EXPECT_EQ(there.to_limit_deg() == 0, past_deg > 0) << past_deg;
    }
  }
}

TEST(PoseState, WithoutABearingSurfaceIsContactAndSaysWhy) {
  const auto limits = limits_of_poses(arm);
  // The arm's front x = 1 meets the wall's lower... edge at y = -20 last; the corner (1, -100) first: 100.005 sin(t + 0.573 deg) = 40.
  const double meets_deg = std::asin(40 / std::hypot(1, 100)) * 180 / M_PI - std::atan2(1, 100) * 180 / M_PI;
  const PoseStanding free = standing_at(arm, *limits, degrees(0, 0, 0));
  EXPECT_EQ(free.state, PoseState::free);
  EXPECT_NEAR(free.to_limit_deg(), meets_deg, 1e-9);
  EXPECT_NEAR(free.clearance_mm, 39, 1e-12);
  EXPECT_EQ(free.nearest->vary, flexion);
  EXPECT_EQ(standing_at(arm, *limits, degrees(meets_deg - 0.02, 0, 0)).state, PoseState::at_limit);
  const PoseStanding contact = standing_at(arm, *limits, degrees(meets_deg + 5, 0, 0));
  EXPECT_EQ(contact.state, PoseState::contact);
  EXPECT_FALSE(contact.why_unknown.empty());
  EXPECT_FALSE(contact.nearest);
  EXPECT_EQ(contact.to_limit_deg(), 0);
  // Translated by 9 mm towards the wall, angles turn about the arm's origin there.
  const double nearer_deg = std::asin(31 / std::hypot(1, 100)) * 180 / M_PI - std::atan2(1, 100) * 180 / M_PI;
  EXPECT_NEAR(standing_at(arm, *limits, degrees(0, 0, 0), {9, 0, 0}).to_limit_deg(), nearer_deg, 1e-9);
  EXPECT_EQ(standing_at(arm, *limits, degrees(0, 0, 0), {41, 0, 0}).state, PoseState::contact);
}

TEST(PoseState, AtTheVeryEndOfALigamentItIsThisEnd) {
  Joint tied = arm;
  tied.ligaments.push_back({.name = "string",
                            .fixed = {{-30, -20, 10}},
                            .mobile = {{0, -90, 0}},
                            .slack_length_mm = 80,
                            .ends_at_strain = 0.1});
  const auto limits = limits_of_poses(tied);
  int ends = 0;
  for (int f = -20; f <= 10; ++f)
    for (const RotationSense sense : {RotationSense::negative, RotationSense::positive}) {
      const JointAngles start = degrees(f, 0, 0);
      const auto end = limits->limit({"any", adduction, sense, start, Angle::degrees(90)}).end;
      if (end.reason != LimitReason::ligament) continue;
      ++ends;
      // Rounding puts some of these poses just before the end, and some just past it.
      const PoseStanding there =
          standing_at(tied, *limits, motion::turned_by(start, adduction, end.turned * sign_of(sense)));
      EXPECT_EQ(there.state, PoseState::at_limit) << f;
      ASSERT_TRUE(there.nearest) << f;
      EXPECT_EQ(there.nearest->end.reason, LimitReason::ligament) << f;
    }
  EXPECT_GT(ends, 20);
}

TEST(PoseState, ComesWithDepthAndMotion) {
  const auto limits = limits_of_poses(arm);
  const contact::JointContact bodies(arm);
  MotionRequest request{.limits = limits.get(), .nearest_limits = PoseStanding::FindNearest::always};
  for (const double f : {0.0, 10.0, 25.0}) {
    const JointAngles at = degrees(f, 0, 0);
    const Pose X_FM = pose_at(arm.coordinates(), at);
    request.X_FM.push_back(X_FM);
    const DepthAnswer depth =
        answer_depth(bodies, arm, {.X_FM = X_FM, .pose = at, .deepest_place = true, .limits = limits.get()});
    ASSERT_TRUE(depth.standing);
    EXPECT_EQ(depth.standing->state, f == 25 ? PoseState::contact : PoseState::free);
    EXPECT_EQ(depth.deepest_place.has_value(), f == 25);
    if (f == 25) {
      EXPECT_EQ(depth.deepest_place->depth_mm, answer_touch(bodies, {.X_FM = X_FM}).deepest->depth_mm);
    }
  }
  request.X_FM.push_back(std::nullopt);
  const MotionAnswer motion = answer_motion(bodies, nullptr, request);
  ASSERT_EQ(motion.standings.size(), 4u);
  EXPECT_FALSE(motion.standings[3]);
  EXPECT_EQ(motion.standings[2]->state, PoseState::contact);
  EXPECT_NEAR(motion.standings[0]->to_limit_deg() - motion.standings[1]->to_limit_deg(), 10, 1e-9);
}

}  // namespace
}  // namespace condyle::test
