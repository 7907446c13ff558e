#include "mesh/self_crossings.hpp"

#include "condyle/inspect.hpp"
#include "support/brute_force.hpp"
#include "support/test.hpp"

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

/// They are more than so many.
void expect_as_by_brute_force(const TriMesh& mesh, std::size_t more_than) {
  const SelfCrossings expected = by_brute_force(mesh), found = self_crossings_of(mesh);
  EXPECT_GT(expected.pairs, more_than);
  EXPECT_EQ(found.pairs, expected.pairs);
  EXPECT_EQ(found.first, expected.first);
  EXPECT_EQ(found.crosses, expected.crosses);
}

/// A cone of so many sides on a cone, both with their vertex on an axis of any direction.
TriMesh two_cones(Index sides, const Eigen::Matrix3d& turn) {
  return test::turned(test::turned_solid({{0, 40}, {30, 0}, {0, -20}}, sides), turn);
}

Eigen::Matrix3d any_turn(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  return Eigen::Quaterniond(number(random), number(random), number(random), number(random))
      .normalized()
      .toRotationMatrix();
}

TEST(SelfCrossings, OfManyTrianglesRoundAVertexAreThoseOfExactBruteForce) {
  std::mt19937 random(11);
  for (int round = 0; round < 2; ++round) {
    const Eigen::Matrix3d turn = any_turn(random);
    TriMesh cones = two_cones(100, turn);
    EXPECT_EQ(self_crossings_of(cones).pairs, 0u);
    // The lower vertex pushed through the upper cone, and a triangle through all of it.
    cones.vertices.set(101, turn * Vec3(15, 5, 30));
    for (const Vec3& p : {Vec3(-50, -40, 12), Vec3(60, -30, 12.5), Vec3(0, 70, 13)})
      cones.vertices.push_back(turn * p);
    cones.triangles.push_back({102, 103, 104});
    expect_as_by_brute_force(cones, 200);
  }
}

/// A globe of so many meridians, `height` times as tall as it is wide: all triangles are slender, and those of the first and of the last
/// row run to a pole.
TriMesh globe(Index meridians, Index rows, double height, const Eigen::Matrix3d& turn) {
  std::vector<std::array<double, 2>> profile;
  for (Index r = 0; r <= rows; ++r) {
    const double down = std::numbers::pi * r / rows;
    profile.push_back({24 * std::sin(down), 24 * height * std::cos(down)});
  }
  return test::turned(test::turned_solid(profile, meridians), turn);
}

TEST(SelfCrossings, OfSlenderTrianglesAreThoseOfExactBruteForce) {
  std::mt19937 random(12);
  for (int round = 0; round < 2; ++round) {
    const TriMesh needle = globe(24, 4, 20, any_turn(random)), other = globe(20, 3, 30, any_turn(random));
    EXPECT_EQ(self_crossings_of(needle).pairs, 0u);
    expect_as_by_brute_force(test::joined(needle, other), 20);
  }
}

TEST(SelfCrossings, TakeStepsInProportionToSlenderTrianglesAndToThoseRoundAVertex) {
  // Four times the triangles: n log n it is about five times the steps, quadratic sixteen.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
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
  for (const TriMesh& mesh : meshes) expect_as_by_brute_force(mesh, 0);
}

TEST(SelfCrossings, OfBonesWithEngravedLettersAreReported) {
  FOUND_OR_SKIP(data, test::shared_data());
  const TriMesh femur = test::read_ply(*data / "hip_libhip_m1_left/femur.ply");
  // 29 with the pairs that share a vertex, by CGAL (README of the data).
  EXPECT_EQ(inspect(femur).self_crossings.count, 15u);
}

}  // namespace
}  // namespace condyle::mesh
