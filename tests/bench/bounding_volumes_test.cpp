#include "methods/ball.hpp"
#include "methods/spherical_shell.hpp"
#include "methods/volume_tree.hpp"
#include "support/test.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::TriMesh;
using condyle::Vec3;
using condyle::contact::TrianglePair;

constexpr double radius = 25;

std::vector<Vec3> corners_of(const TriMesh& mesh) {
  std::vector<Vec3> corners;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) corners.push_back(mesh.corner(t, k));
  return corners;
}

/// A sixteenth of a sphere: one triangle of the octahedron's faces, split thrice, quartered.
std::vector<Vec3> patch(const Vec3& centre, double r) {
  std::vector<Vec3> corners = corners_of(condyle::test::sphere(centre, r, 3));
  corners.resize(corners.size() / 16);
  return corners;
}

/// Some turns and shifts of up to `shift` mm, the same every time.
std::vector<Pose> some_poses(int count, double shift) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> in(-1, 1);
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    Pose X = Pose::Identity();
    X.linear() = Eigen::Quaterniond(in(random), in(random), in(random), in(random)).normalized().matrix();
    X.translation() = shift * Vec3(in(random), in(random), in(random));
    poses.push_back(X);
  }
  return poses;
}

bool holds(const Ball& ball, const Vec3& p) {
  return (p - ball.centre).norm() <= ball.radius;
}

bool holds(const SphericalShell& shell, const Vec3& p) {
  const Vec3 from_centre = p - shell.centre;
  const double distance = from_centre.norm();
  return shell.inner <= distance && distance <= shell.outer && holds(shell.ball, p) &&
         from_centre.dot(shell.cap.axis) >= shell.cap.cos * distance;
}

template <class Volume>
void expect_to_hold_its_triangles() {
  const std::vector<std::vector<Vec3>> sets = {patch({3, -2, 1}, radius),
                                               {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}},
                                               corners_of(condyle::test::box({1, 2, 3}, {5, 5, 5}))};
  for (const auto& corners : sets) {
    const Volume volume = Volume::around(corners);
    for (const Pose& X : some_poses(50, 500)) {
      const Volume moved = volume.posed(X);
      for (std::size_t i = 0; i < corners.size(); i += 3) {
        const Vec3 middle = (corners[i] + corners[i + 1] + corners[i + 2]) / 3;
        for (const Vec3& p : {corners[i], corners[i + 1], corners[i + 2], middle})
          ASSERT_TRUE(holds(moved, condyle::posed(X, p))) << p.transpose();
      }
    }
  }
}

TEST(BoundingVolumes, ABallHoldsItsTrianglesWhereverItIsMoved) {
  expect_to_hold_its_triangles<Ball>();
}

TEST(BoundingVolumes, ASphericalShellHoldsItsTrianglesWhereverItIsMoved) {
  expect_to_hold_its_triangles<SphericalShell>();
}

TEST(BoundingVolumes, ABallIsNearlyTheSmallestOne) {
  const Ball ball = Ball::around(corners_of(condyle::test::sphere({1, 2, 3}, radius, 2)));
  EXPECT_GE(ball.radius, radius);
  EXPECT_LE(ball.radius, 1.05 * radius);
}

TEST(BoundingVolumes, TheShellOfASpheresTrianglesIsAsThinAsTheySag) {
  const Vec3 centre(3, -2, 1);
  const std::vector<Vec3> corners = patch(centre, radius);
  const SphericalShell shell = SphericalShell::around(corners);
  EXPECT_LT((shell.centre - centre).norm(), 1e-9);
  EXPECT_NEAR(shell.outer, radius, 1e-9);
  double longest_edge = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      longest_edge = std::max(longest_edge, (corners[i + k] - corners[i + (k + 1) % 3]).norm());
  // No point of a triangle is farther from its corners than its longest edge over the root of three.
  const double farthest = longest_edge / std::sqrt(3.0);
  EXPECT_GE(shell.inner, std::sqrt(radius * radius - farthest * farthest) - 1e-9);
}

TEST(BoundingVolumes, ShellsTellApartTwoSkinsThatBallsCannot) {
  const std::vector<Vec3> head = patch({0, 0, 0}, radius), socket = patch({0, 0, 0}, radius + 1);
  EXPECT_FALSE(SphericalShell::around(head).meets(SphericalShell::around(socket)));
  EXPECT_FALSE(SphericalShell::around(socket).meets(SphericalShell::around(head)));
  EXPECT_TRUE(Ball::around(head).meets(Ball::around(socket)));
}

