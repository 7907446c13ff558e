#pragma once

#include "io/report/block_arrays.hpp"
#include "io/report/report.hpp"

namespace condyle::io {

/// Whether a page can turn the parts of its joint: a plan's bone is cut where its parts are.
bool has_parts_to_turn(const Report& report) noexcept;

/// The parts of a joint with their parameters, and what the page moves by them: the bodies as given, where the drawn ones are others,
/// and what is known of their head and socket.
Json posed_json(const Report& report, BlockArrays& arrays);

}  // namespace condyle::io
