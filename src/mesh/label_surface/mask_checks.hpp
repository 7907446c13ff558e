#pragma once

#include "condyle/label_surface.hpp"

namespace condyle::mesh {

/// Raises UsageError unless the grid's matrix is finite and invertible, the box lies in the image, and its voxels are
/// as many as its size says and 0 or 1.
void check_mask(const VoxelMask& mask);

}  // namespace condyle::mesh
