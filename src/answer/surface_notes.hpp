#pragma once

#include <vector>

#include "condyle/answer.hpp"

namespace condyle::answer {

/// Notes on surfaces that move limits: bones that are in contact all over their bearing surface, and triangles that are too long.
std::vector<RangeNote> surface_notes(const Joint& joint, const motion::RangeOptions& range,
                                     const motion::BearingFinding& bearing);

}  // namespace condyle::answer
