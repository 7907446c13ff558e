#pragma once

#include <cstddef>
#include <cstdint>

#include "condyle/radial/cube_view.hpp"

/// What building a cube table does for every vertex and every triangle, compiled for every instruction set
/// and chosen at run time.

namespace condyle {

/// A vertex seen on the cube: u, w, u + w and u - w on its face.
struct alignas(16) FacePoint {
  float at[4];

  float u() const noexcept { return at[0]; }
  float w() const noexcept { return at[1]; }
};

/// Bounds of a triangle's squared radii, rounded outwards by list_margin, and its longest edge squared.
struct TriangleRadii {
  float least, greatest, longest_edge;
};

struct MeshView {
  const double *x, *y, *z;
  const double* xyz;  ///< the same, three for each vertex: one line of the cache, where x, y, z are three
  std::size_t vertices;
  const std::uint32_t* corner;  ///< three for each triangle
  std::size_t triangles;
};

/// A triangle in one cell, before it is sorted into that cell's list.
struct ListedTriangle {
  std::uint32_t cell, triangle;
  CellOctagon octagon;
};

/// Lists that are being made: room for the entries, and what is gathered for each cell.
struct Listing {
  int cells_per_side;
  ListedTriangle* entry;
  std::size_t count;
  // For each cell, and four spare ones for cells that a triangle turns out not to meet.
  std::uint32_t* length;     ///< number of entries
  float *least, *greatest;   ///< squared radii
  std::uint32_t* elsewhere;  ///< triangles not listed here: on several faces, or larger than two cells
  std::size_t elsewhere_count;
};

/// Faces (0 to 5) and places of all vertices.
void place_vertices(const MeshView& mesh, std::uint8_t* face, FacePoint* out);

/// Forms and radii of triangles [first, last).
///
/// No point of a triangle is nearer than the vertices are by more than its edges say: for p = sum l_i v_i,
/// |p|^2 = sum l_i |v_i|^2 - sum l_i l_j |v_i - v_j|^2, and the last sum is at most L^2 / 3, L the longest
/// edge.
void measure_triangles(const MeshView& mesh, std::size_t first, std::size_t last, ConeForms* forms,
                       TriangleRadii* radii);

/// Lists those triangles of [first, last) that lie within one face, off its edges, and in at most 2 x 2
/// cells; `radii` starts at the first one. At most four entries for each.
void list_small_triangles(const MeshView& mesh, const std::uint8_t* face, const FacePoint* vertices,
                          std::size_t first, std::size_t last, const TriangleRadii* radii, Listing& listing);

}  // namespace condyle
