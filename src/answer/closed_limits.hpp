#pragma once

#include "condyle/answer.hpp"

namespace condyle::answer {

/// Adds where liner and neck of an implant end each motion in closed form, and a note if the meshes do not agree with it.
void add_closed_limits(RangeAnswer& answer);

}  // namespace condyle::answer
