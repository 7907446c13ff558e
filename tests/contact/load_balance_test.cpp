#include "condyle/pressure.hpp"

#include "support/cup.hpp"
#include "support/test.hpp"

namespace condyle::contact {
namespace {

using test::generic_turn;
using test::layer_of_stiffness;
using test::translated;

ElasticContact cup_and_ball(const test::BallInCup& known, int levels) {
  return {test::cup(known.R, levels),
          posed(generic_turn(), test::sphere(Vec3::Zero(), known.r, levels)),
          {.casting = Casting::fixed, .fixed = layer_of_stiffness(known.K)}};
}
Load down(double newton) {
  return {.on_mobile = {.force_n = {0, -newton, 0}}};
}

/// The displacement at which the closed form carries a load.
double displacement(test::BallInCup known, double load) {
  double low = known.R - known.r, high = low + 2;
  for (int i = 0; i < 100; ++i) {
    known.d = (low + high) / 2;
    (known.force() < load ? low : high) = known.d;
  }
  return known.d;
}

class BalancedCup : public testing::TestWithParam<std::pair<test::BallInCup, double>> {};

TEST_P(BalancedCup, CarriesTwoThousandNewtonsWhereTheClosedFormDoes) {
  auto [known, printed] = GetParam();
  known.d = displacement(known, 2000);
  EXPECT_NEAR(known.d, printed, 1e-6);
  std::array<double, 2> found;
  for (const int i : {0, 1}) {
    const ElasticContact contact = cup_and_ball(known, 6 + i);
    const auto from = [&](const Vec3& start) { return balance(contact, translated(start), down(2000)); };
    const BalancedPose one = from({0, 0, 0}), other = from({0.1, -known.d - 0.1, -0.15});
    for (const BalancedPose& pose : {one, other}) {
      ASSERT_EQ(pose.outcome, BalanceOutcome::balanced) << reason_of(pose);
      EXPECT_LE(pose.steps, 12);
      EXPECT_LE(pose.residual.force_n.norm(), 1e-6);
    }
    EXPECT_LT((one.X_FM.translation() - other.X_FM.translation()).norm(), 1e-7) << "two starts agree";
    found[i] = -one.X_FM.translation().y();
    if (i == 1) {
      const ContactTotals& totals = one.contact.fixed->totals;
      EXPECT_NEAR(totals.max_pressure_mpa, known.peak(), 0.01 * known.peak());
      EXPECT_NEAR(totals.area_mm2, known.area(), 0.01 * known.area());
    }
  }
  // Edges of 0.77 and 0.39 mm in the mean: errors fall with their square, and so 1e-3 is met at 0.25 mm.
  EXPECT_NEAR(found[1], known.d, 1e-3 * std::pow(0.39 / 0.25, 2));
  EXPECT_NEAR(found[1] + (found[1] - found[0]) / 3, known.d, 1e-4);
}

// d as printed in docs/mathematics/08-known-answers.md.
INSTANTIATE_TEST_SUITE_P(Cases, BalancedCup,
                         testing::Values(std::pair{test::BallInCup{25.85, 25.65, 0, 9.282971}, 0.434453},
                                         std::pair{test::BallInCup{25.85, 25.75, 0, 9.282971}, 0.299392},
                                         std::pair{test::BallInCup{25, 24.8, 0, 6.321839}, 0.530583}),
                         [](const auto& param) {
                           return "R" + std::to_string(static_cast<int>(100 * param.param.first.r));
                         });

const test::BallInCup small{25, 24.8, 0, 6.321839};

TEST(LoadBalance, OfAnObliqueLoadLiesAlongIt) {
  // A whole ball in a whole hollow ball answers alike in every direction.
  const ElasticContact contact(test::flipped(test::sphere(Vec3::Zero(), 25, 6)),
                               posed(generic_turn(), test::sphere(Vec3::Zero(), 24.8, 6)),
                               {.casting = Casting::fixed, .fixed = layer_of_stiffness(6)});
  const Vec3 force = 1500 * Vec3(1, -2, 0.5).normalized();
  const auto pose = balance(contact, Pose::Identity(), {.on_mobile = {.force_n = force}});
  ASSERT_EQ(pose.outcome, BalanceOutcome::balanced) << reason_of(pose);
  EXPECT_LT((pose.X_FM.translation().normalized() - force.normalized()).norm(), 1e-2);
  EXPECT_LT((pose.contact.on_mobile.force_n + force).norm(), 1e-6);
}

TEST(LoadBalance, OfALoadInTheFrameOfMGoesAlong) {
  const ElasticContact contact = cup_and_ball(small, 5);
  Pose start = generic_turn();
  const Vec3 down_in_F(100, -1500, 50);
  const auto in_F = balance(contact, start, {.on_mobile = {.force_n = down_in_F}});
  const auto in_M =
      balance(contact, start,
              {.on_mobile = {.force_n = start.linear().transpose() * down_in_F}, .frame = BodyRole::mobile});
  ASSERT_EQ(in_F.outcome, BalanceOutcome::balanced);
  ASSERT_EQ(in_M.outcome, BalanceOutcome::balanced);
  EXPECT_LT((in_F.X_FM.translation() - in_M.X_FM.translation()).norm(), 1e-8);
}

TEST(LoadBalance, AlongOneDirectionOnlyThatPartOfTheLoadCounts) {
  const ElasticContact contact = cup_and_ball(small, 5);
  const auto pose = balance(contact, translated({0.05, 0, 0}), {.on_mobile = {.force_n = {300, -1500, 0}}},
                            {.free_directions = {Vec3(0, 2, 0)}});
  ASSERT_EQ(pose.outcome, BalanceOutcome::balanced) << reason_of(pose);
  EXPECT_EQ(pose.X_FM.translation().x(), 0.05);
  EXPECT_EQ(pose.X_FM.translation().z(), 0);
  EXPECT_NEAR(pose.contact.on_mobile.force_n.y(), 1500, 1e-6);
}

TEST(LoadBalance, MomentsAreBalancedWhereRotationsAreFree) {
  // A block held by a hollow block half a millimetre wider in every way than its layers: pressed down and twisted, it
  // leans until both force and moment are carried.
  const auto hollow = test::flipped(test::sphere(Vec3::Zero(), 20, 5));
  TriMesh egg = test::sphere(Vec3::Zero(), 19.8, 5), shell = hollow;
  const auto stretch = [](TriMesh& mesh) {
    for (double& x : mesh.vertices.x) x *= 1.5;
    for (double& z : mesh.vertices.z) z *= 1.25;
  };
  stretch(egg), stretch(shell);
  const ElasticContact contact(shell, egg, {.casting = Casting::fixed, .fixed = layer_of_stiffness(6)});
  const Load load{.on_mobile = {.force_n = {20, -1500, 30}, .moment_nmm = {300, -500, 700}}};
  const auto pose = balance(contact, translated({0, -0.3, 0}), load, {.free_rotations = true});
  ASSERT_EQ(pose.outcome, BalanceOutcome::balanced) << reason_of(pose);
  EXPECT_LT((pose.contact.on_mobile.force_n + load.on_mobile.force_n).norm(), 1e-6);
  EXPECT_LT((pose.contact.on_mobile.moment_nmm + load.on_mobile.moment_nmm).norm(), 1e-4);
  EXPECT_GT(Eigen::AngleAxisd(pose.X_FM.linear()).angle(), 1e-4);
}

TEST(LoadBalance, RefusesALoadThatPullsApart) {
  const ElasticContact contact = cup_and_ball(small, 5);
  for (const Vec3& start : {Vec3(0, 0, 0), Vec3(0, -0.5, 0)}) {
    const auto pose = balance(contact, translated(start), {.on_mobile = {.force_n = {0, 2000, 0}}});
    EXPECT_EQ(pose.outcome, BalanceOutcome::pulled_apart) << reason_of(pose);
    EXPECT_NE(reason_of(pose).find("pulls the bodies apart"), std::string::npos);
  }
}

TEST(LoadBalance, RefusesALoadThatLeavesOverTheRim) {
  // A shallow cup: a cap of 40 degrees, loaded at 70 from its axis.
  TriMesh cap = test::cup(25, 6);
  std::erase_if(cap.triangles, [&](const Triangle& t) { return cap.vertices.y[t[0]] > -25 * std::cos(0.7); });
  const ElasticContact contact(cap, posed(generic_turn(), test::sphere(Vec3::Zero(), 24.8, 6)),
                               {.casting = Casting::fixed, .fixed = layer_of_stiffness(6)});
  const double angle = 1.22;
  const auto pose = balance(contact, translated({0, -0.4, 0}),
                            {.on_mobile = {.force_n = 2000 * Vec3(std::sin(angle), -std::cos(angle), 0)}});
  EXPECT_EQ(pose.outcome, BalanceOutcome::over_the_rim) << reason_of(pose);
  EXPECT_NE(reason_of(pose).find("over the rim"), std::string::npos);
  EXPECT_LE(pose.residual.force_n.norm(), 2000 * (1 + 1e-12)) << "no more than was applied";
}

TEST(LoadBalance, RefusesALoadAlongAFreeDirection) {
  // A block on a plane: nothing holds it along the plane.
  const ElasticContact contact(test::box({-40, -10, -40}, {40, 0, 40}), test::box({-5, 0, -5}, {5, 5, 5}),
                               {.casting = Casting::mobile, .fixed = layer_of_stiffness(6)});
  const auto pose = balance(contact, translated({0, -0.1, 0}), {.on_mobile = {.force_n = {10, -500, 0}}});
  ASSERT_EQ(pose.outcome, BalanceOutcome::free_direction) << reason_of(pose);
  EXPECT_LT(std::abs(pose.direction.y()), 1e-6);
  EXPECT_NE(reason_of(pose).find("prescribe it"), std::string::npos);
  // Prescribed, the rest is carried: 100 mm^2 at 6 MPa per mm.
  const auto held = balance(contact, translated({0, -0.1, 0}), {.on_mobile = {.force_n = {10, -300, 0}}},
                            {.free_directions = {Vec3::UnitY()}});
  ASSERT_EQ(held.outcome, BalanceOutcome::balanced) << reason_of(held);
  EXPECT_NEAR(held.X_FM.translation().y(), -0.5, 1e-9);
}

TEST(LoadBalance, StopsWhereTheForceJumps) {
  // A block on a plane: 100 mm^2 at 6 MPa per mm carry 300 N at the reach of 0.5 mm, and nothing beyond.
  const ElasticContact contact(
      test::box({-40, -10, -40}, {40, 0, 40}), test::box({-5, 0, -5}, {5, 5, 5}),
      {.casting = Casting::mobile, .rays = {.reach_mm = 0.5}, .fixed = layer_of_stiffness(6)});
  const BalanceOptions along_y{.free_directions = {Vec3::UnitY()}};
  const auto one_percent_more = balance(contact, translated({0, -0.3, 0}), down(303), along_y);
  ASSERT_EQ(one_percent_more.outcome, BalanceOutcome::at_jump) << reason_of(one_percent_more);
  EXPECT_TRUE(one_percent_more.carries_load());
  EXPECT_GE(one_percent_more.X_FM.translation().y(), -0.5);
  const double left = one_percent_more.residual.force_n.norm();
  EXPECT_GE(left, 3);
  EXPECT_LE(left, 303 * along_y.most_left_at_jump);
  EXPECT_LE(one_percent_more.steps, 3) << "each at least four times as near";
  EXPECT_NE(reason_of(one_percent_more).find(" N are left, and no step"), std::string::npos)
      << reason_of(one_percent_more);
  const BalanceOptions no_share{.free_directions = {Vec3::UnitY()}, .most_left_at_jump = 1.5};
  EXPECT_THROW(balance(contact, translated({0, -0.3, 0}), down(303), no_share), UsageError);
  const auto a_tenth_more = balance(contact, translated({0, -0.3, 0}), down(330), along_y);
  EXPECT_EQ(a_tenth_more.outcome, BalanceOutcome::over_the_rim) << reason_of(a_tenth_more);
  EXPECT_FALSE(a_tenth_more.carries_load());
}

TEST(LoadBalance, ReportsABalanceThatTheContactDoesNotKeep) {
  // A ball on top of a ball.
  const ElasticContact contact(test::sphere(Vec3::Zero(), 20, 5),
                               posed(generic_turn(), test::sphere(Vec3::Zero(), 20, 5)),
                               {.casting = Casting::fixed, .fixed = layer_of_stiffness(6)});
  const auto pose = balance(contact, translated({0, 39.5, 0}), down(60));
  ASSERT_EQ(pose.outcome, BalanceOutcome::unstable) << reason_of(pose);
  EXPECT_LT(std::abs(pose.direction.y()), 0.1);
}

TEST(LoadBalance, RefusesWhatHasNoMeaning) {
  const ElasticContact contact = cup_and_ball(small, 3);
  const auto refused = [&](const Load& load, const BalanceOptions& options) {
    EXPECT_THROW(balance(contact, Pose::Identity(), load, options), UsageError);
  };
  refused({}, {});
  refused(down(std::nan("")), {});
  refused(down(100), {.free_directions = {Vec3::UnitX()}});
  refused(down(100), {.free_directions = {Vec3::UnitY(), Vec3(0, 2, 0)}});
  refused(down(100), {.free_directions = {Vec3::Zero()}});
}

}  // namespace
}  // namespace condyle::contact
