#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "condyle/control.hpp"
#include "condyle/mesh.hpp"

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

/// How a surface is made of a mask.
struct LabelSurfaceOptions {
  /// Standard deviation of the Gaussian along each index axis, in voxels, from 0 (none) to 4. At 0.65 the steps that
  /// voxels leave and the rounding of edges change limits of motion by as much, in opposite directions: errors of many
  /// limits then average to nothing. Rounding: an edge or a ball moves inwards by sigma^2 (k1 + k2) / 2, k1 and k2 its
  /// principal curvatures. Rods of one voxel vanish, plates of one voxel stay.
  double sigma_voxels = 0.65;
  /// Every 26-connected piece; otherwise the one of most voxels.
  bool all_pieces = false;
  /// Cavities stay hollow; otherwise they are filled.
  bool keep_cavities = false;
  /// The surface is simplified to so many triangles, 100 or more, if it has more: to one fewer if the number is odd, to
  /// more if no edge is left that could go.
  std::optional<std::size_t> triangles = std::nullopt;
};

/// Voxels that hang together over faces, edges or corners.
struct LabelPiece {
  std::int64_t voxels = 0;
  double volume = 0;  ///< mm^3
  bool kept = false;
};

/// Background that is not connected over faces of voxels to the outside of the mask's box: marrow, cysts. A tunnel is
/// none, nor is a marrow canal that the border of the image opens.
struct LabelCavities {
  std::size_t count = 0;
  std::int64_t voxels = 0;
  double volume = 0;  ///< mm^3
};

/// The flat face that closes a bone at one side of the image, half a voxel beyond the centres of the last voxels.
struct CapPlane {
  int axis = 0;                  ///< of the image's index: 0, 1, 2
  bool high = false;             ///< At the last voxel of that axis; otherwise at the first.
  Vec3 normal = Vec3::Zero();    ///< Unit, outwards.
  double offset = 0;             ///< The plane is normal . p = offset, to rounding.
  double area = 0;               ///< mm^2
  std::vector<Index> triangles;  ///< ascending
};

/// Result of a simplification.
struct LabelSimplification {
  std::size_t triangles_before = 0;
  /// Largest distance, in mm, of a vertex of the surface before from the surface after.
  double largest_error = 0;
};

/// The surface of a bone's mask, in mm in the world of its image.
struct LabelSurface {
  /// Closed, every edge in two triangles, every vertex in one fan, wound outwards, without self-crossings and degenerate
  /// triangles. Without `all_pieces` and `keep_cavities` one connected component, or those into which
  /// smoothing parts one piece, without specks.
  TriMesh mesh;
  std::vector<CapPlane> caps;      ///< By axis, low before high: those sides of the image that cut the bone.
  std::vector<LabelPiece> pieces;  ///< Most voxels first.
  LabelCavities cavities;          ///< of the kept pieces; filled unless `keep_cavities`
  /// Components of the contour that were left out: specks that smoothing separated from the bone, hollows that it closed.
  std::size_t dropped_components = 0;
  /// Lengths in mm of one step along each index axis.
  Vec3 spacing = Vec3::Zero();
  /// How many slices along each index axis are alike, as of a map that was resampled to thinner ones by the nearest neighbour: they count as one.
  Vec3 slices_in_one = Vec3::Ones();
  /// mm: about the largest distance between this surface and the boundary that was digitised, by experience, not as a bound.
  /// A voxel's half width along a unit normal n is about sqrt(sum_i (n . a_i)^2) / 2, a_i the steps along the index axes;
  /// this is its largest value over all n: half the largest singular value of the grid's matrix, hence half the largest
  /// spacing where the axes are at right angles.
  double digitisation = 0;
  std::optional<LabelSimplification> simplification;
};

/// The surface at the half level of the smoothed mask. Steps: largest piece, cavities, Gaussian, contour, largest component.
///
/// A mask that reaches the first or last voxels of its image is taken to go on beyond them as it ends there, and is cut
/// half a voxel beyond their centres by a flat cap. A wall that is oblique to the cap is bent by less than half a voxel
/// there.
///
/// A vertex lies on the line between two neighbouring samples where their linear interpolation has the half level, but
/// never within 0.001 of a sample: there it is moved by less than 0.001 of the distance of the samples. The result does
/// not depend on the number of threads, nor on how much larger than the voxels the mask's box is. Memory: about 6 bytes
/// per voxel of the box, and the surface.
///
/// Raises UsageError for options out of range, for a grid whose matrix is not finite or not invertible, and for a mask whose
/// arrays do not fit its sizes; MeshError if no voxel is set, or if smoothing leaves none of them.
[[nodiscard]] LabelSurface surface_of(const VoxelMask& mask, const LabelSurfaceOptions& options = {});

/// The same; empty if it was stopped. Progress: steps of the work.
[[nodiscard]] std::optional<LabelSurface> surface_of(const VoxelMask& mask,
                                                     const LabelSurfaceOptions& options,
                                                     const Control& control);

/// Where two bones of one image touch.
struct TouchingVoxels {
  std::size_t faces = 0;       ///< Between a voxel of one and a voxel of the other.
  std::optional<Vec3> centre;  ///< Mean of the faces' centres, in the world.
  std::size_t shared = 0;      ///< Voxels that both have: layers of one image may overlap.
};

/// Raises UsageError if the masks are of different grids, or their arrays do not fit their sizes.
[[nodiscard]] TouchingVoxels touching_voxels(const VoxelMask& a, const VoxelMask& b);

}  // namespace condyle
