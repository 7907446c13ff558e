#pragma once

#include "io/report/block_arrays.hpp"
#include "io/report/report.hpp"

namespace condyle::io {

/// The triangles of the zones, of those motions that have one.
Json zones_json(const RomResult& rom, BlockArrays& arrays);

/// The surfaces that carry load, and how they answer an overlap.
Json layers_json(const ReportedLayers& layers, const Joint& joint, BlockArrays& arrays);

}  // namespace condyle::io
