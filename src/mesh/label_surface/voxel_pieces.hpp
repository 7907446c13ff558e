#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "condyle/label_surface.hpp"
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

/// A piece that was taken out of a box, and whether it is of the bone of the other side of the body.
struct LeftOutPiece {
  std::int64_t voxels;
  bool is_other_side;
};
struct KeptBone {
  std::size_t pieces = 1;
  std::vector<LeftOutPiece> left_out = {};
};

/// A piece with less than this part of the largest is a speck, which belongs to no bone.
inline constexpr std::int64_t speck_share = 100;

/// Keeps one bone: pieces that face each other across a gap of some millimetres over a section, as a growth plate or a fracture leaves them,
/// are one. Of several bones it is the large one whose centroid is nearest to a point, or without one that of most voxels. Halves of a pelvis face
/// each other too, at the symphysis: bones as large as each other and side by side along x are two. `X_WB` takes the box's indices to
/// the world, whose x runs across the body. If all pieces but one are specks, the box stays as it is. Memory: a byte for each voxel.
KeptBone keep_bone(VoxelBox& box, const Eigen::Affine3d& X_WB, const std::optional<Vec3>& point_W);

/// The share of a mask's border, by faces of its voxels, that is against other values one voxel thick, but for the value `nothing`, among the
/// voxels of its image.
double share_in_shells(std::span<const std::uint16_t> image, std::uint16_t nothing, const VoxelMask& mask);

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
