#include "fuzz/brute_contact.hpp"

#include <algorithm>

#include "fuzz/fuzz_input.hpp"
#include "support/brute_force.hpp"

namespace condyle::test {

bool has_degenerate(const TriMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_degenerate(mesh, t)) return true;
  }
  return false;
}

bool surfaces_meet(const TriMesh& fixed, const TriMesh& mobile, const Pose& X) {
  const auto pairs = intersecting_pairs(fixed, posed(X, mobile));
  return std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
    return !is_degenerate(fixed, pair.first) && !is_degenerate(mobile, pair.second);
  });
}

bool corner_inside(const TriMesh& a, const Pose& X, const Mesh& b) {
  if (!b.is_closed()) return false;
  const TriMesh placed = posed(X, a);
  for (std::size_t t = 0; t < a.triangles.size(); ++t) {
    if (!is_degenerate(a, t) && winding_number(b, placed.corner(t, 0)).winding > 0) return true;
  }
  return false;
}

}  // namespace condyle::test
