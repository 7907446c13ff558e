#include "condyle/joint.hpp"

#include "core/rotation_about.hpp"
#include "kinematics/ligament_path.hpp"
#include "support/random_pose.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

using std::numbers::pi;

Ligament straight_ligament(const Vec3& fixed, const Vec3& mobile) {
  return {.name = "string", .fixed = {fixed}, .mobile = {mobile}, .slack_length_mm = 1, .stiffness_n = 100};
}

LigamentState state_at(const Ligament& ligament, const Pose& X_FM = Pose::Identity()) {
  const auto state = ligament_state(ligament, X_FM);
  EXPECT_TRUE(state.has_value());
  return state.value_or(LigamentState{});
}

/// Where f, which is positive at low and negative at high, is zero.
double bisected(double low, double high, const std::function<double(double)>& f) {
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (f(middle) > 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// The least value of a convex function near 0.
double least(const std::function<double(double)>& f) {
  double low = -200, high = 200;
  for (int i = 0; i < 300; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
  }
  return f((low + high) / 2);
}

/// The length of a path over a cylinder of radius r about z, by its definition: it leaves a circle where its direction is the tangent's, found by
/// bisection, and the heights of the two places where it touches are those of the shortest one.
double length_over_cylinder(double r, const Vec3& a, const Vec3& b) {
  const double to_a = std::hypot(a.x(), a.y()), to_b = std::hypot(b.x(), b.y());
  double between = std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x());
  while (between > pi) between -= 2 * pi;
  while (between < -pi) between += 2 * pi;
  // The tangent at the angle s from the point at distance d: (d - r cos s, - r sin s) . (cos s, sin s) = 0.
  const auto tangent = [&](double d) {
    return bisected(0, pi / 2, [&](double s) { return d * std::cos(s) - r; });
  };
  const double alpha = tangent(to_a), beta = tangent(to_b), arc = r * (std::abs(between) - alpha - beta);
  if (arc <= 0) return (a - b).norm();
  const double from_a = to_a * std::sin(alpha), from_b = to_b * std::sin(beta);
  const auto length = [&](double za, double zb) {
    return std::hypot(from_a, za - a.z()) + std::hypot(arc, zb - za) + std::hypot(from_b, b.z() - zb);
  };
  return least([&](double za) { return least([&](double zb) { return length(za, zb); }); });
}

/// Strings of all kinds whose ends are outside of what they wrap.
Ligament random_ligament(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const auto point = [&] { return Vec3(60 * normal(random), 60 * normal(random), 60 * normal(random)); };
  Ligament ligament = straight_ligament(point(), point());
  ligament.slack_length_mm = 30;
  if (random() % 2) ligament.fixed.insert(ligament.fixed.begin(), point());
  if (random() % 2) ligament.mobile.insert(ligament.mobile.begin(), point());
  if (random() % 3 == 0) return ligament;
  LigamentWrap wrap{.body = random() % 2 ? BodyRole::fixed : BodyRole::mobile};
  wrap.shape = random() % 2 ? WrapShape::sphere : WrapShape::cylinder;
  wrap.centre = 0.1 * point();
  wrap.axis = point().normalized();
  wrap.radius_mm = 20;
  ligament.wrap = wrap;
  return ligament;
}

TEST(Ligament, IsStraightBetweenItsPointsWhereNothingIsInItsWay) {
  Ligament ligament = straight_ligament({0, 0, 0}, {0, -3, 4});
  ligament.fixed.insert(ligament.fixed.begin(), Vec3(12, 0, 0));
  const LigamentState state = state_at(ligament);
  EXPECT_DOUBLE_EQ(state.length_mm, 17);
  EXPECT_DOUBLE_EQ(state.strain, 16);
  EXPECT_NEAR((state.force_n - 100 * (16 - 0.03) * Vec3(0, 0.6, -0.8)).norm(), 0, 1e-10);
}

TEST(Ligament, CarriesNothingWhileItIsSlackAndMoreOnceAllFibresDo) {
  const Ligament ligament = {.slack_length_mm = 40, .stiffness_n = 2000, .transition_strain = 0.06};
  EXPECT_EQ(tension_n(ligament, -0.1), 0);
  EXPECT_EQ(tension_n(ligament, 0), 0);
  EXPECT_DOUBLE_EQ(tension_n(ligament, 0.03), 2000 * 0.03 * 0.03 / 0.12);
  EXPECT_NEAR(tension_n(ligament, 0.06), 60, 1e-12);
  EXPECT_DOUBLE_EQ(tension_n(ligament, 0.1), 2000 * 0.07);
  // The energy is the integral of the tension over the length.
  for (const double end : {0.02, 0.06, 0.11}) {
    double sum = 0;
    const int steps = 20000;
    for (int i = 0; i < steps; ++i) sum += tension_n(ligament, end * (i + 0.5) / steps) * 40 * end / steps;
    EXPECT_NEAR(energy_nmm(ligament, end), sum, 1e-6);
  }
}

TEST(Ligament, WrapsASphereByTheArcBetweenItsTangents) {
  Ligament ligament = straight_ligament({50, 0, 0}, {0, 0, -50});
  ligament.wrap = LigamentWrap{.radius_mm = 40};
  const double tangent = 30, alpha = std::acos(0.8);
  EXPECT_NEAR(state_at(ligament).length_mm, 2 * tangent + 40 * (pi / 2 - 2 * alpha), 1e-12);
  EXPECT_TRUE(state_at(ligament).wraps);
  // Opposite each other: half a great circle less both angles, whichever way it takes.
  ligament.mobile = {Vec3(-50, 0, 0)};
  EXPECT_NEAR(state_at(ligament).length_mm, 2 * tangent + 40 * (pi - 2 * alpha), 1e-12);
  // Just free of it.
  const double free = 2 * alpha - 1e-9;
  ligament.mobile = {50 * Vec3(std::cos(free), std::sin(free), 0)};
  EXPECT_FALSE(state_at(ligament).wraps);
  EXPECT_NEAR(state_at(ligament).length_mm, 2 * tangent, 1e-6);
}

TEST(Ligament, WrapsACylinderOnItsShortestPath) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  int wrapped = 0;
  for (int i = 0; i < 60; ++i) {
    const double r = 20;
    const auto around = [&] {
      const double angle = pi * any(random), far = r + 0.01 + 20 * (1 + any(random));
      return Vec3(far * std::cos(angle), far * std::sin(angle), 60 * any(random));
    };
    const Vec3 a = around(), b = around();
    Ligament ligament = straight_ligament(a, b);
    ligament.wrap = LigamentWrap{.shape = WrapShape::cylinder, .radius_mm = r};
    ligament.wrap->centre.z() = 17;
    const LigamentState state = state_at(ligament);
    EXPECT_NEAR(state.length_mm, length_over_cylinder(r, a, b), 1e-9);
    wrapped += state.wraps;
  }
  EXPECT_GT(wrapped, 10);
}

