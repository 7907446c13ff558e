#include "motion/events/cylinder_box.hpp"

#include <rapidcheck/gtest.h>

#include "support/test.hpp"

namespace condyle::motion {
namespace {

using Point = Triple<double>;
using std::numbers::pi;

std::mt19937 random_boxes() {
  return std::mt19937(*rc::gen::arbitrary<unsigned>());
}
double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Near and far from the axis, near and far from each other, and on the axis at times.
std::array<Point, 3> random_corners(std::mt19937& random) {
  const double away = std::pow(10, uniform(random, -3, 4)), size = std::pow(10, uniform(random, -3, 2));
  const double theta = uniform(random, 0, two_pi);
  std::array<Point, 3> corners;
  for (Point& p : corners) {
    p = {away * std::cos(theta) + uniform(random, -size, size),
         away * std::sin(theta) + uniform(random, -size, size), uniform(random, -size, size)};
  }
  if (std::uniform_int_distribution<int>(0, 9)(random) == 0) corners[0].x = corners[0].y = 0;
  return corners;
}

Point mix(const std::array<Point, 3>& t, double a, double b, double c) {
  return {a * t[0].x + b * t[1].x + c * t[2].x, a * t[0].y + b * t[1].y + c * t[2].y,
          a * t[0].z + b * t[1].z + c * t[2].z};
}

/// Computing the point itself and its place rounds, relative to the corners' distance from the axis.
void expect_held(const CylinderBox& box, const Point& p, double far) {
  const CylinderPoint at = cylinder_point(p);
  const double slack = 1e-15 * far;
  RC_ASSERT(box.rho_lo <= at.rho + slack);
  RC_ASSERT(at.rho <= box.rho_hi + slack);
  RC_ASSERT(box.z_lo <= p.z + slack);
  RC_ASSERT(p.z <= box.z_hi + slack);
  RC_ASSERT(box.r_lo <= at.r + slack);
  RC_ASSERT(at.r <= box.r_hi + slack);
  if (at.rho <= 10 * slack) return;
  const double angle_slack = slack / at.rho;
  RC_ASSERT(wrapped(wrapped(at.theta + angle_slack) - box.theta) <= box.theta_width + 2 * angle_slack);
}

RC_GTEST_PROP(CylinderBox, OfATriangleAndOfItsEdgesHoldsEveryPointOfThem, ()) {
  auto random = random_boxes();
  for (int i = 0; i < 100; ++i) {
    const auto t = random_corners(random);
    std::array<CylinderPoint, 3> at;
    double far = 0;
    for (std::size_t k = 0; k < 3; ++k) at[k] = cylinder_point(t[k]), far = std::max(far, at[k].r);
    const auto face = box_of_triangle(t[0], at[0], t[1], at[1], t[2], at[2]);
    const auto edge = box_of_edge(t[0], at[0], t[1], at[1]);
    expect_held(box_of_vertex(t[0], at[0]), t[0], far);
    for (int k = 0; k < 20; ++k) {
      const double a = uniform(random, 0, 1), b = uniform(random, 0, 1 - a);
      expect_held(face, mix(t, a, b, 1 - a - b), far);
      expect_held(edge, mix(t, a, 1 - a, 0), far);
    }
  }
}

RC_GTEST_PROP(CylinderBox, OfABoxHoldsEveryPointOfIt, ()) {
  auto random = random_boxes();
  for (int i = 0; i < 100; ++i) {
    const Point centre = random_corners(random)[1];
    const auto size = [&] { return std::pow(10, uniform(random, -3, 3)); };
    const Point half{size(), size(), size()};
    const auto box = box_of_box(centre, half);
    const double far = cylinder_point(centre).r + half.x + half.y + half.z;
    for (int k = 0; k < 20; ++k) {
      // Corners as often as points inside.
      const auto share = [&] { return std::clamp(uniform(random, -2, 2), -1.0, 1.0); };
      expect_held(
          box, {centre.x + share() * half.x, centre.y + share() * half.y, centre.z + share() * half.z}, far);
    }
  }
}

RC_GTEST_PROP(CylinderBox, HullHoldsBoth, ()) {
  auto random = random_boxes();
  for (int i = 0; i < 100; ++i) {
    const Point p = random_corners(random)[1], q = random_corners(random)[2];
    const auto box = hull(box_of_vertex(p, cylinder_point(p)), box_of_vertex(q, cylinder_point(q)));
    const double far = cylinder_point(p).r + cylinder_point(q).r;
    expect_held(box, p, far);
    expect_held(box, q, far);
  }
}

TEST(CylinderBox, OfATriangleWithTheAxisThroughItsInsideReachesItAllAround) {
  const std::array<Point, 3> t = {Point{2, 0, 1}, Point{-1, 2, 1}, Point{-1, -2, 1}};
  const auto box =
      box_of_triangle(t[0], cylinder_point(t[0]), t[1], cylinder_point(t[1]), t[2], cylinder_point(t[2]));
  EXPECT_EQ(box.rho_lo, 0);
  EXPECT_EQ(box.theta_width, two_pi);
}

TEST(CylinderBox, OfAnEdgeIsNearestToTheAxisInsideIt) {
  const Point a{1, -1, 0}, b{1, 1, 0};
  const auto box = box_of_edge(a, cylinder_point(a), b, cylinder_point(b));
  EXPECT_NEAR(box.rho_lo, 1, 1e-14);
  EXPECT_LE(box.rho_lo, 1);
  EXPECT_NEAR(box.theta_width, pi / 2, 1e-12);
}

CylinderBox arc_from(double start, double width) {
  return {0, 1, 0, 1, 0, 1, start, width};
}

TEST(GapInSense, IsTheAngleBetweenTheArcsEitherWayRound) {
  const auto m = arc_from(0.5, 0.25), f = arc_from(2, 1);
  EXPECT_DOUBLE_EQ(gap_in_sense(m, f, RotationSense::positive), 2 - 0.75);
  EXPECT_DOUBLE_EQ(gap_in_sense(m, f, RotationSense::negative), two_pi - 3 + 0.5);
  const auto across_zero = arc_from(6, 1);
  EXPECT_EQ(gap_in_sense(m, across_zero, RotationSense::positive), 0) << "7 - 2 pi is past 0.5";
  EXPECT_DOUBLE_EQ(gap_in_sense(arc_from(0.8, 0.1), across_zero, RotationSense::positive), 6 - 0.9);
  EXPECT_EQ(gap_in_sense(m, arc_from(0, two_pi), RotationSense::negative), 0);
}

/// The gap is what it says: no turn smaller than it makes the arcs meet, and one as large does.
RC_GTEST_PROP(GapInSense, IsTheSmallestRotationThatMakesTheArcsMeet, ()) {
  auto random = random_boxes();
  const auto m = arc_from(uniform(random, 0, two_pi), uniform(random, 0, 3));
  const auto f = arc_from(uniform(random, 0, two_pi), uniform(random, 0, 3));
  for (const RotationSense sense : {RotationSense::positive, RotationSense::negative}) {
    const double gap = gap_in_sense(m, f, sense), sign = static_cast<double>(sense);
    const auto meets_after = [&](double turn) {
      const double start = wrapped(wrapped(m.theta + sign * turn + two_pi));
      return arcs_meet(arc_from(start, m.theta_width), f);
    };
    RC_ASSERT(meets_after(gap + (gap > 0 ? 1e-12 : 0)));
    for (int k = 0; k < 20 && gap > 0; ++k) RC_ASSERT(!meets_after((gap - 1e-12) * k / 20));
  }
}

}  // namespace
}  // namespace condyle::motion
