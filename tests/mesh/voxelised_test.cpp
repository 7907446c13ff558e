#include "support/voxelised.hpp"

#include "mesh/winding_number.hpp"
#include "support/test.hpp"

/// The voxeliser of the tests and of the bench, against winding numbers.

namespace condyle {
namespace {

using namespace test;

/// Any linear map of index space: oblique, sheared, mirrored.
Eigen::Matrix3d random_steps(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::Matrix3d steps;
  do {
    for (int i = 0; i < 9; ++i) steps(i) = normal(random);
  } while (std::abs(steps.determinant()) < 0.5);
  return steps;
}

void expect_winding_decides(const TriMesh& mesh, const VoxelGrid& grid) {
  const VoxelMask mask = voxelised(mesh, grid);
  const mesh::WindingNumber winding(mesh);
  std::size_t v = 0, wrong = 0;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        const std::array<std::int64_t, 3> at = {i - mask.first[0], j - mask.first[1], k - mask.first[2]};
        bool in_box = true;
        for (std::size_t a = 0; a < 3; ++a) in_box &= at[a] >= 0 && at[a] < mask.size[a];
        const bool inside = in_box && mask.inside[v] != 0;
        v += in_box;
        const Vec3 index(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        wrong += inside != (winding.at(grid.X_WI * index).winding != 0);
      }
  EXPECT_EQ(v, mask.inside.size());
  EXPECT_EQ(wrong, 0u);
}

TEST(Voxelised, IsInsideWhereTheMeshWindsRound) {
  std::mt19937 random(1);
  const TriMesh ball = sphere({3, -4, 5}, 12, 3),
                two = joined(ball, sphere({14, -4, 5}, 8, 3)),  // they overlap
      ring = torus(12, 4, 40, 20), inverted = flipped(ball);
  for (const TriMesh& mesh : {ball, two, ring, inverted})
    for (int grid = 0; grid < 4; ++grid)
      expect_winding_decides(mesh, grid_around(mesh, mesh, random_steps(random), {0.1, 0.2, 0.3}, 2));
}

TEST(Voxelised, EndsWhereItsGridEnds) {
  std::mt19937 random(2);
  const TriMesh ball = sphere({3, -4, 5}, 12, 3);
  VoxelGrid grid = grid_around(ball, ball, random_steps(random), {0.1, 0.2, 0.3});
  for (std::size_t a = 0; a < 3; ++a) grid.size[a] = grid.size[a] * 3 / 5;
  grid.X_WI.translation() += grid.X_WI.linear() * Vec3(6, 0, 0);
  expect_winding_decides(ball, grid);
}

/// Planes of the grid hold whole faces here: each edge and each vertex lies on a scanline.
TEST(Voxelised, LeaksNowhereIfVerticesLieOnScanlines) {
  const TriMesh cube = box({0, 0, 0}, {4, 5, 6});
  const VoxelMask mask = voxelised(cube, grid_around(cube, cube, Eigen::Matrix3d::Identity(), Vec3::Zero()));
  const auto voxels = static_cast<std::size_t>(std::count(mask.inside.begin(), mask.inside.end(), 1));
  // One of the two faces at each axis counts as inside, the other one as outside.
  EXPECT_EQ(voxels, std::size_t{4 * 5 * 6});
}

TEST(Voxelised, HoldsNothingBesideItsGrid) {
  const TriMesh ball = sphere({300, 0, 0}, 12, 3);
  EXPECT_TRUE(voxelised(ball, {{10, 10, 10}, Eigen::Affine3d::Identity()}).inside.empty());
}

}  // namespace
}  // namespace condyle
