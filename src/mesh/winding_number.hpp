#pragma once

#include <vector>

#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

namespace condyle::mesh {

/// Where a point stands to a closed surface.
struct PointWinding {
  PointState state = PointState::outside;
  int winding = 0;            ///< How often the surface goes round the point; 0 on the surface.
  Index triangle = no_index;  ///< One that holds the point, where it is on the surface.

  friend bool operator==(const PointWinding&, const PointWinding&) = default;
};

/// Exact winding number of any point about a closed mesh: nested and overlapping components count together, a
/// mesh of inverted orientation counts negative, self-intersections do no harm.
///
/// The ray from the point along +z leaves the solid where it crosses a triangle whose normal points up and
/// enters it where the normal points down: w = (up) - (down). Every decision is an orientation predicate,
/// exact for the doubles given. A ray through an edge or a vertex is decided as that of p + e x + e^2 y for
/// an infinitely small e > 0: one shift for all triangles, so neighbours never disagree, and a vertical
/// triangle is never crossed.
///
/// Triangles are found over a uniform grid of (x, y):
///   offset_     0     2  2        5  ...      one entry per cell, plus one
///   triangle_  | a b |  | c d e |    ...      cell i owns [offset_[i], offset_[i+1])
/// A cell lists the triangles whose bounding rectangle meets it: exact without margins, since cell numbers
/// never decrease along x and y; long thin slanting triangles are listed in more cells than they cross.
class WindingNumber {
 public:
  /// MeshError if the mesh is not closed, naming an edge: without an inside there is no answer.
  explicit WindingNumber(Mesh mesh);

  PointWinding at(const Vec3& p) const noexcept;

  /// Many points at once, in parallel.
  void at(PointsView points, std::vector<PointWinding>& out) const;
  std::vector<PointWinding> at(PointsView points) const;

  const Mesh& mesh() const noexcept { return mesh_; }
  std::size_t bytes() const noexcept;

 private:
  Index column_at(double x) const noexcept { return clamped((x - low_.x()) / cell_.x(), columns_); }
  Index row_at(double y) const noexcept { return clamped((y - low_.y()) / cell_.y(), rows_); }
  static Index clamped(double steps, Index count) noexcept {
    return steps <= 0 ? 0 : steps >= count ? count - 1 : static_cast<Index>(steps);
  }
  template <class Visit>
  void for_each_cell(std::size_t triangle, const Visit& visit) const;

  Mesh mesh_;
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();  ///< Bounds of the triangles.
  Eigen::Vector2d cell_ = Eigen::Vector2d::Ones();
  Index columns_ = 1, rows_ = 1;
  std::vector<Index> offset_, triangle_;
};

}  // namespace condyle::mesh
