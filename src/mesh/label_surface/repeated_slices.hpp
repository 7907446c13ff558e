#pragma once

#include <cstddef>

#include "condyle/label_surface.hpp"

namespace condyle::mesh {

/// How many slices of a mask along an index axis repeat one of the image in which it was made, 5 where slices of 5 mm were resampled to 1 mm by
/// the nearest neighbour: the mean length of runs of equal slices, those of a straight shaft left out. 1 if most slices differ from the next.
double slices_in_one(const VoxelMask& mask, std::size_t axis);

}  // namespace condyle::mesh
