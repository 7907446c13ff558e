#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "condyle/pose.hpp"
#include "radial/build/cell_row.hpp"
#include "radial/build/edge_functions.hpp"
#include "radial/exact/cell_dop.hpp"

/// The work of building a cube table for every vertex and every triangle, compiled for every instruction set and
/// chosen at run time.

namespace condyle::radial {

using simd::greatest_radius_code, simd::IntervalScale, simd::no_radii, simd::packed_interval;

/// A vertex projected on the cube: u, w, u + w and u - w on its face.
struct alignas(16) FacePoint {
  float at[4];

  float u() const noexcept { return at[0]; }
  float w() const noexcept { return at[1]; }
};

/// A triangle's plane, lane 3 of its EdgeFunctions, and its radii, in one place: what is read again for every
/// cell that it is in.
struct alignas(16) TrianglePlane {
  float n[3];
  PackedInterval radii;
};

inline TrianglePlane plane_of(const EdgeFunctions& forms) noexcept {
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
struct SlackRectangle {
  float low_u, low_w, high_u, high_w;

  /// Least and greatest u, w, u + w and u - w.
  FacePoint lowest() const noexcept { return {{low_u, low_w, low_u + low_w, low_u - high_w}}; }
  FacePoint highest() const noexcept { return {{high_u, high_w, high_u + high_w, high_u - low_w}}; }
};

/// Where each vertex may be on the cube: its face, and its place there or, where there is slack, its slack rectangle.
struct PlacedVertices {
  const std::uint8_t* face;
  const FacePoint* place;
  const SlackRectangle* slack;

  FacePoint lowest(std::size_t vertex) const noexcept {
    return slack == nullptr ? place[vertex] : slack[vertex].lowest();
  }
  FacePoint highest(std::size_t vertex) const noexcept {
    return slack == nullptr ? place[vertex] : slack[vertex].highest();
  }
};

/// A triangle in one cell, before it is sorted into that cell's list.
struct CellEntry {
  std::uint32_t cell, triangle;
  CellDop dop;
};

/// Entries that are being made: capacity for them, and their number in each cell.
struct Binning {
  int cells_per_side;
  CellEntry* entry;
  std::size_t count, capacity;
  std::uint32_t* length;     ///< for each cell, and four unused ones for cells that a triangle does not meet
  std::uint32_t* elsewhere;  ///< triangles not binned here: on several faces, or larger than two cells
  std::size_t elsewhere_count;
};

/// One coordinate of a triangle's corners on a face, and how far each may be from that.
struct alignas(16) FaceCorners {
  float at[3], slack;
};

/// Triangles projected on faces, off them too: corners within four times the face's size. Arrays have
/// binning_padding more.
struct ProjectedTriangles {
  const FaceCorners *u, *w;
  const std::uint32_t* triangle;
  const std::int32_t* face;
  std::size_t count;
};

/// Entries that binning may write beyond those it makes, and projected triangles that it may read.
inline constexpr std::size_t binning_padding = 16;

/// Entries, and what is known of their triangles.
struct RadiiView {
  int cells_per_side;
  const std::uint32_t* triangle;
  const TrianglePlane* plane;
  IntervalScale scale;           ///< of the planes' radii
  const float* inverse_length;   ///< see CellCorners
  float cosine;                  ///< of the angle between the middle of a cell and its corners, at most
  PackedInterval of_every_cell;  ///< what all cells have: no_radii, or those of the centre
  std::uint8_t* nearest;         ///< written for each entry, see CellLists
  PackedInterval* entry_radii;   ///< the same; null if they are not kept
};

/// Triangles that have changed: their numbers and planes, and for each cell where entries have changed, the
/// places here of those that are in it now.
///
///   entry      | 0 4 7 |     | 4 8 |  ...      cells[i] has [first[i], first[i + 1])
struct ChangedTriangles {
  std::span<const std::uint32_t> number;
  std::span<const TrianglePlane> plane;
  std::span<const std::uint32_t> cells, first, entry;

  std::span<const std::uint32_t> in_cell(std::size_t i) const noexcept {
    return entry.subspan(first[i], first[i + 1] - first[i]);
  }
};

/// New values of an entry: radii of its triangle in its cell, and the nearest one, see CellLists.
struct ChangedEntry {
  std::uint32_t triangle;
  PackedInterval radii;
  std::int32_t nearest;
};

/// Squared radii of a surface; infinity and 0 if there is none.
struct SurfaceRadii {
  float least, greatest;
};

/// Faces (0 to 5) and places of all vertices.
void place_vertices(const MeshView& mesh, std::uint8_t* face, FacePoint* out);

/// Vertices that are not in their slack, in ascending order; `out` has capacity for all. The face is that of the
/// rectangle, and places are rounded as place_vertices() does.
std::size_t find_left_slack(const MeshView& mesh, const std::uint8_t* face, const SlackRectangle* slack,
                            std::uint32_t* out);

/// Forms of triangles [first, last), each at its own number; adds those whose forms are no numbers
/// to `uncertain`.
///
/// No point of a triangle is nearer than the vertices are by more than its edges say: for p = sum l_i v_i,
/// |p|^2 = sum l_i |v_i|^2 - sum l_i l_j |v_i - v_j|^2, and the last sum is at most L^2 / 3, L the longest
/// edge.
void measure_triangles(const MeshView& mesh, std::size_t first, std::size_t last, const IntervalScale& scale,
                       EdgeFunctions* forms, std::vector<std::uint32_t>& uncertain);

/// Bins those triangles of [first, last) that lie within one face, off its edges, and in at most 2 x 2
/// cells. At most four entries for each.
void bin_small_triangles(const MeshView& mesh, const PlacedVertices& vertices, std::size_t first,
                         std::size_t last, Binning& binning);

/// Bins triangles projected on faces, from the given one on, in the cells that they meet: those of their 8-DOP,
/// but for cells beyond one of their edges. Returns the first one that is not binned: there is one where
/// `binning` has no capacity for all cells that it may meet, and binning_padding.
std::size_t bin_projected_triangles(const ProjectedTriangles& projected, std::size_t first, Binning& binning);

/// Radii of the surface in each cell: of each of its triangles those of its plane within the cell, or those of
/// the triangle where they are closer. Returns those of all cells.
///
/// In unit direction d a plane has the radius 1 / (n . d), n its form. d is a sum of the cell's corner
/// directions with weights >= 0, whose sum is at least 1 and at most 1 / cosine: so n . d lies between the
/// least n . corner, if that is positive, and the greatest over the cosine. 2^-14 |n| covers the widening and
/// the floats. A triangle whose plane and corners have no radius in common there is not in the cell.
SurfaceRadii measure_rows(const RadiiView& lists, std::span<const CellRow> rows, PackedInterval* out);

/// The same for cells of which single triangles have changed; all others have their entry_radii. Adds those
/// of the changed ones to `surface`. Writes the cells whose radii are others than before to `changed`, which
/// has capacity for all; returns how many. `scratch` has an element for each entry.
std::size_t measure_changed(const RadiiView& lists, const CellRow* rows, const ChangedTriangles& triangles,
                            ChangedEntry* scratch, PackedInterval* radii, SurfaceRadii& surface,
                            Index* changed);

}  // namespace condyle::radial
