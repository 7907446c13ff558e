#include "sphere_raster.hpp"

#include <array>
#include <cmath>

namespace bench {
namespace {

using condyle::Index;
using condyle::Vec3;

/// One face of the cube: the plane `axis` = `sign`, over which the two other coordinates, in turn, go from -1
/// to 1.
struct Face {
  int axis;
  double sign;
  int cells_per_side;
  Index first_cell;

  double middle(int step) const noexcept { return (step + 0.5) * (2.0 / cells_per_side) - 1; }
  Vec3 direction(int column, int row) const noexcept {
    Vec3 v;
    v[axis] = sign, v[(axis + 1) % 3] = middle(column), v[(axis + 2) % 3] = middle(row);
    return v;
  }
  Index cell(int column, int row) const noexcept {
    return first_cell + static_cast<Index>(row * cells_per_side + column);
  }
};

struct CellRange {
  int first, last;
};

/// A triangle with what its crossings need: the normals of the planes through the origin and its edges.
struct SeenTriangle {
  SeenTriangle(Index triangle, const condyle::Triangle& corners, condyle::PointsView vertices)
      : number(triangle), v(corners), p{vertices[v[0]], vertices[v[1]], vertices[v[2]]} {
    for (int k = 0; k < 3; ++k) edge_normal[k] = p[k].cross(p[(k + 1) % 3]);
    volume = p[0].dot(edge_normal[1]);
  }

  /// The ray crosses where it lies on one side of all three edges, the side that the volume's sign gives;
  /// docs/mathematics/02-direction-table.md.
  void cross(const Vec3& direction, Index cell, LayeredImage& out) const {
    const bool leaves = volume > 0;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double side = direction.dot(edge_normal[k]);
      if (is_left(side, {edge_normal[k].x(), edge_normal[k].y(), edge_normal[k].z()}) != leaves) return;
      sum += side;
    }
    if (sum == 0) return;
    out.add(cell, {static_cast<float>(volume / sum * direction.norm()), leaves ? -1 : 1, number});
  }

  Index number;
  condyle::Triangle v;
  std::array<Vec3, 3> p, edge_normal;
  double volume;  ///< six times that of the tetrahedron with the origin
};

/// Columns (or rows, by `across`) whose middles the triangle may cover. All of them where it reaches behind
/// the face's plane through the origin, which only triangles that are large or close to the origin do.
CellRange covered(const SeenTriangle& t, const Face& face, int across) {
  double low = 1, high = -1;
  for (const Vec3& p : t.p) {
    const double forwards = face.sign * p[face.axis];
    if (forwards <= 0) return {0, face.cells_per_side - 1};
    low = std::min(low, p[across] / forwards), high = std::max(high, p[across] / forwards);
  }
  const auto steps = [&](double s) { return (s + 1) * (0.5 * face.cells_per_side) - 0.5; };
  // A cell more on each side than rounding could take.
  return {std::max(0, static_cast<int>(std::ceil(steps(low) - 1e-9))),
          std::min(face.cells_per_side - 1, static_cast<int>(std::floor(steps(high) + 1e-9)))};
}

/// Whether all corners lie beyond one side of the face's frustum.
bool is_beside(const SeenTriangle& t, const Face& face) noexcept {
  for (const int across : {(face.axis + 1) % 3, (face.axis + 2) % 3}) {
    int above = 0, below = 0;
    for (const Vec3& p : t.p) {
      const double forwards = face.sign * p[face.axis];
      above += p[across] > forwards, below += -p[across] > forwards;
    }
    if (above == 3 || below == 3) return true;
  }
  return false;
}

}  // namespace

void draw_on_sphere(condyle::PointsView vertices, std::span<const condyle::Triangle> triangles,
                    int cells_per_side, LayeredImage& out) {
  const Index face_cells = static_cast<Index>(cells_per_side * cells_per_side);
  out.clear(6 * face_cells);
  for (Index t = 0; t < triangles.size(); ++t) {
    const SeenTriangle triangle(t, triangles[t], vertices);
    for (int f = 0; f < 6; ++f) {
      const Face face{f % 3, f < 3 ? 1.0 : -1.0, cells_per_side, static_cast<Index>(f) * face_cells};
      if (is_beside(triangle, face)) continue;
      const CellRange columns = covered(triangle, face, (face.axis + 1) % 3);
      const CellRange rows = covered(triangle, face, (face.axis + 2) % 3);
      for (int row = rows.first; row <= rows.last; ++row) {
        for (int column = columns.first; column <= columns.last; ++column)
          triangle.cross(face.direction(column, row), face.cell(column, row), out);
      }
    }
  }
  out.sort();
}

}  // namespace bench
