#include "contact/body_pair.hpp"

#include "condyle/angle.hpp"
#include "contact/brute_pairs.hpp"
#include "mesh/triangle_intersection.hpp"
#include "support/brute_force.hpp"
#include "support/random_pose.hpp"
#include "support/test.hpp"

namespace condyle::contact {
namespace {

using test::box;
using test::sphere;

/// The same by the exact test in double, for larger meshes: each triangle with each whose box meets its own.
std::vector<TrianglePair> each_with_each(const TriMesh& fixed, const TriMesh& posed_mobile) {
  const auto triangle = [](const TriMesh& mesh, Index t) {
    return mesh::TriangleCorners{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
  };
  using Box = Eigen::AlignedBox3d;
  const auto boxes = [&](const TriMesh& mesh) {
    std::vector<Box> all(mesh.triangles.size());
    for (Index t = 0; t < all.size(); ++t)
      for (int k = 0; k < 3; ++k) all[t].extend(mesh.corner(t, k));
    return all;
  };
  const std::vector<Box> fixed_box = boxes(fixed), mobile_box = boxes(posed_mobile);
  std::vector<TrianglePair> pairs;
  for (Index f = 0; f < fixed_box.size(); ++f) {
    for (Index m = 0; m < mobile_box.size(); ++m) {
      if (!fixed_box[f].intersects(mobile_box[m])) continue;
      if (mesh::triangles_intersect(triangle(fixed, f), triangle(posed_mobile, m))) pairs.push_back({f, m});
    }
  }
  return pairs;
}

Pose shifted(double x, double y = 0, double z = 0) {
  return test::rotated(0, {0, 0, 1}, {x, y, z});
}

TEST(BodyPair, HasThePairsOfRationalArithmeticInEveryPose) {
  const TriMesh fixed = test::socket({0.05, 0.1, 0}, 1.0, 1.3, 1), mobile = test::torus(1.1, 0.15, 7, 5);
  const BodyPair bodies(fixed, mobile);
  std::size_t found = 0, free_poses = 0;
  for (int i = 0; i < 8; ++i) {
    const Pose X = test::rotated(31 * i, {1, 0.3 * i, -0.5}, Vec3(0.02 * i, i % 4 == 0 ? -2.4 : -0.1, 0));
    const auto pairs = bodies.pairs(X);
    EXPECT_EQ(pairs, test::brute_pairs(fixed, posed(X, mobile)));
    EXPECT_EQ(bodies.touch(X), !pairs.empty());
    found += pairs.size();
    free_poses += pairs.empty();
  }
  EXPECT_GT(found, 30u);
  EXPECT_GT(free_poses, 0u);
}

/// Large enough for deep trees.
TEST(BodyPair, HasThePairsThatTestingEachWithEachFinds) {
  const TriMesh fixed = test::socket({0.3, 0.2, 0.1}, 24, 27, 4), mobile = sphere({0, 0.4, 0.2}, 23.5, 4);
  const BodyPair bodies(fixed, mobile);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-180, 180), shift(-3, 3);
  std::size_t found = 0;
  for (int i = 0; i < 20; ++i) {
    const Pose X = test::rotated(angle(random), {shift(random), shift(random), 1},
                                 i % 2 == 0 ? Vec3(Vec3::Zero()) : Vec3(shift(random), shift(random), 0));
    const auto pairs = bodies.pairs(X);
    EXPECT_EQ(pairs, each_with_each(fixed, posed(X, mobile)));
    found += pairs.size();
  }
  EXPECT_GT(found, 1000u);
}

TEST(BodyPair, ABallInAMatchedSocketIsFreeUntilItsGapIsClosed) {
  const TriMesh ball = sphere({0, 0, 0}, 24, 4), hollow = test::socket({0, 0, 0}, 25, 28, 4);
  const BodyPair bodies(hollow, ball);
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(bodies.touch(test::rotated(13 * i, {1.0 * i, 2, 3})));
  // The facets of the socket's inside sag outwards from the ball and those of the ball inwards: the gap is 1
  // mm at least.
  EXPECT_FALSE(bodies.touch(shifted(0.999)));
  EXPECT_TRUE(bodies.touch(shifted(1.2)));
}

TEST(BodyPair, FacesThatTouchAreInContactAndOneRoundingApartAreNot) {
  const BodyPair bodies(box({1, -1, -1}, {3, 1, 1}), box({-1.5, -0.5, -0.5}, {1, 0.5, 0.5}));
  EXPECT_TRUE(bodies.touch(Pose::Identity()));
  EXPECT_FALSE(bodies.touch(shifted(-0x1p-52)));
}

TEST(BodyPair, CrossedBarsTouchWithNoVertexInside) {
  const BodyPair bodies(box({-5, 1, -0.5}, {5, 2, 0.5}), box({-0.5, 1.25, -5}, {0.5, 1.75, 5}));
  EXPECT_TRUE(bodies.touch(Pose::Identity()));
  EXPECT_FALSE(bodies.touch(shifted(0, 0.75 + 0x1p-40)));
}

TEST(BodyPair, ABodyInsideTheSolidOfTheOtherTouchesIt) {
  const TriMesh large = sphere({0.1, 0, 0}, 10, 2), small = sphere({2, 0, 0}, 1, 2);
  const Pose aslant = test::rotated(40, {1, 2, 3}, {0.5, -1, 0.25});
  for (const Pose& X : {Pose::Identity(), aslant}) {
    EXPECT_TRUE(BodyPair(large, small).pairs(X).empty());
    EXPECT_TRUE(BodyPair(large, small).touch(X));
    EXPECT_TRUE(BodyPair(small, large).touch(X));
  }
  // The second of two components is inside.
  const TriMesh beside_and_inside = test::joined(box({30, 30, 30}, {31, 31, 31}), small);
  EXPECT_TRUE(BodyPair(large, beside_and_inside).touch(Pose::Identity()));
  EXPECT_TRUE(BodyPair(beside_and_inside, large).touch(Pose::Identity()));
}

TEST(BodyPair, ABodyInTheHollowOfAnotherIsFree) {
  TriMesh inner_wall = sphere({0, 0, 0}, 5, 2);
  for (auto& triangle : inner_wall.triangles) std::swap(triangle[0], triangle[1]);
  const TriMesh shell = test::joined(sphere({0, 0, 0}, 10, 2), inner_wall);
  const TriMesh small = sphere({0.5, 0, 0}, 1, 2);
  EXPECT_FALSE(BodyPair(shell, small).touch(Pose::Identity()));
  EXPECT_FALSE(BodyPair(small, shell).touch(Pose::Identity()));
}

TEST(BodyPair, AnOpenMeshHasNoInside) {
  TriMesh open = sphere({0, 0, 0}, 10, 2);
  open.triangles.pop_back();
  const TriMesh small = sphere({2, 0, 0}, 1, 2);
  EXPECT_FALSE(BodyPair(open, small).touch(Pose::Identity()));
  EXPECT_FALSE(BodyPair(small, open).touch(Pose::Identity()));
  EXPECT_TRUE(BodyPair(open, small).touch(shifted(7.5)));
}

TEST(BodyPair, AnEmptyMeshTouchesNothing) {
  const TriMesh ball = sphere({0, 0, 0}, 1, 1);
  EXPECT_FALSE(BodyPair(ball, TriMesh{}).touch(Pose::Identity()));
  EXPECT_FALSE(BodyPair(TriMesh{}, ball).touch(Pose::Identity()));
  EXPECT_TRUE(BodyPair(TriMesh{}, TriMesh{}).pairs(Pose::Identity()).empty());
}

TEST(BodyPair, TheLastHitIsAPairThatMeetsAndChangesNoAnswer) {
  const TriMesh fixed = box({10, -2, -2}, {14, 2, 2}), mobile = box({9, -1, -1}, {12, 1, 1});
  const BodyPair bodies(fixed, mobile);
  std::optional<TrianglePair> last_witness;
  std::size_t hits = 0;
  for (int degrees = 0; degrees < 360; ++degrees) {
    const Pose X = test::rotated(degrees, {0, 0, 1});
    const bool touches = bodies.touch(X, last_witness);
    EXPECT_EQ(touches, bodies.touch(X)) << degrees;
    if (!touches || bodies.pairs(X).empty()) continue;
    ++hits;
    const auto pairs = bodies.pairs(X);
    EXPECT_TRUE(std::find(pairs.begin(), pairs.end(), *last_witness) != pairs.end()) << degrees;
  }
  EXPECT_GT(hits, 10u);
  EXPECT_LT(hits, 90u);
}

/// Single precision no longer separates such bodies, or has no such numbers: slower, and as right.
TEST(BodyPair, IsRightFarFromTheOriginAndBeyondSinglePrecision) {
  for (const double size : {1e9, 4e29, 1e-29}) {
    const TriMesh fixed = box({1 * size, -size, -size}, {2 * size, size, size});
    const TriMesh mobile = box({-size, -size, -size}, {size, size, size});
    const BodyPair bodies(fixed, mobile);
    EXPECT_TRUE(bodies.touch(Pose::Identity())) << size;
    EXPECT_EQ(bodies.pairs(Pose::Identity()), test::brute_pairs(fixed, mobile)) << size;
    EXPECT_FALSE(bodies.touch(shifted(-size * 0x1p-52))) << size;
  }
}

/// A pose that scales by a millionth is no rotation, but what it makes of the vertices can still be asked.
TEST(BodyPair, IsRightForAMatrixThatIsNotQuiteARotation) {
  const TriMesh fixed = test::socket({0, 0, 0}, 25, 28, 3), mobile = sphere({0, 0, 0}, 24.9999, 3);
  const BodyPair bodies(fixed, mobile);
  for (const double scale : {1 - 1e-5, 1 + 1e-5, 1 + 1e-3, 1 + 1e-2}) {
    Pose X = test::rotated(50, {3, 2, 1});
    X.linear() *= scale;
    EXPECT_EQ(bodies.pairs(X), each_with_each(fixed, posed(X, mobile))) << scale;
  }
}

}  // namespace
}  // namespace condyle::contact
