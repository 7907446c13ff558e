#pragma once

#include <cstddef>
#include <vector>

#include "condyle/tangential.hpp"
#include "tangential/query/circle_batch.hpp"

namespace condyle::tangential {

/// Writes the results of points [begin, end), whose crossings the batch has found.
void write_results(CircleBatch& batch, const Rings& rings, std::size_t begin, std::size_t end,
                   TangentialRule rule, TangentialResults& results);

/// Appends the arcs of the batch's points, and writes how many each of those has that have any to `counts`.
void append_arcs(CircleBatch& batch, std::size_t* counts, std::vector<OccupiedArc>& arcs);

}  // namespace condyle::tangential
