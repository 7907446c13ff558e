#pragma once

#include <vector>

#include "condyle/radial.hpp"
#include "radial/query/candidates.hpp"

namespace condyle::radial {

/// Data from which a point's exact answer is computed.
struct ExactView {
  const TriMesh& mesh;
  const DirectionMap& map;
  const CellEntries& entries;
  int winding_at_centre;
  const EdgeFunctions* edge_functions;  ///< of each triangle; null if the table has none
};

/// Points decided together: their candidates stay in the nearest caches.
inline constexpr std::size_t points_per_gathering = 64;

/// RadialTable::query() of a closed mesh.
void query(const ExactView& table, PointsView points, RadialResults& out);
std::vector<double> radial_gaps(const ExactView& table, PointsView points);

}  // namespace condyle::radial
