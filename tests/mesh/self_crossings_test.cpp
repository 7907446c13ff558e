#include "mesh/self_crossings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "condyle/inspect.hpp"
#include "support/brute_force.hpp"
#include "support/shared_data.hpp"
#include "support/test_meshes.hpp"

namespace condyle::mesh {
namespace {

using Pair = std::array<Index, 2>;

TEST(SelfCrossings, SoundSurfacesHaveNone) {
  EXPECT_EQ(self_crossings_of(TriMesh{}).pairs, 0u);
  for (const TriMesh& mesh : {test::box({0, 0, 0}, {1, 2, 3}), test::sphere({1, 2, 3}, 4, 4),
                              test::socket(Vec3::Zero(), 3, 4, 3), test::torus(4, 1, 20, 12)}) {
    const SelfCrossings found = self_crossings_of(mesh);
    EXPECT_EQ(found.pairs, 0u);
    EXPECT_FALSE(found.first);
    EXPECT_EQ(std::count(found.crosses.begin(), found.crosses.end(), 1), 0);
  }
}

TEST(SelfCrossings, TrianglesWithVerticesOfTheirOwnAtOnePlaceAreNeighbours) {
  TriMesh soup;
  const TriMesh ball = test::sphere({0, 0, 0}, 4, 2);
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(ball.corner(t, k));
    const auto v = static_cast<Index>(3 * t);
    soup.triangles.push_back({v, v + 1, v + 2});
  }
  EXPECT_EQ(self_crossings_of(soup).pairs, 0u);
}

/// Every pair, by exact brute force.
SelfCrossings by_brute_force(const TriMesh& mesh) {
  SelfCrossings found;
  found.crosses.resize(mesh.triangles.size());
  const auto place = first_of_same_coordinates(mesh.vertices);
  for (const auto& pair : test::intersecting_pairs(mesh, mesh)) {
    const auto s = pair.first, t = pair.second;
    const auto shared = [&](Index v) {
      return std::any_of(mesh.triangles[s].begin(), mesh.triangles[s].end(),
                         [&](Index w) { return place[v] == place[w]; });
    };
    if (s >= t || std::any_of(mesh.triangles[t].begin(), mesh.triangles[t].end(), shared)) continue;
    if (found.pairs++ == 0) found.first = Pair{s, t};
    found.crosses[s] = found.crosses[t] = 1;
  }
  return found;
}

TEST(SelfCrossings, AreThoseOfExactBruteForce) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> lattice(0, 7);
  std::vector<TriMesh> meshes{
      test::joined(test::sphere({0, 0, 0}, 1, 3), test::sphere({0.7, 0.5, 0.3}, 1, 3))};
  for (int round = 0; round < 20; ++round) {
    TriMesh soup;
    for (int v = 0; v < 40; ++v)
      soup.vertices.push_back({1.0 * lattice(random), 1.0 * lattice(random), 1.0 * lattice(random)});
    std::uniform_int_distribution<Index> vertex(0, 39);
    while (soup.triangles.size() < 40) {
      const Triangle t{vertex(random), vertex(random), vertex(random)};
      const Vec3 a = soup.vertices[t[0]], b = soup.vertices[t[1]], c = soup.vertices[t[2]];
      if (!(b - a).cross(c - a).isZero(0)) soup.triangles.push_back(t);
    }
    meshes.push_back(std::move(soup));
  }
  for (const TriMesh& mesh : meshes) {
    const SelfCrossings expected = by_brute_force(mesh), found = self_crossings_of(mesh);
    EXPECT_GT(expected.pairs, 0u);
    EXPECT_EQ(found.pairs, expected.pairs);
    EXPECT_EQ(found.first, expected.first);
    EXPECT_EQ(found.crosses, expected.crosses);
  }
}

TEST(SelfCrossings, OfBonesWithEngravedLettersAreReported) {
  const auto data = test::shared_data();
  if (!data) GTEST_SKIP() << "no shared data: set CONDYLE_DATA";
  const TriMesh femur = test::read_ply(*data / "hip_libhip_m1_left/femur.ply");
  // 29 with the pairs that share a vertex, by CGAL (README of the data).
  EXPECT_EQ(inspect(femur).self_crossings.count, 15u);
}

}  // namespace
}  // namespace condyle::mesh
