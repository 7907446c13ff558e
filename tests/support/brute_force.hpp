#pragma once

#include <utility>
#include <vector>

#include "condyle/mesh.hpp"

/// The obvious versions: every pair, exact arithmetic throughout (integers of any size, which scaled doubles
/// are), no table, no filter, and none of the library's own predicates. Slow and plain on purpose: they are what the fast paths are held against.

namespace condyle::test {

/// Winding number of a closed mesh about p: signed crossings of a ray from p. The
/// ray's direction is tried until it meets no edge or vertex. Empty where p lies exactly on the surface.
struct BruteWinding {
  bool on_surface;
  int winding;
};
BruteWinding winding_number(const TriMesh& mesh, const Vec3& p);

/// Whether two closed triangles share a point, exactly; touching counts. A triangle without area meets nothing.
bool triangles_intersect(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

/// Every intersecting pair (triangle of a, triangle of b), sorted.
std::vector<std::pair<Index, Index>> intersecting_pairs(const TriMesh& a, const TriMesh& b);

}  // namespace condyle::test
