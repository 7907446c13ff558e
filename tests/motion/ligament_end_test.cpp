#include "motion/events/ligament_end.hpp"

#include "core/rotation_about.hpp"
#include "support/test.hpp"

namespace condyle::motion {
namespace {

using std::numbers::pi;

Pose turned_about(const AxisFrame& axis, const Pose& X, double angle) {
  const Eigen::Matrix3d R = core::rotation_about(axis.direction(), angle);
  Pose out = X;
  out.linear() = R * X.linear();
  out.translation() = axis.point() + R * (X.translation() - axis.point());
  return out;
}

/// Strain over what it may be, mm of length; empty where the length is not known.
std::optional<double> excess(const Ligament& ligament, const Pose& X) {
  const auto state = ligament_state(ligament, X);
  if (!state) return std::nullopt;
  return state->length_mm - ligament.slack_length_mm * (1 + *ligament.ends_at_strain);
}

enum class Kind { straight, over_head, cylinder, sphere };

struct Scene {
  Ligament ligament;
  AxisFrame axis{Vec3::Zero(), Vec3::UnitZ()};
  Pose X_FM = Pose::Identity();
};

Scene random_scene(std::mt19937& random, Kind kind) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any(0, 1);
  const auto point = [&](double size) {
    return Vec3(size * normal(random), size * normal(random), size * normal(random));
  };
  Scene scene;
  Ligament& ligament = scene.ligament;
  const auto far_point = [&] {
    const Vec3 p = point(30);
    return Vec3(p.normalized() * std::max(p.norm(), 26.0));
  };
  ligament = {.name = "string", .fixed = {far_point()}, .mobile = {far_point()}};
  if (random() % 4 == 0) ligament.fixed.insert(ligament.fixed.begin(), point(30));
  scene.axis = AxisFrame(kind == Kind::over_head ? Vec3(Vec3::Zero()) : point(5), point(1));
  scene.X_FM.linear() = core::rotation_about(point(1).normalized(), 2 * normal(random));
  if (kind != Kind::straight)
    ligament.wrap = LigamentWrap{.shape = kind == Kind::cylinder ? WrapShape::cylinder : WrapShape::sphere,
                                 .body = random() % 2 ? BodyRole::fixed : BodyRole::mobile,
                                 .centre = kind == Kind::over_head ? Vec3(Vec3::Zero()) : point(1),
                                 .axis = point(1).normalized(),
                                 .radius_mm = 15};
  // Joints refuse a wrap with an end of its own body inside.
  if (ligament.wrap) {
    const Vec3 from = (ligament.wrap->body == BodyRole::fixed ? ligament.fixed : ligament.mobile).back() -
                      ligament.wrap->centre;
    const Vec3 across =
        kind == Kind::cylinder ? Vec3(from - from.dot(ligament.wrap->axis) * ligament.wrap->axis) : from;
    if (across.norm() < 16) return random_scene(random, kind);
  }
  // The ligament ends at a length that it has in the turn, or a little beyond, where nothing ends.
  ligament.ends_at_strain = 0.1;
  double least = 1e9, most = 0;
  ligament.slack_length_mm = 1;
  for (int i = 0; i < 64; ++i)
    if (const auto over = excess(ligament, turned_about(scene.axis, scene.X_FM, i * pi / 32)))
      least = std::min(least, *over), most = std::max(most, *over);
  ligament.slack_length_mm = 1 + (least + (most - least) * (1.2 * any(random) - 0.1)) / 1.1;
  return scene;
}

class LigamentEnd : public ::testing::TestWithParam<Kind> {};

TEST_P(LigamentEnd, IsStrainedWhereItsLengthSaysSoAndNowhereElse) {
  // Others with --gtest_shuffle and --gtest_random_seed.
  std::mt19937 random(3u + static_cast<unsigned>(testing::UnitTest::GetInstance()->random_seed()));
  const int scenes = GetParam() == Kind::straight || GetParam() == Kind::over_head ? 4000 : 150;
  int ended = 0, within_little = 0;
  for (int i = 0; i < scenes; ++i) {
    const Scene scene = random_scene(random, GetParam());
    if (!(scene.ligament.slack_length_mm > 0)) continue;
    const StrainedAngles angles = strained_angles(scene.ligament, scene.axis, scene.X_FM);
    // Seldom a length stays so near to its end over much of the turn that no interval of the search decides.
    within_little += angles.error_bound.radians() > 1e-4;
    for (int k = 0; k < 90; ++k) {
      const double t = 2 * pi * (k + 0.37) / 90;
      const auto over = excess(scene.ligament, turned_about(scene.axis, scene.X_FM, t));
      if (!over) {
        EXPECT_TRUE(angles.unknown.contains(Angle::radians(t))) << i;
        EXPECT_TRUE(angles.beyond.contains(Angle::radians(t))) << i;
      } else if (std::abs(*over) > 100 * angles.error_bound.radians() + 1e-11) {
        EXPECT_EQ(angles.beyond.contains(Angle::radians(t)), *over > 0) << i << " at " << t;
      }
    }
    if (angles.beyond.empty() || angles.beyond.is_full_turn()) continue;
    for (const core::Arc& arc : angles.beyond.arcs())
      for (const double end : {arc.start.radians(), (arc.start + arc.width).radians()}) {
        if (angles.is_unknown_at(Angle::radians(end))) continue;
        const auto over = excess(scene.ligament, turned_about(scene.axis, scene.X_FM, end));
        ASSERT_TRUE(over) << i;
        // Within the bound of its place: lengths change by the distance from the axis at most.
        EXPECT_NEAR(*over, 0, 200 * angles.error_bound.radians() + 1e-11) << i;
        ++ended;
      }
  }
  EXPECT_GT(ended, scenes / 2);
  EXPECT_LE(within_little, scenes / 50);
}

INSTANTIATE_TEST_SUITE_P(Kinds, LigamentEnd,
                         ::testing::Values(Kind::straight, Kind::over_head, Kind::cylinder, Kind::sphere));

TEST(LigamentEnd, OfAStraightStringIsTheRootOfItsLengthToAPicoradian) {
  const AxisFrame axis(Vec3::Zero(), Vec3::UnitZ());
  // From (30, 0, 0) to (30 cos t, 30 sin t, 40): |a - b|^2 = 1600 + 3600 sin^2(t / 2).
  Ligament ligament{
      .fixed = {Vec3(30, 0, 0)}, .mobile = {Vec3(30, 0, 40)}, .slack_length_mm = 40, .ends_at_strain = 0.25};
  const double root = 2 * std::asin(30.0 / 60);
  const std::vector<core::Arc> arcs = strained_angles(ligament, axis, Pose::Identity()).beyond.arcs();
  ASSERT_EQ(arcs.size(), 1u);
  EXPECT_NEAR(arcs[0].start.radians(), root, 1e-12);
  EXPECT_NEAR((arcs[0].start + arcs[0].width).radians(), 2 * pi - root, 1e-12);
  ligament.ends_at_strain = 1;  // 80 mm, and it never has more than 72.1
  EXPECT_TRUE(strained_angles(ligament, axis, Pose::Identity()).beyond.empty());
  ligament.slack_length_mm = 10;  // 20 mm, and it always has 40
  EXPECT_TRUE(strained_angles(ligament, axis, Pose::Identity()).beyond.is_full_turn());
}

TEST(LigamentEnd, OfAStringThatJustReachesItsStrainIsNotMissed) {
  const AxisFrame axis(Vec3::Zero(), Vec3::UnitZ());
  const Ligament ligament{.fixed = {Vec3(30, 0, 0)},
                          .mobile = {Vec3(30, 0, 0)},
                          .slack_length_mm = 60 / 1.5 * (1 - 1e-13),
                          .ends_at_strain = 0.5};
  const core::ArcSet beyond = strained_angles(ligament, axis, Pose::Identity()).beyond;
  EXPECT_TRUE(beyond.contains(Angle::radians(pi)));
  EXPECT_LT(beyond.measure().radians(), 1e-5);
}

TEST(LigamentEnd, OverTheHeadIsWhereTheArcIsLongEnough) {
  const AxisFrame axis(Vec3::Zero(), Vec3::UnitZ());
  Ligament ligament{.fixed = {Vec3(50, 0, 0)}, .mobile = {Vec3(50, 0, 0)}, .ends_at_strain = 0.1};
  ligament.wrap = LigamentWrap{.radius_mm = 40};
  const double wanted = 2.5;  // rad, wrapped from 2 acos(0.8) = 1.29 on
  ligament.slack_length_mm = (60 + 40 * (wanted - 2 * std::acos(0.8))) / 1.1;
  const std::vector<core::Arc> arcs = strained_angles(ligament, axis, Pose::Identity()).beyond.arcs();
  ASSERT_EQ(arcs.size(), 1u);
  EXPECT_NEAR(arcs[0].start.radians(), wanted, 1e-12);
  // Before it wraps it is straight: 2 * 50 sin(t / 2).
  ligament.slack_length_mm = 100 * std::sin(0.5) / 1.1;
  EXPECT_NEAR(strained_angles(ligament, axis, Pose::Identity()).beyond.arcs()[0].start.radians(), 1, 1e-12);
}

}  // namespace
}  // namespace condyle::motion
