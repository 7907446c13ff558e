#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace condyle::mesh {

/// A box of voxels, 1 inside, else 0; i runs fastest.
struct VoxelBox {
  std::array<std::int64_t, 3> size{};
  std::vector<std::uint8_t> inside;
};

/// Voxels of each 26-connected piece, most first, and of equals the one whose first voxel comes first.
/// Unless `all`, only the first piece stays in the box.
std::vector<std::int64_t> keep_pieces(VoxelBox& box, bool all);

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
