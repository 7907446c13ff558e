#include "accuracy.hpp"

#include "support/test.hpp"

namespace bench {
namespace {

using condyle::Pose;
using condyle::TriMesh;
using condyle::Vec3;

/// One of the eight corners of a box of 4 mm, those at -1 and 3 mm, stands in a box of 10 mm that begins at the
/// centre of the first, 3 mm from three faces.
class BoxInCorner : public ::testing::Test {
 protected:
  const TriMesh fixed_ = condyle::test::box({0, 0, 0}, {10, 10, 10});
  const TriMesh mobile_ = condyle::test::box({-1, -1, -1}, {3, 3, 3});
  const Pose away_ = [] {
    Pose X = Pose::Identity();
    X.translation() = Vec3(-20, 0.5, 0.5);
    return X;
  }();
  const Pose here_ = [] {
    Pose X = Pose::Identity();
    X.translation() = Vec3(0.25, 0.5, 0.125);
    return X;
  }();
  const TriMesh moved_ = posed(shifted(), fixed_);
  Reference reference_{Bodies{moved_, mobile_}, {here_, away_}};

  /// The centre of rays must not be on the surface.
  static Pose shifted() {
    Pose X = Pose::Identity();
    X.translation() = Vec3(0.0625, 0.03125, 0.015625);
    return X;
  }
  static constexpr std::size_t touching = 0, apart = 1;
  static constexpr condyle::Index corner_inside = 7;
};

TEST_F(BoxInCorner, TheReferenceFindsTheOneCornerAndItsWayOut) {
  ASSERT_EQ(reference_.inside(touching).size(), 1u);
  EXPECT_EQ(reference_.inside(touching)[0].vertex, corner_inside);
  EXPECT_FALSE(reference_.inside(touching)[0].is_on_surface);
  // 3 + 0.125 - 0.015625 above the lowest face: exact in doubles.
  EXPECT_EQ(reference_.depths(touching, DepthKind::nearest_surface).at(0), 3.109375);
  EXPECT_TRUE(reference_.inside(apart).empty());
  EXPECT_FALSE(reference_.pairs(touching).empty());
  EXPECT_TRUE(reference_.pairs(apart).empty());
}

TEST_F(BoxInCorner, AVertexNotToldAndOnesFalselyToldAreCounted) {
  InsideAccuracy accuracy;
  std::vector<InsideVertex> reported = {{6, 0, 1.0}, {3, 0, 1.0}};
  compare(reported, reference_, touching, DepthKind::nearest_surface, accuracy);
  EXPECT_EQ(accuracy.inside, 1);
  EXPECT_EQ(accuracy.false_outside, 1);
  EXPECT_EQ(accuracy.false_inside, 2);
  EXPECT_EQ(accuracy.depths, 0);
  EXPECT_FALSE(accuracy.agrees());
}

TEST_F(BoxInCorner, ADepthIsHeldAgainstTheTrueOneOfItsKind) {
  InsideAccuracy accuracy;
  std::vector<InsideVertex> reported = {{corner_inside, 0, 3.609375}};
  compare(reported, reference_, touching, DepthKind::nearest_surface, accuracy);
  reported = {};
  compare(reported, reference_, apart, DepthKind::nearest_surface, accuracy);
  EXPECT_TRUE(accuracy.agrees());
  EXPECT_EQ(accuracy.depths, 1);
  EXPECT_EQ(accuracy.depth_error_max_mm, 0.5);
  EXPECT_EQ(accuracy.mean_depth_error_mm(), 0.5);
}

TEST_F(BoxInCorner, ADepthIsWrongIfItIsOffByMoreThanATenthOfAMillimetre) {
  InsideAccuracy accuracy;
  for (const double error_mm : {-0.125, -0.0625, 0.0625, 0.125}) {
    std::vector<InsideVertex> reported = {{corner_inside, 0, 3.109375 + error_mm}};
    compare(reported, reference_, touching, DepthKind::nearest_surface, accuracy);
  }
  EXPECT_EQ(accuracy.depths, 4);
  EXPECT_EQ(accuracy.depths_off, 2);
}

TEST_F(BoxInCorner, ADepthThatIsNotToldIsNotCompared) {
  InsideAccuracy accuracy;
  std::vector<InsideVertex> reported = {{corner_inside}};
  compare(reported, reference_, touching, DepthKind::along_ray, accuracy);
  EXPECT_TRUE(accuracy.agrees());
  EXPECT_EQ(accuracy.depths, 0);
}

TEST_F(BoxInCorner, PairsAreComparedAsSets) {
  std::vector<condyle::contact::TrianglePair> reported = reference_.pairs(touching);
  const auto all = static_cast<std::int64_t>(reported.size());
  std::reverse(reported.begin(), reported.end());
  reported.push_back(reported.front());
  PairAccuracy right;
  compare(reported, reference_, touching, right);
  EXPECT_TRUE(right.agrees());
  EXPECT_EQ(right.pairs, all);

  reported = reference_.pairs(touching);
  reported.front() = {99, 99};
  PairAccuracy wrong;
  compare(reported, reference_, touching, wrong);
  EXPECT_EQ(wrong.missed, 1);
  EXPECT_EQ(wrong.invented, 1);
}

TEST_F(BoxInCorner, AMissedContactAndAnInventedOneAreCounted) {
  TouchAccuracy accuracy;
  compare(true, reference_, touching, accuracy);
  EXPECT_TRUE(accuracy.agrees());
  compare(false, reference_, touching, accuracy);
  compare(true, reference_, apart, accuracy);
  EXPECT_EQ(accuracy.poses, 3);
  EXPECT_EQ(accuracy.touching, 2);
  EXPECT_EQ(accuracy.missed, 1);
  EXPECT_EQ(accuracy.invented, 1);
}

}  // namespace
}  // namespace bench
