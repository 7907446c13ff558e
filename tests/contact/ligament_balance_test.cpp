#include "condyle/pressure.hpp"
#include "support/cup.hpp"
#include "support/test.hpp"

/// Ligaments that pull beside an elastic contact.

namespace condyle::contact {
namespace {

using test::layer_of_stiffness;
using test::translated;

const test::BallInCup ball{25, 24.8, 0, 6.321839};

ElasticContact ball_in_cup() {
  return {test::cup(ball.R, 5),
          test::sphere(Vec3::Zero(), ball.r, 5),
          {.casting = Casting::fixed, .fixed = layer_of_stiffness(ball.K)}};
}

/// Pulls the ball down into the cup.
Ligament string_below(double slack_mm, double stiffness_n) {
  return {.name = "string",
          .fixed = {Vec3(0, -60, 0)},
          .mobile = {Vec3(0, -24, 0)},
          .slack_length_mm = slack_mm,
          .stiffness_n = stiffness_n,
          .transition_strain = 0.02};
}

TEST(LigamentBalance, OfAStringAndNothingElseHasTheContactCarryItsTension) {
  const ElasticContact contact = ball_in_cup();
  const Ligament string = string_below(30, 20000);
  const BalancedPose pose = balance(contact, translated({0, -0.3, 0}), {}, {.ligaments = {string}});
  ASSERT_EQ(pose.outcome, BalanceOutcome::balanced) << reason_of(pose);
  const LigamentState state = ligament_state(string, pose.X_FM).value();
  EXPECT_GT(state.tension_n, 1000);
  EXPECT_LT((pose.contact.on_mobile.force_n + state.force_n).norm(), 1e-6 * state.tension_n);
  EXPECT_LT(pose.residual.force_n.norm(), 1e-6);
  // The same pose as under a force of that size, without the string.
  const BalancedPose by_force =
      balance(contact, translated({0, -0.3, 0}), {.on_mobile = {.force_n = state.force_n}});
  EXPECT_LT((by_force.X_FM.translation() - pose.X_FM.translation()).norm(), 1e-6);
}

TEST(LigamentBalance, MovesOnAsTheLoadGrows) {
  const ElasticContact contact = ball_in_cup();
  const BalanceOptions options{.ligaments = {string_below(30, 20000)}};
  double before = 0;
  for (const double newton : {0.0, 100.0, 200.0, 300.0, 400.0}) {
    const BalancedPose pose =
        balance(contact, translated({0, -0.3, 0}), {.on_mobile = {.force_n = {0, newton, 0}}}, options);
    ASSERT_EQ(pose.outcome, BalanceOutcome::balanced) << reason_of(pose);
    const double y = pose.X_FM.translation().y();
    if (newton > 0) {
      EXPECT_GT(y, before);
      EXPECT_LT(y - before, 0.05);
    }
    before = y;
  }
}

TEST(LigamentBalance, HoldsABodyThatNoContactHolds) {
  // Pulled up out of the cup, against the string, until that carries the force by itself.
  const ElasticContact contact = ball_in_cup();
  const Ligament string = string_below(33, 20000);
  const BalancedPose pose = balance(contact, Pose::Identity(), {.on_mobile = {.force_n = {0, 3000, 0}}},
                                    {.free_directions = {Vec3::UnitY()}, .ligaments = {string}});
  ASSERT_EQ(pose.outcome, BalanceOutcome::balanced) << reason_of(pose);
  // T = k (e - c / 2) beyond c.
  const double strain = 3000.0 / 20000 + 0.01;
  EXPECT_NEAR(pose.X_FM.translation().y(), 33 * (1 + strain) - 36, 1e-6);
  EXPECT_LT(pose.contact.on_mobile.force_n.norm(), 1e-9);
}

TEST(LigamentBalance, OfNothingThatTouchesOrPullsIsHeldByNothing) {
  const BalancedPose pose =
      balance(ball_in_cup(), translated({0, 1, 0}), {}, {.ligaments = {string_below(60, 20000)}});
  EXPECT_EQ(pose.outcome, BalanceOutcome::free_direction);
  EXPECT_EQ(reason_of(pose).find("nothing holds the mobile body"), 0u) << reason_of(pose);
}

TEST(LigamentBalance, RefusesALigamentWithoutALength) {
  Ligament string = string_below(30, 20000);
  string.wrap = LigamentWrap{.shape = WrapShape::ellipsoid, .body = BodyRole::fixed};
  string.wrap->centre = Vec3(0, -40, 0);
  string.wrap->radii_mm = Vec3(3, 3, 3);
  try {
    balance(ball_in_cup(), Pose::Identity(), {}, {.ligaments = {string}});
    ADD_FAILURE() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "ligament string: its length is not known near the balance");
  }
}

}  // namespace
}  // namespace condyle::contact
