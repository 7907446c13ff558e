#pragma once

#include <span>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::contact {

/// A mesh some or all of whose vertices have moved.
struct MovedVertices {
  Mesh mesh;                    ///< as it is now
  std::span<const Index> some;  ///< their numbers, if not all have moved
  PointsView positions;         ///< of those, or of all
  std::vector<char> is_moved;   ///< one mark for each vertex; empty if all have moved

  bool are_all() const noexcept { return is_moved.empty(); }
};

/// UsageError unless there is a position for each vertex; MeshError as Mesh::moved_to(). Positions are borrowed.
MovedVertices moved_vertices(const Mesh& before, PointsView vertices);
/// UsageError if numbers and positions are not as many, or a number is no vertex's or is there twice.
MovedVertices moved_vertices(const Mesh& before, std::span<const Index> moved, PointsView positions);

}  // namespace condyle::contact
