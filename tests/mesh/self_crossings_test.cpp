#include "mesh/self_crossings.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
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

/// A cone of so many sides on a cone, both with their vertex on an axis of any direction.
TriMesh two_cones(Index sides, const Eigen::Quaterniond& turn) {
  TriMesh mesh;
  for (Index k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    mesh.vertices.push_back(turn * Vec3(30 * std::cos(angle), 30 * std::sin(angle), 0));
    mesh.triangles.push_back({k, (k + 1) % sides, sides});
    mesh.triangles.push_back({(k + 1) % sides, k, sides + 1});
  }
  mesh.vertices.push_back(turn * Vec3(0, 0, 40));
  mesh.vertices.push_back(turn * Vec3(0, 0, -20));
  return mesh;
}

TEST(SelfCrossings, OfManyTrianglesRoundAVertexAreThoseOfExactBruteForce) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 2; ++round) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(number(random), number(random), number(random), number(random)).normalized();
    TriMesh cones = two_cones(100, turn);
    EXPECT_EQ(self_crossings_of(cones).pairs, 0u);
    // The lower vertex pushed through the upper cone, and a triangle through all of it.
    cones.vertices.set(101, turn * Vec3(15, 5, 30));
    for (const Vec3& p : {Vec3(-50, -40, 12), Vec3(60, -30, 12.5), Vec3(0, 70, 13)})
      cones.vertices.push_back(turn * p);
    cones.triangles.push_back({102, 103, 104});
    const SelfCrossings expected = by_brute_force(cones), found = self_crossings_of(cones);
    EXPECT_GT(expected.pairs, 200u);
    EXPECT_EQ(found.pairs, expected.pairs);
    EXPECT_EQ(found.first, expected.first);
    EXPECT_EQ(found.crosses, expected.crosses);
  }
}

/// A globe of so many meridians, `height` times as tall as it is wide: all triangles are slender, and those of the first and of the last
/// row run to a pole.
TriMesh globe(Index meridians, Index rows, double height, const Eigen::Quaterniond& turn) {
  TriMesh mesh;
  for (Index r = 1; r < rows; ++r)
    for (Index k = 0; k < meridians; ++k) {
      const double down = std::numbers::pi * r / rows, along = 2 * std::numbers::pi * k / meridians;
      mesh.vertices.push_back(turn * Vec3(24 * std::sin(down) * std::cos(along),
                                          24 * std::sin(down) * std::sin(along),
                                          24 * height * std::cos(down)));
    }
  const Index top = (rows - 1) * meridians, bottom = top + 1;
  mesh.vertices.push_back(turn * Vec3(0, 0, 24 * height));
  mesh.vertices.push_back(turn * Vec3(0, 0, -24 * height));
  for (Index k = 0; k < meridians; ++k) {
    const Index next = (k + 1) % meridians, last = top - meridians;
    mesh.triangles.push_back({k, next, top});
    for (Index first = 0; first < last; first += meridians) {
      const Index below = first + meridians;
      mesh.triangles.push_back({first + k, below + k, first + next});
      mesh.triangles.push_back({first + next, below + k, below + next});
    }
    mesh.triangles.push_back({last + next, last + k, bottom});
  }
  return mesh;
}

TEST(SelfCrossings, OfSlenderTrianglesAreThoseOfExactBruteForce) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 2; ++round) {
    const auto turn = [&] {
      return Eigen::Quaterniond(number(random), number(random), number(random), number(random)).normalized();
    };
    const TriMesh needle = globe(24, 4, 20, turn()), other = globe(20, 3, 30, turn());
    EXPECT_EQ(self_crossings_of(needle).pairs, 0u);
    const TriMesh both = test::joined(needle, other);
    const SelfCrossings expected = by_brute_force(both), found = self_crossings_of(both);
    EXPECT_GT(expected.pairs, 20u);
    EXPECT_EQ(found.pairs, expected.pairs);
    EXPECT_EQ(found.first, expected.first);
    EXPECT_EQ(found.crosses, expected.crosses);
  }
}

TEST(SelfCrossings, TakeStepsInProportionToSlenderTrianglesAndToThoseRoundAVertex) {
  // Four times the triangles: n log n it is about five times the steps, quadratic sixteen.
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  const auto steps_of = [](const TriMesh& mesh) {
    const SelfCrossings found = self_crossings_of(mesh);
    EXPECT_EQ(found.pairs, 0u);
    return found.steps;
  };
  for (const Index count : {1000u, 4000u}) {
    EXPECT_LE(steps_of(two_cones(4 * count, turn)), 6 * steps_of(two_cones(count, turn)));
    EXPECT_LE(steps_of(globe(4 * count, 8, 1, turn)), 6 * steps_of(globe(count, 8, 1, turn)));
  }
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
