#include "condyle/contact.hpp"

#include "support/test.hpp"

namespace condyle::contact {
namespace {

RadialBodySummary of_points(const std::vector<Vec3>& points) {
  // A plate 5 to 6 mm from the centre, 20 mm wide.
  const radial::RadialTable table(test::box({-10, -10, 5}, {10, 10, 6}));
  Points query;
  for (const Vec3& p : points) query.push_back(p);
  return summarise(table.query(query), query, table.mesh());
}

TEST(RadialSummary, CountsStatesAndFindsTheDeepestVertexAndTheSmallestGap) {
  const auto summary =
      of_points({{0, 0, 4}, {0, 0, 5.25}, {0.1, 0, 4.5}, {0, 0, 5.5}, {1, 1, 5}, {0, 0, -3}});
  EXPECT_EQ(summary.vertices_inside, 2u);
  EXPECT_EQ(summary.vertices_on_surface, 1u);
  ASSERT_TRUE(summary.deepest);
  EXPECT_EQ(summary.deepest->vertex, 3u);
  // The error that RadialTable guarantees: 1e-12 of the radius.
  EXPECT_NEAR(summary.deepest->depth_mm, 0.5, 5.5e-12);
  EXPECT_TRUE(summary.deepest->radial_is_depth());
  EXPECT_NEAR(summary.deepest->shortest_exit_mm, 0.5, 1e-15);
  EXPECT_EQ(summary.min_gap_mm, 0);
  EXPECT_EQ(summary.oblique_inside, 0u);
}

TEST(RadialSummary, AnObliqueDepthDoesNotHideTheDeepestOneThatMeansSomething) {
  // At x = 9.4 the ray runs through the plate at atan(9.4 / 5.1) = 61.5 degrees from its normal.
  const auto summary = of_points({{0, 0, 5.05}, {9.4, 0, 5.1}});
  ASSERT_TRUE(summary.deepest && summary.deepest_facing);
  EXPECT_EQ(summary.deepest->vertex, 1u);
  EXPECT_FALSE(summary.deepest->radial_is_depth());
  EXPECT_EQ(summary.oblique_inside, 1u);
  EXPECT_EQ(summary.deepest_facing->vertex, 0u);
  EXPECT_NEAR(summary.deepest_facing->depth_mm, 0.05, 1e-14);
}

TEST(RadialSummary, WithNothingAlongAnyRayThereIsNoGap) {
  const auto summary = of_points({{0, 0, -3}, {0, -3, -0.1}});
  EXPECT_FALSE(summary.min_gap_mm);
  EXPECT_FALSE(summary.deepest);
}

TEST(RadialSummary, ADepthThroughTheFarEndOfANeckIsNotADepth) {
  // The solid holds the centre, and a neck leads away from it; a point just inside the neck's wall leaves
  // along its ray through the far end, whose surface faces the ray.
  const radial::RadialTable neck(test::box({-5, -5, -5}, {100, 5, 5}));
  Points query;
  query.push_back({30, 4.9, 0});
  const auto summary = summarise(neck.query(query), query, neck.mesh());
  ASSERT_TRUE(summary.deepest);
  EXPECT_GT(summary.deepest->depth_mm, 0.6);
  EXPECT_NEAR(summary.deepest->shortest_exit_mm, 0.1, 1e-14);
  EXPECT_FALSE(summary.deepest->radial_is_depth());
  EXPECT_FALSE(summary.deepest_facing);
}

}  // namespace
}  // namespace condyle::contact