TEST(Ligament, HasNoLengthWhereAnEndIsInsideItsWrapOrItMeetsAnEllipsoid) {
  Ligament ligament = straight_ligament({50, 0, 0}, {30, 0, 0});
  ligament.wrap = LigamentWrap{.radius_mm = 40};
  EXPECT_FALSE(ligament_state(ligament, Pose::Identity()).has_value());
  ligament = straight_ligament({0, 0, 10}, {40, 0, 10});
  ligament.wrap = LigamentWrap{.shape = WrapShape::ellipsoid};
  ligament.wrap->centre = Vec3(20, 0, 0);
  ligament.wrap->radii_mm = Vec3(5, 8, 9.999);
  EXPECT_DOUBLE_EQ(state_at(ligament).length_mm, 40);
  ligament.wrap->radii_mm = Vec3(5, 8, 10.001);
  EXPECT_FALSE(ligament_state(ligament, Pose::Identity()).has_value());
  // Turned by a quarter about x, its third radius lies along y.
  ligament.wrap->axes = core::rotation_about(Vec3::UnitX(), pi / 2);
  EXPECT_DOUBLE_EQ(state_at(ligament).length_mm, 40);
}

TEST(Ligament, PullsTheMobileBodyByTheSlopeOfItsEnergy) {
  std::mt19937 random(11);
  int taut = 0, wrapped = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ligament ligament = random_ligament(random);
    const Pose X = test::random_pose(random, 3);
    const auto state = ligament_state(ligament, X);
    if (!state || state->strain < 0.01) continue;
    ++taut, wrapped += state->wraps;
    const double step = 1e-4;
    const auto energy_moved = [&](const Vec3& shift, const Vec3& turn) {
      Pose moved = X;
      const double angle = turn.norm();
      const Eigen::Matrix3d R = angle > 0 ? core::rotation_about(turn / angle, angle)
                                          : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
      moved.linear() = R * X.linear();
      moved.translation() = R * X.translation() + shift;
      const auto at = ligament_state(ligament, moved);
      return at ? at->energy_nmm : std::nan("");
    };
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 e = Vec3::Unit(axis);
      const double by_shift =
          (energy_moved(step * e, Vec3::Zero()) - energy_moved(-step * e, Vec3::Zero())) / (2 * step);
      const double turn = step / 100;
      const double by_turn =
          (energy_moved(Vec3::Zero(), turn * e) - energy_moved(Vec3::Zero(), -turn * e)) / (2 * turn);
      if (std::isnan(by_shift) || std::isnan(by_turn)) continue;
      EXPECT_NEAR(-by_shift, state->force_n[axis], 1e-6 * (1 + state->tension_n)) << i;
      EXPECT_NEAR(-by_turn, state->moment_nmm[axis], 1e-4 * (1 + state->tension_n)) << i;
    }
  }
  EXPECT_GT(taut, 1000);
  EXPECT_GT(wrapped, 100);
}

