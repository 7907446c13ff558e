#include "sample/self_intersection.hpp"

#include "core/thread_limit.hpp"
#include "support/brute_force.hpp"
#include "support/test.hpp"

namespace condyle::sample {
namespace {

using Pair = std::pair<Index, Index>;

TriMesh triangles(const std::vector<Vec3>& points, const std::vector<Triangle>& corners) {
  TriMesh mesh;
  for (const Vec3& p : points) mesh.vertices.push_back(p);
  mesh.triangles = corners;
  return mesh;
}

TEST(SelfIntersection, SoundMeshesHaveNone) {
  EXPECT_FALSE(first_self_intersection(TriMesh{}));
  EXPECT_FALSE(first_self_intersection(test::box(Vec3(0, 0, 0), Vec3(1, 2, 3))));
  EXPECT_FALSE(first_self_intersection(test::sphere(Vec3(1, 2, 3), 4, 4)));
  EXPECT_FALSE(first_self_intersection(test::torus(4, 1, 20, 12)));
  EXPECT_FALSE(first_self_intersection(test::socket(Vec3::Zero(), 3, 4, 3)));
}

TEST(SelfIntersection, OverlappingBodiesMeetAndSeparateOnesDoNot) {
  const TriMesh ball = test::sphere(Vec3::Zero(), 1, 3);
  EXPECT_TRUE(first_self_intersection(test::joined(ball, test::sphere(Vec3(1.5, 0, 0), 1, 3))));
  EXPECT_FALSE(first_self_intersection(test::joined(ball, test::sphere(Vec3(2.5, 0, 0), 1, 3))));
  EXPECT_FALSE(first_self_intersection(test::joined(ball, test::sphere(Vec3::Zero(), 0.5, 3))));
  // Poles at x = 1 coincide without being one vertex: touching counts.
  EXPECT_TRUE(first_self_intersection(test::joined(ball, test::sphere(Vec3(2, 0, 0), 1, 3))));
}

TEST(SelfIntersection, NeighboursMayShareTheirEdgeButNotMore) {
  const std::vector<Vec3> flat = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, -2, 0}, {1, 1, 0}, {1, 1, 1e-300}};
  EXPECT_FALSE(first_self_intersection(triangles(flat, {{0, 1, 2}, {1, 0, 3}})));  // side by side in a plane
  EXPECT_EQ(first_self_intersection(triangles(flat, {{0, 1, 2}, {1, 0, 4}})), Pair(0, 1));  // folded flat
  EXPECT_FALSE(first_self_intersection(triangles(flat, {{0, 1, 2}, {1, 0, 5}})));  // open by the least bit
}

TEST(SelfIntersection, TrianglesWithOneCommonCornerMayNotMeetElsewhere) {
  const std::vector<Vec3> points = {{0, 0, 0},    {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {-1, -1, 1},
                                    {-1, -1, -1}, {2, 1, 0}, {1, 2, 0}, {-3, 1, 0}, {8, 0, 0}, {5, -3, 0}};
  EXPECT_EQ(first_self_intersection(triangles(points, {{0, 1, 2}, {0, 3, 4}})), Pair(0, 1));  // pierces
  EXPECT_FALSE(first_self_intersection(triangles(points, {{0, 1, 2}, {0, 5, 6}})));  // on the other side
  EXPECT_EQ(first_self_intersection(triangles(points, {{0, 1, 2}, {0, 7, 8}})),
            Pair(0, 1));                                                             // coplanar, inside
  EXPECT_FALSE(first_self_intersection(triangles(points, {{0, 1, 2}, {0, 9, 6}})));  // coplanar edge outside
  EXPECT_EQ(first_self_intersection(triangles(points, {{0, 1, 2}, {0, 10, 11}})),
            Pair(0, 1));  // along one edge
}

TEST(SelfIntersection, TheSameTriangleTwiceMeets) {
  EXPECT_EQ(first_self_intersection(triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 1, 0}})),
            Pair(0, 1));
}

TEST(SelfIntersection, RandomSoupsAgreeWithExactBruteForce) {
  std::mt19937 random(11);
  // A coarse lattice: many coplanar, collinear and touching triangles.
  std::uniform_int_distribution<int> lattice(0, 5);
  int meeting = 0, apart = 0;
  for (int round = 0; round < 400; ++round) {
    TriMesh soup;
    const int wanted = 2 + round % 3;
    while (static_cast<int>(soup.triangles.size()) < wanted) {
      const auto point = [&] { return Vec3(lattice(random), lattice(random), lattice(random)); };
      const Vec3 p = point(), q = point(), r = point();
      if ((q - p).cross(r - p).isZero(0)) continue;
      const auto first = static_cast<Index>(soup.vertices.size());
      for (const Vec3& v : {p, q, r}) soup.vertices.push_back(v);
      soup.triangles.push_back({first, first + 1, first + 2});
    }
    std::optional<Pair> expected;
    for (const auto& [i, j] : test::intersecting_pairs(soup, soup)) {
      if (i < j) expected = std::min(expected.value_or(Pair(i, j)), Pair(i, j));
    }
    EXPECT_EQ(first_self_intersection(soup), expected);
    ++(expected ? meeting : apart);
  }
  EXPECT_GT(meeting, 50);
  EXPECT_GT(apart, 50);
}

TEST(SelfIntersection, OneThreadFindsTheSamePairAsMany) {
  const TriMesh mesh =
      test::joined(test::sphere(Vec3::Zero(), 1, 4), test::sphere(Vec3(0.3, 0.4, 0.5), 1, 4));
  const auto many = first_self_intersection(mesh);
  const core::ThreadLimit one_thread(1);
  EXPECT_EQ(first_self_intersection(mesh), many);
  EXPECT_TRUE(many);
}

}  // namespace
}  // namespace condyle::sample
