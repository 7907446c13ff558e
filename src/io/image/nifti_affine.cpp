#include "io/image/nifti_affine.hpp"

#include <fmt/format.h>

#include <cmath>

#include "io/image/image_grid.hpp"

namespace condyle::io {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Two affines that differ by less at every corner place every voxel in the same spot for any use of a label map.
constexpr double largest_difference = 0.1;  // voxels

Affine3d affine_of(const Matrix3d& axes, const Vector3d& origin) {
  Affine3d X_WI = Affine3d::Identity();
  X_WI.linear() = axes;
  X_WI.translation() = origin;
  return X_WI;
}

Affine3d sform(const NiftiHeader& header) {
  Affine3d X_WI = Affine3d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      X_WI.matrix()(row, column) =
          header.srow[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  return X_WI;
}

Vector3d voxel_extents(const NiftiHeader& header) {
  return {header.pixdim[1], header.pixdim[2], header.pixdim[3]};
}

void check_voxel_extents(const NiftiHeader& header, const ByteSource& source) {
  for (std::size_t axis = 1; axis <= 3; ++axis)
    if (!(header.pixdim[axis] > 0 && std::isfinite(header.pixdim[axis])))
      source.fail(fmt::format("pixdim[{}]: {} is no extent of a voxel", axis, header.pixdim[axis]));
}

void check_qform(const NiftiHeader& header, const ByteSource& source) {
  for (const double number : header.quaternion)
    if (!std::isfinite(number)) source.fail("quatern_b, quatern_c, quatern_d: not finite");
  check_voxel_extents(header, source);
}

/// Columns of the quaternion's rotation times pixdim[1..3], the third one times the sign of pixdim[0], which counts as + for 0:
/// it makes the axes left-handed.
Affine3d qform(const NiftiHeader& header) {
  Vector3d bcd(header.quaternion[0], header.quaternion[1], header.quaternion[2]);
  const double squared = 1 - bcd.squaredNorm();
  double a = 0;
  if (squared < 1e-7)  // as NIfTI's own library: rounding may leave a small negative number
    bcd.normalize();
  else
    a = std::sqrt(squared);
  Vector3d extents = voxel_extents(header);
  if (header.pixdim[0] < 0) extents.z() = -extents.z();
  const Eigen::Quaterniond rotation(a, bcd.x(), bcd.y(), bcd.z());
  return affine_of(rotation.toRotationMatrix() * extents.asDiagonal(),
                   {header.qoffset[0], header.qoffset[1], header.qoffset[2]});
}

/// The largest distance of a corner voxel between both, in voxels of the first.
double difference(const Affine3d& first, const Affine3d& second, const std::array<std::int64_t, 3>& size) {
  const Matrix3d inverse = first.linear().inverse();
  double largest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d voxel = corner_voxel(size, corner);
    const double by = (inverse * (second * voxel - first * voxel)).norm();
    if (!(by <= largest)) largest = by;
  }
  return largest;
}

/// Sizes that differ by less than this part are one size, rounded.
constexpr double size_rounding = 1e-3;

/// Where the sform, which is used, and pixdim have voxels of different sizes: half of the programs then show another size.
void note_voxel_sizes(const NiftiHeader& header, const Affine3d& X_WI, double mm,
                      std::vector<LabelNote>& notes) {
  const Vector3d of_pixdim = voxel_extents(header), of_sform = X_WI.linear().colwise().norm();
  if (!of_pixdim.allFinite() || !(of_pixdim.minCoeff() > 0)) return;
  if (((of_sform - of_pixdim).cwiseAbs().array() <= size_rounding * of_sform.array()).all()) return;
  const auto text = [&](const Vector3d& size) {
    return fmt::format("{:.4g} x {:.4g} x {:.4g} mm", mm * size.x(), mm * size.y(), mm * size.z());
  };
  notes.push_back(
      {LabelNoteCode::two_voxel_sizes, fmt::format("Voxels are {} by the sform, which was used as nibabel "
                                                   "does, and {} by pixdim, which ITK and 3D Slicer take.",
                                                   text(of_sform), text(of_pixdim))});
}

double nifti_mm_per_unit(const NiftiHeader& header, const ByteSource& source, std::vector<LabelNote>& notes) {
  switch (const int unit = header.units & 7) {
    case 0:
      notes.push_back({LabelNoteCode::unknown_units,
                       "The file names no unit of length (xyzt_units is 0): mm was assumed."});
      return 1;
    case 1:
      return 1000;
    case 2:
      return 1;
    case 3:
      return 1e-3;
    default:
      source.fail(fmt::format("xyzt_units: {} is no unit of length", unit));
  }
}

struct ChosenAffine {
  Affine3d X_WI;
  StatedAxes world;
  const char* element;
};

ChosenAffine chosen_affine(const NiftiHeader& header, const LabelFileOptions& options,
                           const ByteSource& source) {
  const bool has_sform = header.sform_code > 0, has_qform = header.qform_code > 0;
  if (options.affine == AffineChoice::sform && !has_sform) source.fail("sform_code: the file has no sform");
  if (options.affine == AffineChoice::qform && !has_qform) source.fail("qform_code: the file has no qform");
  if (has_sform && options.affine != AffineChoice::qform) return {sform(header), StatedAxes::ras, "srow"};
  if (has_qform) {
    check_qform(header, source);
    return {qform(header), StatedAxes::ras, "qform"};
  }
  if (!options.axes)
    source.fail(
        "qform_code, sform_code: both are 0: the file does not say how its axes lie in the body; state it");
  check_voxel_extents(header, source);
  return {affine_of(voxel_extents(header).asDiagonal(), Vector3d::Zero()), *options.axes, "pixdim"};
}

}  // namespace

VoxelGrid nifti_grid(const NiftiHeader& header, const std::array<std::int64_t, 3>& size,
                     const LabelFileOptions& options, const ByteSource& source,
                     std::vector<LabelNote>& notes) {
  auto [X_WI, world, element] = chosen_affine(header, options, source);
  if (header.sform_code > 0 || header.qform_code > 0) note_own_axes(options, notes);
  const double mm = nifti_mm_per_unit(header, source, notes);
  const auto grid =
      checked_grid(size, affine_of(X_WI.linear() * mm, X_WI.translation() * mm), world, source, element);
  if (header.sform_code > 0 && options.affine != AffineChoice::qform)
    note_voxel_sizes(header, X_WI, mm, notes);
  if (header.sform_code > 0 && header.qform_code > 0) {
    const bool uses_qform = options.affine == AffineChoice::qform;
    const double voxels = difference(X_WI, uses_qform ? sform(header) : qform(header), size);
    if (!(voxels <= largest_difference))
      notes.push_back(
          {LabelNoteCode::two_affines,
           fmt::format("The file has two affines, sform and qform, {}: {} was used.",
                       std::isfinite(voxels) ? fmt::format("which differ by up to {:.3g} voxels", voxels)
                                             : "of which one is not finite",
                       uses_qform ? "qform" : "sform")});
  }
  return grid;
}

}  // namespace condyle::io
