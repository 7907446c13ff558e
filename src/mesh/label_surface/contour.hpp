#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "condyle/control.hpp"
#include "condyle/mesh.hpp"
#include "mesh/label_surface/smoothed_field.hpp"

namespace condyle::mesh {

/// The surface between samples inside and outside, in the field's coordinates, wound outwards.
struct Contour {
  TriMesh mesh;
  std::vector<std::uint8_t> cap;  ///< Per triangle: 0, or 1 + 2 axis + (1 on the high side).
};

/// Where a sample inside and one outside are closer to the level than this share of their distance, the vertex is not:
/// it would make triangles almost without area. t of [0, 2 m] becomes m + t / 2, and 1 - t likewise: still in order.
inline constexpr double contour_margin = 1e-3;

/// Marching cubes (Lorensen and Cline 1987) whose ambiguous faces are settled by the asymptotic decider (Nielson and Hamann
/// 1991). Two cells at a face see the same four samples, so they agree, and every edge is in two triangles, every vertex in
/// one fan.
///
/// A cell's loop is cut into triangles from one of its vertices: a cone over a simple curve on the boundary of a convex
/// body, which does not meet itself. Where every vertex has a diagonal within a face of the cell, which the cell beyond
/// may have too, the cone is from the mean of the vertices. Loops of one cell do not meet: the decider joins two
/// corners exactly if the crossings of opposite sides of the face are in the order that the connection needs. We differ from
/// "marching cubes 33" (Chernyaev 1995) in that corners are never joined through the interior of a cell.
///
/// Between a cap's layer and that outside of it cells have no volume: their triangles are the convex polygons of marching
/// squares. Empty if it was stopped.
std::optional<Contour> contour_of(const SampledField& field, const std::stop_token& stop = {});

}  // namespace condyle::mesh
