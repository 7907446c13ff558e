#pragma once

#include <cassert>
#include <optional>

#include "condyle/mesh.hpp"
#include "mesh/node_discs.hpp"
#include "mesh/triangle_intersection.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::mesh {

/// Distance from a point to a closed triangle, mm. Double arithmetic, within about 1e-15 of the largest
/// coordinate; a triangle of zero area counts as its edges.
double distance_to_triangle(const Vec3& p, const TriangleCorners& t) noexcept;

/// Distance from any point to the nearest point of a mesh, over a tree of its triangles, of which there is one: the shortest exit by
/// translation, in any direction. A query tests a few leaves if the point is near; from a distance, more of a finer mesh.
double distance_to_surface(const TriangleTree& surface, const Vec3& p) noexcept;

/// The same for many points, wherever they are: a query tests a few leaves however distant the point and fine the mesh. Linear to make; of
/// fine meshes it has bounds beside those of the tree.
class DistancesToSurface {
 public:
  /// The tree must have a triangle, outlive this and keep its vertices.
  explicit DistancesToSurface(const TriangleTree& surface);

  /// `nearest` is no_index, or the place of a triangle that is near p, as the one nearest to the point before: it makes this faster
  /// and changes no distance. It becomes the place of a triangle that is nearest. Where a triangle is as near as `enough`, the distance to
  /// that one may be the answer.
  double operator()(const Vec3& p, Index& nearest, double enough = 0) const noexcept;

 private:
  const TriangleTree& surface_;
  std::optional<NodeDiscs> discs_;
};

/// distance_to_surface() with a tree of its own, built once.
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
