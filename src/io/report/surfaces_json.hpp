#pragma once

#include "io/report/block_arrays.hpp"
#include "io/report/report.hpp"
#include "io/result/resection_result.hpp"

namespace condyle::io {

/// The triangles of the zones, of those motions that have one.
Json zones_json(const RomResult& rom, BlockArrays& arrays);

/// The surfaces that carry load, and how they answer an overlap.
Json layers_json(const ReportedLayers& layers, const Joint& joint, BlockArrays& arrays);

/// The plan of a page whose joint is the one without the bone: as resection.json has it, and of each cut bone the vertices that were
/// lowered, where they were and by how much.
Json plan_json(const ResectionResult& plan, BlockArrays& arrays);

}  // namespace condyle::io
