#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "condyle/label_surface.hpp"

namespace condyle::io {

/// Writes a label map as NIfTI-1 compressed by gzip, one byte a voxel, its place as sform. The grid is in LPS, mm, its matrix rounded to
/// floats, as the format has them. Throws FileError.
void write_labels(const std::filesystem::path& path, const VoxelGrid& grid,
                  std::span<const std::uint8_t> labels);

}  // namespace condyle::io
