#pragma once

#include <cstdint>

#include "condyle/points.hpp"

namespace condyle::tangential {

/// Box of a triangle within a cell of the profile, in 256ths of the cell, one byte each from the lowest:
/// z low, 255 - z high, rho low, 255 - rho high. A circle whose bytes are z, 255 - z, rho and 255 - rho is
/// held where none of the box's bytes exceeds its own.
using CellBox = std::uint32_t;

/// Where a circle lies in the profile: its cell, and its bytes there.
struct CircleCell {
  Index cell;
  CellBox bytes;
};

}  // namespace condyle::tangential
