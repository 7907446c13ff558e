#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "condyle/pose.hpp"

namespace condyle::radial {

/// Corners of a triangle seen from the origin.
struct Cone {
  Vec3 a, b, c;
};

/// A cell of directions that a triangle is seen in, with the radius interval that the triangle takes inside
/// the cell. All conservative: no cell the cone meets is missing, no radius lies outside the interval.
struct CellOverlap {
  Index cell;
  double min_radius, max_radius;
};

/// Cells [first, end) of columns and rows, on the grid of d.z >= 0 and on that of d.z < 0, or on one of them.
struct CartesianBox {
  std::int16_t first_column, end_column, first_row, end_row;
  bool has_upper, has_lower;

  friend bool operator==(const CartesianBox&, const CartesianBox&) = default;
};

/// The paper's normalised Cartesian map: a direction d = v / |v| falls into cell (d.x, d.y) of an N x N grid
/// over [-1, 1]^2, one grid for d.z >= 0 and one for d.z < 0. Cells near the rim of the disc
/// span many directions and their lists are long: that is the map's weakness.
class CartesianMap {
 public:
  explicit CartesianMap(int cells_per_side) : n_(cells_per_side) { assert(n_ > 0); }

  Index cell_count() const noexcept { return static_cast<Index>(2 * n_ * n_); }

  /// Cell of the direction of v, which is not zero.
  Index cell_of(const Vec3& v) const noexcept {
    const double squared = (v.x() * v.x() + v.y() * v.y()) + v.z() * v.z();
    // Squares of what is tiny or huge leave the range of doubles.
    if (!(squared > 1e-280 && squared < 1e280)) return cell_of(v / v.cwiseAbs().maxCoeff());
    const double radius = std::sqrt(squared);
    const int i = column(v.x() / radius), j = column(v.y() / radius);
    return static_cast<Index>(((v.z() < 0 ? n_ : 0) + j) * n_ + i);
  }

  /// Cells that hold all that the cone of three unit vectors meets. With L the longest distance between them, a point q of their
  /// plane triangle has |q|^2 >= 1 - L^2 / 3 (see measure_triangles()), so that its direction is at most
  /// 1 - sqrt(1 - L^2 / 3) away from it: edges that bulge and a pole within the triangle are covered. From L^2 = 3 on
  /// the triangle may pass through the centre: all cells.
  CartesianBox box_of(const Vec3& a, const Vec3& b, const Vec3& c) const noexcept;

  /// Calls visit(cell) once for each cell of the box.
  void visit_cells(const CartesianBox& box, const auto& visit) const {
    const auto grid = [&](int first) {
      for (int row = box.first_row; row < box.end_row; ++row)
        for (int column = box.first_column; column < box.end_column; ++column)
          visit(static_cast<Index>((first + row) * n_ + column));
    };
    if (box.has_upper) grid(0);
    if (box.has_lower) grid(n_);
  }

 private:
  int column(double s) const noexcept {
    return std::clamp(static_cast<int>((s + 1) * (0.5 * n_)), 0, n_ - 1);
  }

  int n_;
};

/// Where a direction falls: its cell, and its place there as the axis part of its CellDop.
struct CellPlace {
  Index cell;
  std::uint32_t axis;
};

/// Six faces of a cube, N x N cells each. No square root on the way to a cell, and a triangle's cone is a
/// plane polygon on a face: filling the table is polygon clipping.
///
///        +---+           cell = (face * N + row) * N + column
///        | 2 |
///    +---+---+---+---+   faces +x +y +z -x -y -z
///    | 3 | 0 | ...       on face k: column from v[k+1] / |v[k]|, row from v[k+2] / |v[k]|
class CubeMap {
 public:
  explicit CubeMap(int cells_per_side) : n_(cells_per_side) { assert(n_ > 0); }

  int cells_per_side() const noexcept { return n_; }
  Index cell_count() const noexcept { return static_cast<Index>(6 * n_ * n_); }

  /// Cell of the direction of v, which is not zero.
  Index cell_of(const Vec3& v) const noexcept { return place_of(v).cell; }

  /// Calls visit(CellOverlap) once for each cell the cone meets.
  void visit_cells(const Cone& cone, const std::function<void(const CellOverlap&)>& visit) const;

  /// The cell of v, and where in its cell v, which is not zero, falls.
  CellPlace place_of(const Vec3& v) const noexcept;

 private:
  int column(double s) const noexcept {
    return std::clamp(static_cast<int>((s + 1) * (0.5 * n_)), 0, n_ - 1);
  }

  int n_;
};

/// Bound on the distance from the origin to a triangle: never more than the true one, and less only by
/// rounding.
double min_radius(const Cone& cone) noexcept;

}  // namespace condyle::radial
