#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// A box of voxels, 1 inside, else 0; i runs fastest.
struct VoxelBox {
  std::array<std::int64_t, 3> size{};
  std::vector<std::uint8_t> inside;
};

/// Voxels of each 26-connected piece, most first, and of equals the one whose first voxel comes first.
/// Unless `all`, only the first piece stays in the box.
std::vector<std::int64_t> keep_pieces(VoxelBox& box, bool all);

/// Whether a piece may be a bone of its own beside the largest one: a fifth of its voxels.
constexpr bool is_large_piece(std::int64_t voxels, std::int64_t most) noexcept {
  return voxels > 0 && 5 * voxels >= most;
}

/// Keeps one of the large pieces, that whose centroid is nearest to a point.
/// Returns the voxels of those taken out; `X_WB` takes the box's indices to the frame of the point.
std::vector<std::int64_t> keep_large_piece_near(VoxelBox& box, const Eigen::Affine3d& X_WB,
                                                const Vec3& point_W);

/// How many 26-connected pieces each value below `values` is in, in one pass over voxels of the size, i fastest. Memory:
/// two slices.
std::vector<std::size_t> count_pieces(std::span<const std::uint16_t> voxels,
                                      const std::array<std::int64_t, 3>& size, std::size_t values);

struct Cavities {
  std::size_t count = 0;
  std::int64_t voxels = 0;
};

/// Background that is not 6-connected to the outside of the box; becomes inside if `fill`.
Cavities find_cavities(VoxelBox& box, bool fill);

}  // namespace condyle::mesh