TEST(Ligament, StiffensByTheSlopeOfItsTensionAlongItAndByItsTensionAcross) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const auto skew = [](const Vec3& v) {
    Eigen::Matrix3d S;
    S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return S;
  };
  for (int i = 0; i < 200; ++i) {
    const auto point = [&] { return Vec3(60 * normal(random), 60 * normal(random), 60 * normal(random)); };
    Ligament ligament = straight_ligament(point(), point());
    const Pose X = test::random_pose(random, 5);
    const Vec3 end = posed(X, ligament.mobile.front()), along = end - ligament.fixed.front();
    const double length = along.norm(), strain = 0.12;
    ligament.slack_length_mm = length / (1 + strain);
    const LigamentState state = state_at(ligament, X);
    // df = -A dp of the mobile end p, by the slope k / L0 along the string and T / L across it. About the origin of M, with r from there to p
    // and f the force on it: dp = dx + dw x r, and the moment r x f changes by (dw x r) x f + r x df.
    const Vec3 u = along / length, r = end - X.translation();
    const Eigen::Matrix3d out = u * u.transpose();
    const Eigen::Matrix3d A = ligament.stiffness_n / ligament.slack_length_mm * out +
                              state.tension_n / length * (Eigen::Matrix3d::Identity() - out);
    Matrix6 expected;
    expected << A, -A * skew(r), skew(r) * A, -skew(r) * A * skew(r) - skew(state.force_n) * skew(r);
    const auto stiffness = ligament_stiffness(ligament, X);
    ASSERT_TRUE(stiffness.has_value());
    EXPECT_LT((*stiffness - expected).norm(), 1e-6 * expected.norm()) << i;
  }
  Ligament slack = straight_ligament({0, 0, 0}, {10, 0, 0});
  slack.slack_length_mm = 20;
  EXPECT_EQ(*ligament_stiffness(slack, Pose::Identity()), Matrix6(Matrix6::Zero()));
}

