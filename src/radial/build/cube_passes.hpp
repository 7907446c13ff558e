#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "radial/query/cube_view.hpp"

/// What building a cube table does for every vertex and every triangle, compiled for every instruction set
/// and chosen at run time.

namespace condyle::radial {

/// A vertex seen on the cube: u, w, u + w and u - w on its face.
struct alignas(16) FacePoint {
  float at[4];

  float u() const noexcept { return at[0]; }
  float w() const noexcept { return at[1]; }
};

/// A triangle's plane, lane 3 of its ConeForms, and its radii, in one place: what is read again for every
/// cell that it is in.
struct alignas(16) TrianglePlane {
  float n[3];
  RadiusWord radii;
};

inline TrianglePlane plane_of(const ConeForms& forms) noexcept {
  return {{forms.x[3], forms.y[3], forms.z[3]}, forms.radii};
}

struct MeshView {
  const double *x, *y, *z;
  const double* xyz;  ///< the same, three for each vertex: one line of the cache, where x, y, z are three
  std::size_t vertices;
  const std::uint32_t* corner;  ///< three for each triangle
  std::size_t triangles;
};

/// Where a vertex may be on its face.
struct FaceRoom {
  float low_u, low_w, high_u, high_w;

  /// Least and greatest u, w, u + w and u - w.
  FacePoint lowest() const noexcept { return {{low_u, low_w, low_u + low_w, low_u - high_w}}; }
  FacePoint highest() const noexcept { return {{high_u, high_w, high_u + high_w, high_u - low_w}}; }
};

/// Where each vertex may be on the cube: its face, and its place there or, where there are rooms, its room.
struct PlacedVertices {
  const std::uint8_t* face;
  const FacePoint* place;
  const FaceRoom* room;

  FacePoint lowest(std::size_t vertex) const noexcept {
    return room == nullptr ? place[vertex] : room[vertex].lowest();
  }
  FacePoint highest(std::size_t vertex) const noexcept {
    return room == nullptr ? place[vertex] : room[vertex].highest();
  }
};

/// A triangle in one cell, before it is sorted into that cell's list.
struct ListedTriangle {
  std::uint32_t cell, triangle;
  CellOctagon octagon;
};

/// Lists that are being made: room for the entries, and their number in each cell.
struct Listing {
  int cells_per_side;
  ListedTriangle* entry;
  std::size_t count, room;
  std::uint32_t* length;     ///< for each cell, and four spare ones for cells that a triangle does not meet
  std::uint32_t* elsewhere;  ///< triangles not listed here: on several faces, or larger than two cells
  std::size_t elsewhere_count;
};

/// One coordinate of a triangle's corners on a face, and how far each may be from that.
struct alignas(16) FaceCorners {
  float at[3], slack;
};

/// Triangles seen on faces, off them too: corners within four times the face's size. Arrays have
/// listing_room more.
struct SeenTriangles {
  const FaceCorners *u, *w;
  const std::uint32_t* triangle;
  const std::int32_t* face;
  std::size_t count;
};

/// Entries that listing may write beyond those it makes, and triangles seen that it may read.
inline constexpr std::size_t listing_room = 16;

/// Lists, and what is known of the triangles in them.
struct ListedRadii {
  int cells_per_side;
  const std::uint32_t* triangle;
  const TrianglePlane* plane;
  RadiusScale scale;            ///< of the planes' radii
  const float* inverse_length;  ///< see CellCorners
  float cosine;                 ///< of the angle between the middle of a cell and its corners, at most
  RadiusWord of_every_cell;     ///< what all cells have: no_radii, or those of the centre
  std::uint8_t* nearest;        ///< written for each entry, see CellLists
  RadiusWord* entry_radii;      ///< the same; null where they are not kept
};

/// Triangles that have changed: their numbers and planes, and for each cell where entries have changed, the
/// places here of those that are listed in it now.
///
///   listed     | 0 4 7 |     | 4 8 |  ...      cells[i] has [first[i], first[i + 1])
struct TouchedTriangles {
  std::span<const std::uint32_t> number;
  std::span<const TrianglePlane> plane;
  std::span<const std::uint32_t> cells, first, listed;

  std::span<const std::uint32_t> listed_in(std::size_t i) const noexcept {
    return listed.subspan(first[i], first[i + 1] - first[i]);
  }
};

/// What is new of an entry: radii of its triangle in its cell, and the nearest one, see CellLists.
struct ChangedEntry {
  std::uint32_t triangle;
  RadiusWord radii;
  std::int32_t nearest;
};

/// Squared radii of a surface; infinity and 0 where there is none.
struct SurfaceRadii {
  float least, greatest;
};

/// Faces (0 to 5) and places of all vertices.
void place_vertices(const MeshView& mesh, std::uint8_t* face, FacePoint* out);

/// Vertices that are not in their rooms, in ascending order; `out` has room for all. The face is that of the
/// room, and places are rounded as place_vertices() does.
std::size_t find_strayed(const MeshView& mesh, const std::uint8_t* face, const FaceRoom* room,
                         std::uint32_t* out);

/// Forms and planes of triangles [first, last), each at its own number; adds those whose forms are no numbers
/// to `unknown`.
///
/// No point of a triangle is nearer than the vertices are by more than its edges say: for p = sum l_i v_i,
/// |p|^2 = sum l_i |v_i|^2 - sum l_i l_j |v_i - v_j|^2, and the last sum is at most L^2 / 3, L the longest
/// edge.
void measure_triangles(const MeshView& mesh, std::size_t first, std::size_t last, const RadiusScale& scale,
                       ConeForms* forms, TrianglePlane* planes, std::vector<std::uint32_t>& unknown);

/// Lists those triangles of [first, last) that lie within one face, off its edges, and in at most 2 x 2
/// cells. At most four entries for each.
void list_small_triangles(const MeshView& mesh, const PlacedVertices& vertices, std::size_t first,
                          std::size_t last, Listing& listing);

/// Lists triangles seen on faces, from the given one on, in the cells that they meet: those of their octagon,
/// but for cells beyond one of their edges. Returns the first one that is not listed: there is one where
/// `listing` has not room for all cells that it may meet, and listing_room.
std::size_t list_seen_triangles(const SeenTriangles& seen, std::size_t first, Listing& listing);

/// Radii of the surface in each cell: of each listed triangle those of its plane within the cell, or those of
/// the triangle where they are closer. Returns those of all cells.
///
/// In unit direction d a plane has the radius 1 / (n . d), n its form. d is a sum of the cell's corner
/// directions with weights >= 0, whose sum is at least 1 and at most 1 / cosine: so n . d lies between the
/// least n . corner, if that is positive, and the greatest over the cosine. 2^-14 |n| covers the widening and
/// the floats. A triangle whose plane and corners have no radius in common there is not in the cell.
SurfaceRadii measure_rows(const ListedRadii& lists, std::span<const CellRow> rows, RadiusWord* out);

/// The same for cells of which single triangles have changed; all others have their entry_radii. Adds those
/// of the changed ones to `surface`. Writes the cells whose radii are others than before to `changed`, which
/// has room for all; returns how many. `room` is for what is listed.
std::size_t measure_touched(const ListedRadii& lists, const CellRow* rows, const TouchedTriangles& touched,
                            ChangedEntry* room, RadiusWord* radii, SurfaceRadii& surface, Index* changed);

}  // namespace condyle::radial
