#pragma once

#include "io/report/block_arrays.hpp"
#include "io/report/report.hpp"

namespace condyle::io {

/// The content of rom.json without the intervals of a map, which the page stores apart, and without folders unless `labels` keeps them.
/// Null without limits.
Json reported_rom(const RomResult* rom, const ReportLabels& labels);

/// The joint with which that of the page is compared: its limits, how far the page's are from them, and its bodies where they are not
/// the page's own to the bit.
Json before_json(const Report& report, BlockArrays& arrays);

}  // namespace condyle::io
