#pragma once

#include "condyle/inspect.hpp"
#include "condyle/label_surface.hpp"
#include "support/sound_mesh.hpp"
#include "support/test.hpp"

/// Masks of simple bodies, and what every surface of one must fulfil.

namespace condyle::test {

using Voxels3 = std::array<std::int64_t, 3>;

/// A mask of a whole image: the voxels (i, j, k), as a point, for which is_inside holds.
template <class IsInside>
VoxelMask mask_where(const Voxels3& size, const IsInside& is_inside,
                     const Eigen::Affine3d& X_WI = Eigen::Affine3d::Identity()) {
  VoxelMask mask;
  mask.image = {size, X_WI};
  mask.size = size;
  mask.inside.reserve(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const Vec3 p(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        mask.inside.push_back(is_inside(p) ? 1 : 0);
      }
    }
  }
  return mask;
}

inline VoxelMask ball_mask(const Voxels3& size, const Vec3& centre, double radius,
                           const Eigen::Affine3d& X_WI = Eigen::Affine3d::Identity()) {
  return mask_where(
      size, [&](const Vec3& p) { return (p - centre).norm() < radius; }, X_WI);
}

/// The same voxels in the smallest box; at least one is set.
inline VoxelMask cropped(const VoxelMask& mask) {
  Voxels3 low = mask.size, high{-1, -1, -1};
  const auto visit = [&](const auto& voxel) {
    std::size_t v = 0;
    for (std::int64_t k = 0; k < mask.size[2]; ++k)
      for (std::int64_t j = 0; j < mask.size[1]; ++j)
        for (std::int64_t i = 0; i < mask.size[0]; ++i) voxel(Voxels3{i, j, k}, mask.inside[v++]);
  };
  visit([&](const Voxels3& at, std::uint8_t inside) {
    for (std::size_t a = 0; a < 3 && inside != 0; ++a) {
      low[a] = std::min(low[a], at[a]);
      high[a] = std::max(high[a], at[a]);
    }
  });
  VoxelMask small{mask.image, {}, {}, {}};
  for (std::size_t a = 0; a < 3; ++a) {
    small.first[a] = mask.first[a] + low[a];
    small.size[a] = high[a] - low[a] + 1;
  }
  visit([&](const Voxels3& at, std::uint8_t inside) {
    for (std::size_t a = 0; a < 3; ++a)
      if (at[a] < low[a] || at[a] > high[a]) return;
    small.inside.push_back(inside);
  });
  return small;
}

/// Free of what inspect() finds, self-crossings too.
inline void expect_sound(const TriMesh& mesh) {
  const MeshReport report = inspect(mesh);
  expect_sound(report);
  EXPECT_EQ(report.self_crossings.count, 0u);
}

}  // namespace condyle::test
