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

/// What is wrong with triangles of a surface that moves a little from where it was before. What was wrong already is nobody's fault.
class MovedTriangles {
 public:
  explicit MovedTriangles(const Mesh& before);

  /// Of these triangles those that face too far away from how they lay before, and farther than they did.
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
