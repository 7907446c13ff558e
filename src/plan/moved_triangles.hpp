#pragma once

#include <memory>
#include <span>
#include <vector>

#include "condyle/mesh.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::plan {

/// Two places of the vertices of a surface: where they were, and where they are to go.
struct Places {
  const Points& was;
  const Points& now;
};

/// Defects of triangles of a surface that moves a little. Defects from before the move do not count.
class MovedTriangles {
 public:
  explicit MovedTriangles(const Mesh& before);

  /// The triangles among these that have turned too far from their orientation before, and farther than they had.
  std::vector<Index> turned(std::span<const Index> moved, const Places& places) const;
  /// Triangles that run through another one, of which one at least moved, where the two did not before: both of each pair. Pairs with
  /// a common vertex are left to turned().
  std::vector<Index> crossing(std::span<const Index> moved, const Places& places) const;

 private:
  bool crosses_anew(Index triangle, Index other, const Places& places) const;

  Mesh before_;
  std::shared_ptr<const mesh::TriangleTree> tree_;
};

}  // namespace condyle::plan
