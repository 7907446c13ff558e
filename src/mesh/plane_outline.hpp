#pragma once

#include <optional>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Triangles that fill outlines in a plane, with the vertices of the outlines and no others.
///
///      ___________
///     |   ____    |      Edges run counter-clockwise as seen from where the normal points, those of a hole
///     |  |____|   |      clockwise: what is to be filled lies on their left. Several outlines, holes in them
///     |___________|      and outlines in holes are filled; they may meet in vertices.
///
/// Triangles look along the normal. Decided exactly for the coordinates as seen along the axis nearest to the normal, in which no two triangles
/// overlap. Empty if the outlines are not closed or cross each other. Vertices that lie off the plane by rounding do no harm. Square in the number
/// of edges.
std::optional<std::vector<Triangle>> filled_outline(const Points& vertices,
                                                    const std::vector<DirectedEdge>& edges,
                                                    const Vec3& normal);

}  // namespace condyle::mesh
