#pragma once

#include <string>

#include "io/report/report.hpp"

namespace condyle::io {

/// All that a page shows of a joint, in one block of bytes, little-endian:
///
///     "CONDYLE\0"   u32 version   u32 length of the JSON   JSON, blanks up to a multiple of 8   arrays
///
/// The JSON names the arrays, where each begins behind it (a multiple of 8) and of which type it is: docs/report-data.md.
std::string data_block(const Report& report);

}  // namespace condyle::io
