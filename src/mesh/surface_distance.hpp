#pragma once

#include <cassert>

#include "condyle/mesh.hpp"
#include "mesh/triangle_intersection.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::mesh {

/// Distance from a point to a closed triangle, mm. Double arithmetic, within about 1e-15 of the largest
/// coordinate; a triangle of zero area counts as its edges.
double distance_to_triangle(const Vec3& p, const TriangleCorners& t) noexcept;

/// Distance from any point to the nearest point of a mesh, over a tree of its triangles, of which there is one: the shortest exit by
/// translation, in any direction. A query tests a few leaves.
double distance_to_surface(const TriangleTree& surface, const Vec3& p) noexcept;

/// The same with a tree of its own, built once.
class SurfaceDistance {
 public:
  /// The mesh must have a triangle.
  explicit SurfaceDistance(const TriMesh& mesh) : tree_(mesh) { assert(!tree_.empty()); }

  double operator()(const Vec3& p) const noexcept { return distance_to_surface(tree_, p); }

  const TriangleTree& tree() const noexcept { return tree_; }

 private:
  TriangleTree tree_;
};

}  // namespace condyle::mesh