TEST(BoundingVolumes, TheShellOfAFlatTriangleIsThin) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
  const SphericalShell shell = SphericalShell::around(corners);
  // Its circle has radius 2.5 about the middle of the longest side; the centre is 100 times that away.
  EXPECT_NEAR(shell.outer - shell.inner, 2.5 / 200, 2.5 / 2000);
}

/// Every triangle of one against every triangle of the other.
std::vector<TrianglePair> brute_pairs(const TriMesh& fixed, const TriMesh& mobile) {
  const std::vector<Vec3> p = corners_of(fixed), q = corners_of(mobile);
  std::vector<TrianglePair> pairs;
  for (Index f = 0; f < fixed.triangles.size(); ++f)
    for (Index m = 0; m < mobile.triangles.size(); ++m)
      if (condyle::mesh::triangles_intersect({p[3 * f], p[3 * f + 1], p[3 * f + 2]},
                                             {q[3 * m], q[3 * m + 1], q[3 * m + 2]}))
        pairs.push_back({f, m});
  return pairs;
}

std::vector<TrianglePair> pairs_of(Method& method, const Pose& X_FM) {
  std::vector<TrianglePair> pairs;
  method.find_pairs(X_FM, pairs);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Against all pairs, one by one, at poses where some touch and some do not.
template <class Volume>
void expect_all_pairs(const TriMesh& fixed, const TriMesh& mobile, double shift) {
  TwoTrees<Volume> trees({fixed, mobile});
  int touching = 0, free = 0;
  for (const Pose& X_FM : some_poses(24, shift)) {
    const std::vector<TrianglePair> expected = brute_pairs(fixed, condyle::posed(X_FM, mobile));
    ASSERT_EQ(pairs_of(trees, X_FM), expected);
    ASSERT_EQ(trees.touch(X_FM), !expected.empty());
    ++(expected.empty() ? free : touching);
  }
  EXPECT_GT(touching, 0);
  EXPECT_GT(free, 0);
}

template <class Volume>
void expect_all_pairs_of_bodies() {
  using namespace condyle::test;
  expect_all_pairs<Volume>(socket({0, 0, 0}, radius + 2, radius + 6, 2), sphere({0, 0, 0}, radius, 2), 2);
  expect_all_pairs<Volume>(box({0, 0, 0}, {9, 8, 7}), box({-3, -3, -3}, {2, 2, 2}), 9);
  expect_all_pairs<Volume>(torus(20, 5, 24, 12), torus(20, 3, 20, 10), 30);
}

TEST(BoundingVolumes, TreesOfBallsFindExactlyTheTrianglesThatMeet) {
  expect_all_pairs_of_bodies<Ball>();
}

TEST(BoundingVolumes, TreesOfShellsFindExactlyTheTrianglesThatMeet) {
  expect_all_pairs_of_bodies<SphericalShell>();
}

TEST(BoundingVolumes, BoxesThatShareAFaceMeetThere) {
  const TriMesh fixed = condyle::test::box({0, 0, 0}, {4, 4, 4}),
                mobile = condyle::test::box({4, 1, 1}, {6, 3, 3});
  const std::vector<TrianglePair> expected = brute_pairs(fixed, mobile);
  ASSERT_FALSE(expected.empty());
  TwoTrees<Ball> balls({fixed, mobile});
  TwoTrees<SphericalShell> shells({fixed, mobile});
  EXPECT_EQ(pairs_of(balls, Pose::Identity()), expected);
  EXPECT_EQ(pairs_of(shells, Pose::Identity()), expected);
}

template <class Volume>
void expect_to_follow_a_deformed_body() {
  const TriMesh fixed = condyle::test::torus(20, 5, 24, 12), mobile = condyle::test::sphere({20, 0, 0}, 6, 2);
  TriMesh deformed = fixed;
  for (double& x : deformed.vertices.x) x = 0.8 * x + 5;
  TwoTrees<Volume> trees({fixed, mobile});
  const auto before = trees.for_another_thread();
  trees.deform(deformed.vertices);
  const std::vector<TrianglePair> expected = brute_pairs(deformed, mobile);
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(pairs_of(trees, Pose::Identity()), expected);
  EXPECT_EQ(pairs_of(*before, Pose::Identity()), brute_pairs(fixed, mobile));
}

TEST(BoundingVolumes, TreesFollowADeformedBodyAndLeaveTheirCopiesAlone) {
  expect_to_follow_a_deformed_body<Ball>();
  expect_to_follow_a_deformed_body<SphericalShell>();
}

}  // namespace
}  // namespace bench
