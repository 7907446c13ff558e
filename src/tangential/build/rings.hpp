#pragma once

#include <cstddef>

#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"
#include "condyle/tangential.hpp"
#include "core/uninitialised.hpp"
#include "mesh/triangle_intersection.hpp"
#include "tangential/build/free_directions.hpp"
#include "tangential/build/profile_boxes.hpp"
#include "tangential/build/ring_lists.hpp"
#include "tangential/exact/circle_crossing.hpp"

namespace condyle::tangential {

/// Data of a ring table. Everything is in the axis frame.
struct Rings {
  AxisFrame frame;
  core::UninitialisedVector<AxisVertex> vertices;
  core::UninitialisedVector<Triangle> triangles;
  double scale = 0;  ///< At least every |x|, |y| of the triangles, in mm.
  RingLists lists;
  FreeDirections free_directions;

  const ProfileGrid& grid() const noexcept { return lists.grid(); }
  TriangleRef corner_refs(Index triangle) const noexcept {
    const auto& [a, b, c] = triangles[triangle];
    return {&vertices[a].at, &vertices[b].at, &vertices[c].at};
  }
  mesh::TriangleCorners corners(Index triangle) const noexcept {
    const auto& [a, b, c] = triangles[triangle];
    return {vertices[a].at, vertices[b].at, vertices[c].at};
  }
};

/// Rings of a closed mesh, with about `cells` cells. Linear.
Rings build_rings(const TriMesh& mesh, const AxisFrame& frame, std::size_t cells);

RingTableSize size_of(const Rings& rings) noexcept;

}  // namespace condyle::tangential
