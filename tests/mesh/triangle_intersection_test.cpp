#include "mesh/triangle_intersection.hpp"

#include "support/brute_force.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

void expect_as_brute_force(const mesh::TriangleCorners& a, const mesh::TriangleCorners& b, int& meeting,
                           int& apart) {
  const bool truth = test::triangles_intersect(a, b);
  (truth ? meeting : apart)++;
  EXPECT_EQ(mesh::triangles_intersect(a, b), truth);
  EXPECT_EQ(mesh::triangles_intersect(b, a), truth);
  EXPECT_EQ(mesh::triangles_intersect({a[1], a[2], a[0]}, {b[2], b[1], b[0]}), truth);
}

bool has_area(const mesh::TriangleCorners& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).norm() > 0;
}

TEST(TriangleIntersection, OnASmallGridWhereMostPairsAreDegenerateItIsThatOfRationalArithmetic) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> grid(0, 2);
  const auto triangle = [&] {
    mesh::TriangleCorners t;
    do {
      for (auto& p : t) p = Vec3(grid(random), grid(random), grid(random));
    } while (!has_area(t));
    return t;
  };
  int meeting = 0, apart = 0;
  for (int i = 0; i < 6000; ++i) expect_as_brute_force(triangle(), triangle(), meeting, apart);
  EXPECT_GT(meeting, 500);
  EXPECT_GT(apart, 500);
}

TEST(TriangleIntersection, InOnePlaneItIsThatOfRationalArithmetic) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> grid(0, 4);
  // x + y + z = 12, off the coordinate planes; and each coordinate plane itself.
  for (int plane = 0; plane < 4; ++plane) {
    const auto triangle = [&] {
      mesh::TriangleCorners t;
      do {
        for (auto& p : t) {
          const double u = grid(random), v = grid(random);
          p = plane == 3 ? Vec3(u, v, 12 - u - v) : Vec3::Zero();
          if (plane < 3) p[(plane + 1) % 3] = u, p[(plane + 2) % 3] = v, p[plane] = 7;
        }
      } while (!has_area(t));
      return t;
    };
    int meeting = 0, apart = 0;
    for (int i = 0; i < 1000; ++i) expect_as_brute_force(triangle(), triangle(), meeting, apart);
    EXPECT_GT(meeting, 100);
    EXPECT_GT(apart, 100);
  }
}

TEST(TriangleIntersection, WithinOneRoundingOfTouchingItIsThatOfRationalArithmetic) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int meeting = 0, apart = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
    const mesh::TriangleCorners a = {point(), point(), point()};
    // One corner of b put into a's plane but for rounding, the others on one side of it.
    const Vec3 normal = (a[1] - a[0]).cross(a[2] - a[0]);
    const Vec3 tip = 0.5 * a[0] + 0.3 * a[1] + 0.2 * a[2];
    expect_as_brute_force(a, {tip, tip + normal + 0.1 * point(), tip + normal + 0.1 * point()}, meeting,
                          apart);
  }
  EXPECT_GT(meeting, 100);
  EXPECT_GT(apart, 100);
}

TEST(TriangleIntersection, ATriangleOfZeroAreaMeetsNothing) {
  const mesh::TriangleCorners t = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)};
  EXPECT_FALSE(mesh::triangles_intersect(t, {Vec3(0.5, 0.5, -1), Vec3(0.5, 0.5, 0), Vec3(0.5, 0.5, 1)}));
  EXPECT_FALSE(mesh::triangles_intersect({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}, t));
}

TEST(TriangleIntersection, ACoplanarPointIsFoundInTheClosedTriangle) {
  const mesh::TriangleCorners t = {Vec3(0, 0, 1), Vec3(4, 0, 1), Vec3(0, 4, 1)};
  EXPECT_TRUE(mesh::contains_coplanar(t, {1, 1, 1}));
  EXPECT_TRUE(mesh::contains_coplanar(t, {2, 2, 1}));
  EXPECT_TRUE(mesh::contains_coplanar(t, {4, 0, 1}));
  EXPECT_FALSE(mesh::contains_coplanar(t, {2, 2.0000000000000004, 1}));
  EXPECT_FALSE(mesh::contains_coplanar({Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)}, {1, 1, 1}));
}

}  // namespace
}  // namespace condyle
