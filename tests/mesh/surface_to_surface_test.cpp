#include "mesh/surface_to_surface.hpp"

#include "mesh/triangle_intersection.hpp"
#include "support/random_triangles.hpp"
#include "support/test.hpp"

/// The smallest distance of two surfaces, in closed form and against all pairs of triangles.

namespace condyle::mesh {
namespace {

using test::box, test::sphere;

ClosestPoints closest(const TriMesh& a, const TriMesh& b, const Pose& X = Pose::Identity()) {
  return closest_points(TriangleTree(a), TriangleTree(b), X).value();
}

TEST(ClosestPoints, OfTwoBoxesIsThatOfTheirNearestFacesEdgesOrCorners) {
  const TriMesh unit = box({0, 0, 0}, {1, 1, 1});
  EXPECT_NEAR(closest(unit, box({3, 0, 0}, {4, 1, 1})).distance_mm, 2, 1e-12);
  EXPECT_NEAR(closest(unit, box({4, 5, 0}, {6, 6, 1})).distance_mm, 5, 1e-12);
  EXPECT_NEAR(closest(unit, box({2, 3, 3}, {6, 6, 6})).distance_mm, 3, 1e-12);
  EXPECT_NEAR(closest(box({0, 0, 0}, {10, 10, 10}), box({4, 5, 5}, {6, 6, 6})).distance_mm, 4, 1e-12)
      << "one in the other";
}

TEST(ClosestPoints, IsNoughtWhereSurfacesMeetAlsoFarFromAllVertices) {
  // A long bar through the middle of a large face.
  const ClosestPoints met = closest(box({-50, -50, 0}, {50, 50, 1}), box({-1, -1, -80}, {1, 1, 80}));
  EXPECT_EQ(met.distance_mm, 0);
  EXPECT_EQ(closest(box({0, 0, 0}, {1, 1, 1}), box({1, 0.25, 0.25}, {2, 0.75, 0.75})).distance_mm, 0)
      << "touching";
}

TEST(ClosestPoints, OfABallInASocketIsTheGapLessTheSag) {
  const TriMesh socket = test::socket({0, 0, 0}, 23, 28, 4);
  const TriMesh ball = sphere({0, 0, 0}, 20, 4);
  Pose X(Eigen::Translation3d(0.5, 1, -0.25));
  // Edges of (pi/2)/16 of both radii sag by e^2 / (8 r), 0.024 and 0.028 mm; and the nearest corners of both may be off the
  // line of the centres by an edge, 2 mm: another e^2 / 2 (1/20 - 1/23) = 0.013.
  const double gap = 3 - X.translation().norm(), sag = 0.065;
  EXPECT_NEAR(closest(socket, ball, X).distance_mm, gap, sag);
}

TEST(ClosestPoints, IsTheLeastOverAllPairsOfTriangles) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  std::size_t apart = 0;
  for (int round = 0; round < 40; ++round) {
    const TriMesh a = sphere({0, 0, 0}, 1, 1), b = sphere({0, 0, 0}, 0.7, 1);
    Pose X = Pose::Identity();
    X.linear() =
        Eigen::AngleAxisd(3 * anywhere(random), Vec3(anywhere(random), anywhere(random), 0.1).normalized())
            .toRotationMatrix();
    X.translation() = 2 * Vec3(anywhere(random), anywhere(random), anywhere(random));
    const TriMesh placed = posed(X, b);
    double least = HUGE_VAL;
    const auto corners = [](const TriMesh& mesh, std::size_t t) {
      return TriangleCorners{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
    };
    for (std::size_t t = 0; t < a.triangles.size(); ++t)
      for (std::size_t s = 0; s < b.triangles.size(); ++s) {
        const auto one = corners(a, t), other = corners(placed, s);
        least = std::min(least, triangles_intersect(one, other)
                                    ? 0
                                    : std::sqrt(between_triangles(one, other).squared_distance));
      }
    const ClosestPoints found = closest(a, b, X);
    EXPECT_NEAR(found.distance_mm, least, 1e-12);
    if (least == 0) continue;
    ++apart;
    EXPECT_NEAR((found.a_point - found.b_point).norm(), least, 1e-12);
    EXPECT_NEAR(std::sqrt(between_triangles(corners(a, found.a_triangle), corners(placed, found.b_triangle))
                              .squared_distance),
                least, 1e-12);
  }
  EXPECT_GT(apart, 10u);
  EXPECT_LT(apart, 40u);
}

TEST(ClosestPoints, AreTheSameWhereAnUpperBoundIsKnown) {
  const TriangleTree socket(test::socket({0, 0, 0}, 23, 28, 3)), ball(sphere({0, 0, 0}, 20, 3));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  for (int round = 0; round < 50; ++round) {
    const double angle = 3 * anywhere(random), x = anywhere(random), y = anywhere(random);
    Pose X = Pose::Identity();
    X.linear() = Eigen::AngleAxisd(angle, Vec3(x, y, 0.1).normalized()).toRotationMatrix();
    X.translation() = Vec3(y, x, 0.3);
    const ClosestPoints all = *closest_points(socket, ball, X);
    ASSERT_GT(all.distance_mm, 0);
    for (const double more : {1e-9, 0.01, 1.0}) {
      const auto bounded = closest_points(socket, ball, X, all.distance_mm + more);
      ASSERT_TRUE(bounded) << more;
      EXPECT_EQ(bounded->distance_mm, all.distance_mm);
      EXPECT_EQ(bounded->a_triangle, all.a_triangle);
      EXPECT_EQ(bounded->b_triangle, all.b_triangle);
      EXPECT_EQ(bounded->a_point, all.a_point);
      EXPECT_EQ(bounded->b_point, all.b_point);
    }
    EXPECT_FALSE(closest_points(socket, ball, X, all.distance_mm / 2));
  }
}

TEST(ClosestPoints, AreWhereTheyAreWhateverTheOrigins) {
  // Shells about an origin far off separate nothing, those about the centres everything: what they leave out is no
  // part of the answer.
  const TriMesh socket = test::socket({0, 0, 0}, 23, 28, 3), ball = sphere({0, 0, 0}, 20, 3);
  const Vec3 off(300, -200, 100);
  const TriMesh far_socket = test::shifted_by(socket, off);
  std::mt19937 random(13);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  for (int round = 0; round < 60; ++round) {
    const double angle = 3 * anywhere(random), x = anywhere(random), y = anywhere(random);
    Pose X = Pose::Identity();
    X.linear() = Eigen::AngleAxisd(angle, Vec3(x, y, 0.1).normalized()).toRotationMatrix();
    // In the socket, and well outside of it; every third stretched, which is no rigid motion.
    X.translation() = (round % 2 == 0 ? 1 : 70) * Vec3(y, x, 0.3);
    if (round % 3 == 0) X.linear() *= 1.02;
    Pose X_far = X;
    X_far.translation() += off;
    // Distances are rounded to 1e-12 of coordinates below 500 mm.
    EXPECT_NEAR(closest(socket, ball, X).distance_mm, closest(far_socket, ball, X_far).distance_mm, 1e-9)
        << round;
  }
}

TEST(ClosestPoints, OfNothingIsNone) {
  EXPECT_FALSE(
      closest_points(TriangleTree(TriMesh{}), TriangleTree(sphere({0, 0, 0}, 1, 1)), Pose::Identity()));
}

TEST(MovedTree, HoldsWhatItsTrianglesHave) {
  const TriMesh before = sphere({0, 0, 0}, 10, 3);
  const TriMesh after = test::mapped(
      before, [](const Vec3& p) { return Vec3(1.1 * p + Vec3(std::sin(p.y()), 0, 0.2 * p.x())); });
  const TriangleTree moved = TriangleTree(before).moved_to(after.vertices);
  EXPECT_EQ(moved.nodes().size(), TriangleTree(before).nodes().size());
  for (const auto& node : moved.nodes())
    for (Index t = node.first; t < node.last; ++t)
      for (const Vec3& corner : moved.corners(t)) {
        for (int axis = 0; axis < 3; ++axis) {
          const auto k = static_cast<std::size_t>(axis);
          EXPECT_LE(std::abs(corner[axis] - node.centre[k]), node.half[k]);
        }
        EXPECT_LE(corner.norm(), node.farthest);
        EXPECT_GE(corner.norm(), node.nearest);
      }
  EXPECT_EQ(moved.corners(0)[0], after.vertices[moved.mesh_vertices()[moved.triangles()[0][0]]]);
}

}  // namespace
}  // namespace condyle::mesh