TEST(Ligament, StiffensOverAWrapByTheSecondSlopeOfItsEnergy) {
  std::mt19937 random(17);
  int wrapped = 0;
  for (int i = 0; i < 2000; ++i) {
    Ligament ligament = random_ligament(random);
    const Pose X = test::random_pose(random, 3);
    const auto state = ligament_state(ligament, X);
    if (!state || !state->wraps) continue;
    ligament.slack_length_mm = state->length_mm / 1.15;
    ligament.stiffness_n = 100, ligament.transition_strain = 0.06;
    const auto stiffness = ligament_stiffness(ligament, X);
    if (!stiffness) continue;
    const auto energy = [&](const Vec3& shift) {
      return ligament_state(ligament, core::moved_by(X, shift, Vec3::Zero()))
          .value_or(LigamentState{})
          .energy_nmm;
    };
    // Beside the surface of a wrap a path bends within hundredths of a mm.
    constexpr double h = 1e-3;
    bool wraps_beside = true;
    for (int axis = 0; axis < 3; ++axis)
      for (const double by : {-h, h}) {
        const auto beside = ligament_state(ligament, core::moved_by(X, by * Vec3::Unit(axis), Vec3::Zero()));
        wraps_beside = wraps_beside && beside && beside->wraps;
      }
    if (!wraps_beside) continue;
    ++wrapped;
    const double size = stiffness->topLeftCorner<3, 3>().norm();
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = h * Vec3::Unit(axis);
      const double second = (energy(step) - 2 * energy(Vec3::Zero()) + energy(-step)) / (h * h);
      EXPECT_NEAR((*stiffness)(axis, axis), second, 1e-3 * size) << i;
    }
  }
  EXPECT_GT(wrapped, 50);
}

TEST(Ligament, IsDrawnAlongItsPath) {
  std::mt19937 random(5);
  int wrapped = 0;
  for (int i = 0; i < 300; ++i) {
    const Ligament ligament = random_ligament(random);
    const Pose X = test::random_pose(random, 3);
    const auto state = ligament_state(ligament, X);
    if (!state) continue;
    wrapped += state->wraps;
    const std::vector<Vec3> path = kinematics::ligament_points(ligament, X);
    EXPECT_EQ(path.front(), ligament.fixed.front());
    EXPECT_EQ(path.back(), posed(X, ligament.mobile.front()));
    double length = 0;
    for (std::size_t k = 1; k < path.size(); ++k) length += (path[k] - path[k - 1]).norm();
    // Chords of a tenth of a radian are shorter than their arcs by (0.1)^2 / 24.
    EXPECT_LE(length, state->length_mm * (1 + 1e-12));
    EXPECT_GE(length, state->length_mm * (1 - 4.2e-4));
    if (!state->wraps) {
      EXPECT_NEAR(length, state->length_mm, 1e-9);
    }
  }
  EXPECT_GT(wrapped, 15);
}

TEST(Ligament, TakesBackOnTheWayHomeTheWorkThatStretchedIt) {
  Ligament ligament = straight_ligament({45, 10, 0}, {-20, -40, 10});
  ligament.slack_length_mm = 70;
  ligament.wrap = LigamentWrap{.shape = WrapShape::cylinder, .body = BodyRole::fixed, .radius_mm = 15};
  const int steps = 20000;
  double work = 0, stretched = 0;
  for (int i = 0; i < steps; ++i) {
    const auto pose = [&](double t) {
      Pose X = Pose::Identity();
      X.linear() = core::rotation_about(Vec3(1, 2, 2) / 3, 0.4 * std::sin(2 * pi * t));
      X.translation() = 10 * Vec3(std::cos(2 * pi * t), std::sin(2 * pi * t), std::sin(4 * pi * t));
      return X;
    };
    const double middle = (i + 0.5) / steps;
    const LigamentState state = state_at(ligament, pose(middle));
    // Power of a point of the mobile body in the middle of the step, by the motion of its origin and its turn about it.
    const Pose from = pose(static_cast<double>(i) / steps), to = pose((i + 1.0) / steps), X = pose(middle);
    const Eigen::Matrix3d spin = (to.linear() - from.linear()) * X.linear().transpose();
    const Vec3 turn(spin(2, 1), spin(0, 2), spin(1, 0)), shift = to.translation() - from.translation();
    const Vec3 about_origin = state.moment_nmm - X.translation().cross(state.force_n);
    const double done = state.force_n.dot(shift) + about_origin.dot(turn);
    work += done, stretched += std::abs(done);
  }
  EXPECT_GT(stretched, 100);
  EXPECT_NEAR(work / stretched, 0, 1e-6);
}

}  // namespace
}  // namespace condyle
