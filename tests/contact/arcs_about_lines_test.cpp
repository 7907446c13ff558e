#include "condyle/contact.hpp"
#include "support/test.hpp"

namespace condyle::contact {
namespace {

using Real = long double;
using Point = Eigen::Matrix<Real, 3, 1>;

/// Circles about a line by every triangle's plane, in long double: where one meets the plane within the triangle.
struct CirclesAbout {
  Point point;
  Eigen::Matrix<Real, 3, 3> rows;
  std::vector<std::array<Point, 3>> triangles;

  CirclesAbout(const TriMesh& mesh, const Point& on_line, const Point& direction) : point(on_line) {
    rows.row(2) = direction.normalized();
    rows.row(0) = rows.row(2).cross(Point(0.3L, -0.5L, 0.8L).transpose()).normalized();
    rows.row(1) = rows.row(2).cross(rows.row(0));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      triangles.push_back({seen(mesh.corner(t, 0)), seen(mesh.corner(t, 1)), seen(mesh.corner(t, 2))});
  }
  Point seen(const Vec3& p) const { return rows * (p.cast<Real>() - point); }

  /// The angle to the nearest crossing, below 0 for a vertex that next leaves the solid; infinite if its circle meets nothing.
  double gap(const Vec3& vertex) const {
    constexpr Real turn = 2 * std::numbers::pi_v<Real>;
    const Point v = seen(vertex);
    const Real radius = std::hypot(v.x(), v.y()), own = std::atan2(v.y(), v.x());
    Real first = std::numeric_limits<Real>::infinity(), last = 0;
    bool leaves = false;
    for (const auto& [a, b, c] : triangles) {
      const auto [low, high] = std::minmax({a.z(), b.z(), c.z()});
      if (v.z() < low || v.z() > high) continue;
      const Point n = (b - a).cross(c - a);
      const Real reach = radius * std::hypot(n.x(), n.y()), rest = n.dot(a) - n.z() * v.z();
      if (!(std::abs(rest) < reach)) continue;
      for (const Real side : {-1.0L, 1.0L}) {
        const Real t = std::atan2(n.y(), n.x()) + side * std::acos(rest / reach);
        const Point q(radius * std::cos(t), radius * std::sin(t), v.z());
        const auto is_left = [&](const Point& from, const Point& to) {
          return (to - from).cross(q - from).dot(n) >= 0;
        };
        if (!is_left(a, b) || !is_left(b, c) || !is_left(c, a)) continue;
        const Real ahead = t - own - turn * std::floor((t - own) / turn);
        // n q grows up to the middle of the two: at the first of them the circle leaves.
        if (ahead < first) first = ahead, leaves = side < 0;
        last = std::max(last, ahead);
      }
    }
    const auto nearest = static_cast<double>(std::min(first, turn - last));
    return std::isinf(first) ? std::numeric_limits<double>::infinity() : leaves ? -nearest : nearest;
  }
};

/// A crossing errs by rounding, 1e-14 of coordinates, over the sine at which the circle meets the face: 1e-9 is a slant of 1e-5, of
/// which one in 10^10 is less. Returns how many vertices are inside.
std::size_t compare(const tangential::TangentialResults& found, const std::vector<PointState>& states,
                    const CirclesAbout& circles, const Points& vertices) {
  EXPECT_EQ(found.state, states);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double expected = circles.gap(vertices[v]), gap = found.angular_gap[v].radians();
    EXPECT_TRUE(std::isinf(expected) ? std::isinf(gap) : std::abs(gap - expected) <= 1e-9)
        << v << ": " << gap << ", by all triangles " << expected;
  }
  return static_cast<std::size_t>(std::count(states.begin(), states.end(), PointState::inside));
}

/// 105,264 vertices, at poses that translate, about lines that pass anywhere.
TEST(ArcsAboutLines, AreThoseOfAllTriangles) {
  const TriMesh ring = test::torus(20, 7, 24, 12), ball = test::sphere({1, -2, 3}, 15, 5);
  const JointContact joint(ring, ball);
  std::mt19937 random(80);
  std::normal_distribution<double> normal;
  const auto any = [&](double mm) {
    return Vec3(mm * normal(random), mm * normal(random), mm * normal(random));
  };
  std::size_t mobile_inside = 0, fixed_inside = 0;
  for (int i = 0; i < 24; ++i) {
    Pose X_FM = Pose::Identity();
    X_FM.linear() = Eigen::AngleAxisd(normal(random), any(1).normalized()).toRotationMatrix();
    X_FM.translation() = any(8);
    const AxisLine axis{any(3), any(i % 2 == 0 ? 5 : 60)};
    const TangentialContact found = joint.tangential(X_FM, axis);
    const RadialContact radial = joint.radial(X_FM);
    const Eigen::Matrix<Real, 3, 3> R_MF = X_FM.linear().transpose().cast<Real>();
    const Point point = axis.point.cast<Real>(), direction = axis.direction.cast<Real>(),
                centre = X_FM.translation().cast<Real>();
    mobile_inside += compare(*found.mobile_in_fixed, radial.mobile_in_fixed->state,
                             CirclesAbout(ring, point, direction), posed(X_FM, joint.mobile().vertices()));
    fixed_inside += compare(*found.fixed_in_mobile, radial.fixed_in_mobile->state,
                            CirclesAbout(ball, R_MF * (point - centre), R_MF * direction),
                            posed(inverted(X_FM), joint.fixed().vertices()));
  }
  EXPECT_GT(mobile_inside, 5000u);
  EXPECT_GT(fixed_inside, 200u);
}

}  // namespace
}  // namespace condyle::contact
