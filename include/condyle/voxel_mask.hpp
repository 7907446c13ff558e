#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace condyle {

/// The grid of an image. p_W = X_WI * (i, j, k) is the centre of voxel (i, j, k), in mm in the world W of the image. Any
/// invertible matrix: grids may be oblique, sheared and mirrored.
struct VoxelGrid {
  std::array<std::int64_t, 3> size{};
  Eigen::Affine3d X_WI = Eigen::Affine3d::Identity();
};

/// The voxels of one bone: a box of the image that holds all of them.
struct VoxelMask {
  VoxelGrid image;
  std::array<std::int64_t, 3> first{};  ///< of the box, in the image
  std::array<std::int64_t, 3> size{};   ///< of the box
  std::vector<std::uint8_t>
      inside;  ///< 1 inside, else 0; size[0] * size[1] * size[2] of them, i runs fastest
};

}  // namespace condyle
