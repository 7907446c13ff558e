#include "condyle/joint.hpp"
#include "core/rotation_about.hpp"
#include "support/test.hpp"

/// How fast ligaments of a moving body become longer, and what their damping adds.

namespace condyle {
namespace {

using Poses = std::vector<std::optional<Pose>>;

Pose turned(const Vec3& axis, double radians, const Vec3& translation) {
  Pose X = Pose::Identity();
  X.linear() = core::rotation_about(axis, radians);
  X.translation() = translation;
  return X;
}

TEST(LigamentsAlong, LengthenByTheSlopeOfTheirLength) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) {
    return Vec3(size * normal(random), size * normal(random), size * normal(random));
  };
  std::array<int, 2> wrapped = {};
  for (int i = 0; i < 2000; ++i) {
    Ligament ligament{
        .name = "string", .fixed = {vector(60), vector(60)}, .mobile = {vector(60)}, .slack_length_mm = 30};
    if (i % 3 > 0)
      ligament.wrap = LigamentWrap{.shape = i % 3 == 1 ? WrapShape::sphere : WrapShape::cylinder,
                                   .body = i % 2 ? BodyRole::fixed : BodyRole::mobile,
                                   .centre = vector(6),
                                   .axis = vector(1).normalized(),
                                   .radius_mm = 20};
    const Pose X = turned(vector(1).normalized(), 3 * normal(random), vector(3));
    const RelativeMotion motion{vector(50), vector(2)};
    const auto length_after = [&](double s) {
      const Pose later =
          turned(motion.angular_velocity_rad_s.normalized(), s * motion.angular_velocity_rad_s.norm(),
                 X.translation() + s * motion.velocity_mm_s);
      Pose at = later;
      at.linear() = later.linear() * X.linear();
      const auto state = ligament_state(ligament, at);
      return state && state->wraps == ligament_state(ligament, X)->wraps ? state->length_mm : std::nan("");
    };
    const auto speed = lengthening_mm_s(ligament, X, motion);
    ASSERT_EQ(speed.has_value(), ligament_state(ligament, X).has_value());
    if (!speed) continue;
    const auto slope_over = [&](double h) { return (length_after(h) - length_after(-h)) / (2 * h); };
    const double slope = slope_over(1e-5), finer = slope_over(5e-6);
    if (std::isnan(slope) || std::isnan(finer)) continue;
    wrapped[ligament.wrap && ligament.wrap->body == BodyRole::fixed] += ligament_state(ligament, X)->wraps;
    // Half the step has a quarter of the error, which is large where a path bends much; rounding leaves 1e-8.
    EXPECT_NEAR(*speed, finer, std::abs(slope - finer) + 1e-7) << i;
  }
  EXPECT_GT(wrapped[0], 50);
  EXPECT_GT(wrapped[1], 50);
}

TEST(LigamentsAlong, AreDampedWhileTheyAreTautAndBecomeLonger) {
  const Ligament ligament{.damping_n_s = 0.5};
  EXPECT_EQ(damping_n(ligament, -0.01, 3), 0);
  EXPECT_EQ(damping_n(ligament, 0, 3), 0);
  EXPECT_EQ(damping_n(ligament, 0.04, -3), 0);
  EXPECT_DOUBLE_EQ(damping_n(ligament, 0.04, 3), 1.5);
  EXPECT_DOUBLE_EQ(damping_n(ligament, 0.01, 3), 1.5);
  // The step is a half in its middle, and 10 / 4^3 - 15 / 4^4 + 6 / 4^5 = 106 / 1024 at a quarter.
  EXPECT_DOUBLE_EQ(damping_n(ligament, 0.005, 3), 0.75);
  EXPECT_DOUBLE_EQ(damping_n(ligament, 0.0025, 3), 1.5 * 106 / 1024);
}

TEST(LigamentsAlong, HaveTensionAndDampingTogether) {
  // 40 mm long at first, 1 % strained in every second of the way down.
  const std::vector<Ligament> ligaments = {{.name = "a",
                                            .fixed = {Vec3(0, 0, 0)},
                                            .mobile = {Vec3(0, 0, 0)},
                                            .slack_length_mm = 40,
                                            .stiffness_n = 1000,
                                            .damping_n_s = 20}};
  Poses X_FM;
  for (const double y : {-40.0, -40.4, -40.8, -40.4}) {
    X_FM.emplace_back(Pose::Identity());
    X_FM.back()->translation() = Vec3(0, y, 0);
  }
  const auto along = ligaments_along(ligaments, X_FM, motions_along(X_FM, {0, 1, 2, 3}));
  ASSERT_EQ(along[0].damping.size(), 4u);
  EXPECT_EQ(along[0].damping[0]->damping_n, 0);  // just taut
  EXPECT_NEAR(along[0].damping[1]->lengthening_mm_s, 0.4, 1e-12);
  EXPECT_NEAR(along[0].damping[1]->damping_n, 20 * 0.01, 1e-12);
  EXPECT_NEAR(along[0].damping[1]->total_n, 1000 * 0.01 * 0.01 / 0.12 + 0.2, 1e-12);
  EXPECT_NEAR(along[0].damping[2]->lengthening_mm_s, 0, 1e-12);
  EXPECT_NEAR(along[0].damping[3]->lengthening_mm_s, -0.8, 1e-12);
  EXPECT_EQ(along[0].damping[3]->total_n, along[0].frames[3]->tension_n);
  EXPECT_TRUE(ligaments_along(ligaments, X_FM)[0].damping.empty());
}

TEST(LigamentsAlong, MoveAsASteadyTurnAndAParabolaDo) {
  const std::vector<double> time_s = {0, 0.1, 0.25, 0.3, 0.7, 0.8};  // at no steady rate
  const Vec3 axis = Vec3(1, 2, 2) / 3, v0(3, -2, 1), a(-4, 10, 6);
  const double rate = 3;  // more than a half turn in all
  Poses X_FM;
  for (const double t : time_s) X_FM.push_back(turned(axis, rate * t, t * v0 + t * t / 2 * a));
  const auto motions = motions_along(X_FM, time_s);
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    ASSERT_TRUE(motions[i].has_value());
    EXPECT_LT((motions[i]->velocity_mm_s - (v0 + time_s[i] * a)).norm(), 1e-12) << i;
    EXPECT_LT((motions[i]->angular_velocity_rad_s - rate * axis).norm(), 1e-12) << i;
  }
}

TEST(LigamentsAlong, MoveByTheFramesOfTheirRunAlone) {
  const auto at = [](double x) { return std::optional(turned(Vec3::UnitX(), 0, Vec3(x, 0, 0))); };
  const Poses X_FM = {at(1), std::nullopt, at(2), at(5), std::nullopt, at(0), at(1), at(4)};
  const auto motions = motions_along(X_FM, {0, 1, 2, 3, 4, 5, 6, 7});
  const auto speed = [&](std::size_t i) { return motions[i]->velocity_mm_s.x(); };
  EXPECT_FALSE(motions[0] || motions[1] || motions[4]);
  EXPECT_DOUBLE_EQ(speed(2), 3);
  EXPECT_DOUBLE_EQ(speed(3), 3);
  // x = t^2, seen from its start.
  EXPECT_NEAR(speed(5), 0, 1e-12);
  EXPECT_NEAR(speed(6), 2, 1e-12);
  EXPECT_NEAR(speed(7), 4, 1e-12);
}

}  // namespace
}  // namespace condyle
