#pragma once

#include <compare>
#include <vector>

#include "radial/radial_table.hpp"

namespace condyle {

/// A triangle of the fixed and one of the mobile body that share a point.
struct TrianglePair {
  Index fixed, mobile;
  friend auto operator<=>(const TrianglePair&, const TrianglePair&) = default;
};

/// The exact set of intersecting triangle pairs, ascending; touching counts, triangles of zero area meet
/// nothing. The mobile mesh is given in the table's frame, already posed. Works for open meshes too: nothing
/// here asks for an inside.
///
/// Candidates share a cell of directions and a radius interval there, then a bounding box; exact arithmetic
/// decides. `BodyPair::pairs` gives the same set and is faster by far; this one needs no more than the table.
std::vector<TrianglePair> intersecting_pairs(const RadialTable& fixed, const TriMesh& posed_mobile);

}  // namespace condyle
