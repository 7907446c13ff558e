#pragma once

#include <vector>

#include "condyle/mesh.hpp"
#include "mesh/triangle_intersection.hpp"

namespace condyle::mesh {

/// Distance from a point to a closed triangle, mm. Double arithmetic, within about 1e-15 of the largest
/// coordinate; a triangle of zero area counts as its edges.
double distance_to_triangle(const Vec3& p, const TriangleCorners& t) noexcept;

/// Distance from any point to the nearest point of a mesh: the shortest way out by translation, in any
/// direction. A tree of boxes over the triangles, built once, O(n log n); a query looks at a few leaves.
class SurfaceDistance {
 public:
  /// The mesh must outlive this, and have a triangle.
  explicit SurfaceDistance(const TriMesh& mesh);

  double operator()(const Vec3& p) const noexcept;

 private:
  struct Node {
    Vec3 low, high;
    Index first, last;  ///< triangles, in order_
    Index right;        ///< of an inner node, whose left child follows it; no_index for a leaf
  };
  Index build(Index first, Index last, const std::vector<Vec3>& centres);

  const TriMesh* mesh_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

}  // namespace condyle::mesh
