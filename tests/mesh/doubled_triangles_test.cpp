#include "mesh/doubled_triangles.hpp"

#include <cstddef>

#include "condyle/inspect.hpp"
#include "mesh/enclosed_volume.hpp"
#include "support/test.hpp"

namespace condyle::mesh {
namespace {

TEST(DoubledTriangles, AreThoseOfASurfaceThatIsThereTwice) {
  const TriMesh ball = test::sphere(Vec3::Zero(), 10, 2);
  const std::size_t count = ball.triangles.size();
  EXPECT_EQ(doubled_triangles(ball).count, 0u);
  EXPECT_EQ(doubled_triangles(TriMesh{}).count, 0u);
  // By the same vertices, by others in the same places, and from another corner on.
  TriMesh twice = ball;
  twice.triangles.insert(twice.triangles.end(), ball.triangles.begin(), ball.triangles.end());
  TriMesh turned = test::joined(ball, ball);
  for (std::size_t t = count; t < 2 * count; ++t)
    std::rotate(turned.triangles[t].begin(), turned.triangles[t].begin() + 1, turned.triangles[t].end());
  for (const TriMesh& mesh : {twice, test::joined(ball, ball), turned}) {
    const DoubledTriangles found = doubled_triangles(mesh);
    EXPECT_EQ(found.count, count);
    ASSERT_TRUE(found.first);
    EXPECT_EQ((*found.first)[0], 0u);
    EXPECT_EQ((*found.first)[1], count);
  }
  EXPECT_EQ(doubled_triangles(test::joined(ball, twice)).count, 2 * count) << "three times";
}

TEST(DoubledTriangles, OfTheOppositeSenseAreAWallWithoutThickness) {
  const TriMesh ball = test::sphere(Vec3::Zero(), 10, 2);
  const std::size_t count = ball.triangles.size();
  TriMesh same_vertices = ball;
  for (const auto& [a, b, c] : ball.triangles) same_vertices.triangles.push_back({b, a, c});
  for (const TriMesh& mesh : {test::joined(ball, test::flipped(ball)), same_vertices}) {
    const DoubledTriangles found = doubled_triangles(mesh);
    EXPECT_EQ(found.count, 0u);
    EXPECT_EQ(found.opposite, count);
    EXPECT_EQ((*found.first_opposite)[1], count);
    EXPECT_TRUE(found.is_two_sided() && is_two_sided(mesh) && !is_inside_out(mesh));
    EXPECT_EQ(inspect(mesh).two_sided, two_sided_text);
  }
  TriMesh partly = test::joined(ball, test::box({20, 0, 0}, {21, 1, 1}));
  partly.triangles.push_back({0, 1, 2}), partly.triangles.push_back({1, 0, 2});
  const DoubledTriangles found = doubled_triangles(partly);
  EXPECT_EQ(found.opposite, 1u);
  EXPECT_FALSE(found.is_two_sided());
}

TEST(DoubledTriangles, AreNoneBeside) {
  const TriMesh ball = test::sphere(Vec3::Zero(), 10, 2);
  EXPECT_EQ(doubled_triangles(test::joined(ball, test::sphere({1e-9, 0, 0}, 10, 2))).count, 0u);
}

}  // namespace
}  // namespace condyle::mesh
