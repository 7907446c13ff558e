#pragma once

#include <string>

#include "io/result/rom_result.hpp"

namespace condyle::io {

/// Sources of the column of living hips: what soft tissue took off, and of whom the ranges are; empty if nothing is known.
std::string living_text(const RomResult& result);

}  // namespace condyle::io
