#pragma once

#include <string>

#include "io/result/rom_result.hpp"

namespace condyle::io {

/// What the words in the column of living hips mean, and as a whole which motions soft tissue ends first; empty if nothing is known.
std::string living_text(const RomResult& result, TextForm form);

}  // namespace condyle::io
