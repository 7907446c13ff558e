#pragma once

#include "radial/build/cell_entries.hpp"
#include "radial/build/cube_passes.hpp"

/// A table on a cube map: its parts, each with a life of its own.
///
///   part            made                              changed by
///   CellEntries     with the table                    vertices that leave their slack
///   TriangleForms   with the table                    every update
///   VertexSlack     by the first update               vertices that leave it
///   CellRadii       by the first penetration query    updates of some vertices; out of date after others

namespace condyle::radial {

/// Measured quantities of each triangle.
struct TriangleForms {
  IntervalScale scale;
  core::UninitialisedVector<EdgeFunctions> edge_functions;
  core::UninitialisedVector<Vec3> corner;  ///< the mesh's vertices again, each in one place
  std::vector<std::uint32_t> uncertain;    ///< triangles whose forms were no numbers when all were measured

  std::size_t bytes() const noexcept {
    return edge_functions.size() * sizeof(EdgeFunctions) + corner.size() * sizeof(Vec3);
  }
};

/// Where each vertex may be without its triangles being binned again.
struct VertexSlack {
  core::UninitialisedVector<std::uint8_t> face;
  core::UninitialisedVector<SlackRectangle> rectangle;

  bool empty() const noexcept { return rectangle.empty(); }
  std::size_t bytes() const noexcept { return face.size() + rectangle.size() * sizeof(SlackRectangle); }
};

struct CubeTable {
  CellEntries entries;
  TriangleForms forms;
  VertexSlack slack;
  bool has_clipped = false;  ///< Some triangles are binned where they are, whatever the slack.
};

/// Rows with 8-DOPs and forms of all triangles: one that is small against a cell, on one face, is binned by
/// its 8-DOP on the face. Without slack.
///
/// Conservative in every step: triangles are widened by list_margin.
void build(const TriMesh& mesh, const CubeMap& map, CubeTable& table);

/// Steps of that: rows and 8-DOPs, for vertices where they are;
void build_rows(const TriMesh& mesh, const CubeMap& map, CubeTable& table);
/// rows and 8-DOPs of all triangles, for vertices anywhere between their places;
void bin_all(const TriMesh& mesh, const CubeMap& map, const PlacedVertices& placed, CubeTable& table);
/// where vertices are;
void place_corners(const TriMesh& mesh, TriangleForms& forms);
/// the scale of their radii, and the forms of all triangles. Others may read the corners meanwhile.
void measure(const TriMesh& mesh, TriangleForms& forms);

}  // namespace condyle::radial
