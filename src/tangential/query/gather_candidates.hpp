#pragma once

#include <cstddef>
#include <span>

#include "core/uninitialised.hpp"
#include "tangential/build/cell_box.hpp"
#include "tangential/build/ring_lists.hpp"

namespace condyle::tangential {

/// Circles and the triangles whose boxes hold them, one pair per slot: circle by circle.
struct CandidatePairs {
  core::UninitialisedVector<Index> triangle, circle;
};

/// Pairs of circles from number `first` on. Ends before a circle whose list might not fit, and returns how
/// many circles are done: one more at least.
std::size_t gather_candidates(const RingLists& lists, std::span<const CircleCell> circles, std::size_t first,
                              CandidatePairs& pairs);

}  // namespace condyle::tangential
