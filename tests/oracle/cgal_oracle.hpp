#pragma once

#include <memory>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

namespace condyle::test {

/// The triangles in another order, neighbours in space beside each other: an oracle is asked faster for whether
/// it meets them.
TriMesh in_spatial_order(const TriMesh& mesh);

/// CGAL with exact predicates, asked the same questions: an oracle that shares no code with the library.
class CgalOracle {
 public:
  explicit CgalOracle(const TriMesh& mesh);
  ~CgalOracle();
  CgalOracle(CgalOracle&&) noexcept;

  /// Side of each point by the parity of a ray's crossings. Parity and winding number differ where a mesh
  /// overlaps itself.
  std::vector<PointState> states(PointsView points) const;

  /// Pairs (triangle of this mesh, triangle of the other) that share a point, ascending.
  std::vector<contact::TrianglePair> pairs(const TriMesh& other) const;

  /// Whether there is such a pair.
  bool meets(const TriMesh& other) const;

  /// Smallest distance from a point to the surface, mm.
  double min_distance(PointsView points) const;

  /// Smallest distance of the two surfaces, mm; 0 if they meet.
  double surface_distance(const TriMesh& other) const;

  /// From each point to the surface, mm.
  std::vector<double> distances(PointsView points) const;

 private:
  struct Trees;
  std::unique_ptr<Trees> trees_;
};

}  // namespace condyle::test
