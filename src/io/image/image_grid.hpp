#pragma once

#include <Eigen/Geometry>
#include <string_view>
#include <vector>

#include "condyle/io/label_file.hpp"
#include "io/image/byte_source.hpp"

namespace condyle::io {

/// The grid in LPS from its affine in a stated world. Refuses numbers that are not finite or beyond 1e30 anywhere in the image,
/// and axes that lie in one plane. `element` is where the file gives the affine.
VoxelGrid checked_grid(const std::array<std::int64_t, 3>& size, const Eigen::Affine3d& X_WI, StatedAxes world,
                       const ByteSource& source, std::string_view element);

/// Notes axes that were stated for a file that has its own.
void note_own_axes(const LabelFileOptions& options, std::vector<LabelNote>& notes);

/// The voxel at one of the eight corners of the image.
Eigen::Vector3d corner_voxel(const std::array<std::int64_t, 3>& size, int corner);

}  // namespace condyle::io
