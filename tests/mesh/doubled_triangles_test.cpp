#include "mesh/doubled_triangles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include "support/test_meshes.hpp"

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

TEST(DoubledTriangles, AreNoneOfTheOppositeSenseNorBeside) {
  const TriMesh ball = test::sphere(Vec3::Zero(), 10, 2);
  EXPECT_EQ(doubled_triangles(test::joined(ball, test::flipped(ball))).count, 0u);
  EXPECT_EQ(doubled_triangles(test::joined(ball, test::sphere({1e-9, 0, 0}, 10, 2))).count, 0u);
}

}  // namespace
}  // namespace condyle::mesh
