#include "radial/exact/triangle_plane.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include "support/test.hpp"

namespace condyle::radial {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Exact = std::array<Rational, 3>;

Exact exact(const Vec3& v) {
  return {Rational(v.x()), Rational(v.y()), Rational(v.z())};
}

Exact difference(const Exact& a, const Exact& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Exact cross(const Exact& a, const Exact& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Rational dot(const Exact& a, const Exact& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// (D - v . N) / (v . N): the way from v to the plane along its ray, in units of |v|.
double exact_relative_gap(const Vec3& v, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Exact n = cross(difference(exact(b), exact(a)), difference(exact(c), exact(a)));
  return static_cast<double>(dot(exact(a), n) / dot(exact(v), n) - 1);
}

struct RandomTriangle {
  Vec3 a, b, c;

  /// About a point 20 to 60 mm out; edges from a micrometre to a centimetre, any shape and any slant.
  explicit RandomTriangle(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto direction = [&] {
      return Vec3(uniform(random), uniform(random), uniform(random)).normalized();
    };
    a = direction() * (40 + 20 * uniform(random));
    const double size = std::pow(10, -1 + 2 * uniform(random)),
                 slenderness = std::pow(10, -1 + uniform(random));
    const Vec3 along = direction(), across = along.cross(direction()).normalized();
    b = a + size * along;
    c = a + size * (0.5 + 0.5 * uniform(random)) * along + size * slenderness * across;
  }

  /// A point whose ray crosses it, at this fraction of the way there from the centre.
  Vec3 point(std::mt19937& random, double fraction) const {
    std::uniform_real_distribution<double> uniform(0, 1);
    double p = uniform(random), q = uniform(random);
    if (p + q > 1) p = 1 - p, q = 1 - q;
    return fraction * (a + p * (b - a) + q * (c - a));
  }
};

TEST(TrianglePlane, GapsThatItTellsAreWithin1e12OfTheExactOnes) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.3, 4);
  int known = 0, oblique = 0, slender = 0;
  for (int i = 0; i < 20000; ++i) {
    const RandomTriangle t(random);
    const Vec3 v = t.point(random, i % 2 == 0 ? uniform(random) : 1 + 1e-7 * uniform(random));
    const Vec3 normal = radial::scaled_normal(t.a, t.b, t.c);
    const double gap = radial::gap_to_plane(v, normal);
    if (std::isnan(gap)) continue;
    ++known;
    oblique += normal.normalized().dot(v.normalized()) < 0.2 && normal.dot(v) > 0;
    slender += (t.b - t.a).norm() * (t.c - t.a).norm() > 5 * (t.b - t.a).cross(t.c - t.a).norm();
    ASSERT_NEAR(gap / v.norm(), exact_relative_gap(v, t.a, t.b, t.c), 1e-12);
  }
  // The conditions let enough through near their limits for that to mean something.
  EXPECT_GT(known, 6000);
  EXPECT_GT(oblique, 200);
  EXPECT_GT(slender, 200);
}

TEST(TrianglePlane, AWellShapedTriangleThatFacesTheCentreIsAlwaysTold) {
  for (const double size : {1e-3, 1.0, 20.0}) {
    const Vec3 a(30, 0, 0), b(30, size, 0), c(30, 0, size);
    for (const double radius : {25.0, 30.0, 55.0}) {
      const Vec3 v = radius / 30 * (a + b + c) / 3;
      EXPECT_NEAR(radial::gap_to_plane(v, radial::scaled_normal(a, b, c)), (30 / radius - 1) * v.norm(),
                  1e-12 * v.norm());
    }
  }
}

TEST(TrianglePlane, ASliverAPlaneThroughTheCentreAndAFarPlaneAreLeftToExactArithmetic) {
  const Vec3 a(30, 0, 0);
  EXPECT_TRUE(radial::scaled_normal(a, {30, 1, 0}, {30, 2, 1e-3}).hasNaN());
  EXPECT_TRUE(radial::scaled_normal(a, {31, 0, 0}, {30, 1, 0}).hasNaN());
  EXPECT_TRUE(radial::scaled_normal(a, a, {30, 1, 0}).hasNaN());
  const Vec3 facing = radial::scaled_normal(a, {30, 1, 0}, {30, 0, 1});
  EXPECT_TRUE(std::isnan(radial::gap_to_plane({14.9, 0, 0}, facing)));
  EXPECT_FALSE(std::isnan(radial::gap_to_plane({15.1, 0, 0}, facing)));
}

TEST(TrianglePlane, LengthsFarBeyondMillimetresAreLeftToExactArithmetic) {
  for (const double scale : {1e-60, 1e60, 1e150}) {
    const Vec3 a(30 * scale, 0, 0), b(30 * scale, scale, 0), c(30 * scale, 0, scale);
    EXPECT_TRUE(radial::scaled_normal(a, b, c).hasNaN()) << scale;
  }
}

}  // namespace
}  // namespace condyle::radial
