#pragma once

#include "condyle/pose.hpp"
#include "simd/packed_range.hpp"

namespace condyle::tangential {

/// Box of a triangle within a cell of the profile, in 256ths of the cell: ranges of z and of rho, which hold the
/// places of circles.
using CellBox = simd::PackedRange;

/// Where a circle lies in the profile: its cell, and its bytes there.
struct CircleCell {
  Index cell;
  CellBox bytes;
};

}  // namespace condyle::tangential
