#include "io/image/image_grid.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/coordinate_range.hpp"

namespace condyle::io {
namespace {

/// Sine-like measure of how far three axes are from one plane; below it, they lie in one but for the rounding of the floats
/// that files give them in.
constexpr double flattest = 1e-6;

Eigen::Vector3d signs_to_lps(StatedAxes world) {
  switch (world) {
    case StatedAxes::ras:
      return {-1, -1, 1};
    case StatedAxes::las:
      return {1, -1, 1};
    case StatedAxes::lps:
      break;
  }
  return {1, 1, 1};
}

}  // namespace

void note_own_axes(const LabelFileOptions& options, std::vector<LabelNote>& notes) {
  if (options.axes)
    notes.push_back({LabelNoteCode::axes_not_used,
                     "The file says how its axes lie in the body, and that counts: the axes that were stated "
                     "are not used."});
}

Eigen::Vector3d corner_voxel(const std::array<std::int64_t, 3>& size, int corner) {
  Eigen::Vector3d voxel;
  for (int axis = 0; axis < 3; ++axis)
    voxel[axis] = corner >> axis & 1 ? static_cast<double>(size[static_cast<std::size_t>(axis)] - 1) : 0.0;
  return voxel;
}

VoxelGrid checked_grid(const std::array<std::int64_t, 3>& size, const Eigen::Affine3d& X_WI, StatedAxes world,
                       const ByteSource& source, std::string_view element) {
  VoxelGrid grid{size, X_WI};
  // A zero is added to lose the sign of zeros.
  grid.X_WI.matrix().topRows<3>() =
      (signs_to_lps(world).asDiagonal() * X_WI.matrix().topRows<3>()).array() + 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p_W = grid.X_WI * corner_voxel(size, corner);
    // Not by the largest coefficient, for which nan may count as small.
    if (!(p_W.array().abs() <= core::largest_coordinate).all())
      source.fail(fmt::format("{}: places voxels at ({}, {}, {}) mm, which is not finite or beyond 1e30",
                              element, p_W.x(), p_W.y(), p_W.z()));
  }
  Eigen::Matrix3d axes = grid.X_WI.linear();
  for (int axis = 0; axis < 3; ++axis) {
    const double length = axes.col(axis).stableNorm();
    if (!(length >= core::least_size && length <= core::largest_coordinate))
      source.fail(fmt::format("{}: voxels have an extent of {} mm along axis {}", element, length, axis));
    axes.col(axis) /= length;
  }
  if (!(std::abs(axes.determinant()) >= flattest))
    source.fail(fmt::format("{}: the three axes lie in one plane", element));
  return grid;
}

}  // namespace condyle::io
