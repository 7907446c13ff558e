#pragma once

#include <memory>

#include "radial/query/exact_query.hpp"
#include "radial/query/point_blocks.hpp"

namespace condyle::radial {

/// Scratch of the passes of a penetration query: 230 kB, and 300 kB more after an update, on the heap; a table keeps one between queries. The rest, on
/// the stack, stays below 16 kB, but for exact signs of coordinates that span more than 168 bits: these take some 30 kB more.
struct PenetrationScratch {
  NearPoints near;
  PointResults found;
  CrossingScratch crossing;
};

/// RadialTable::penetrations() of a closed mesh at one pose. `cube` is empty for a table on the paper's map.
void penetrations(const ExactView& table, const std::optional<CubeView>& cube, const PointBlocks& points,
                  const Pose& X_FM, PenetrationScratch& scratch, Penetrations& out, PenetrationWork* work);

}  // namespace condyle::radial
