#pragma once

#include <span>
#include <string>

#include "io/mesh/vtk_array.hpp"

namespace condyle::io {

/// Undoes one compressed block, which has to fill `out`; false if it does not.
bool uncompress(Compressor compressor, const std::string& block, std::span<char> out);

}  // namespace condyle::io
