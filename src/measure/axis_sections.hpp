#pragma once

#include <Eigen/Core>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::measure {

/// Point of a plane through an axis: x along the axis from the centre, y away from it.
using Vec2 = Eigen::Vector2d;

/// Where such a plane cuts a triangle: going from `from` to `to`, the solid is on the left, with x to the right and y up.
struct ContourPiece {
  Vec2 from, to;
  bool from_end = false, to_end = false;  ///< whether the bone's mesh ends at that point
};
using Contour = std::vector<ContourPiece>;

/// Sections of a mesh by planes through one axis.
///
///        y  towards cos(turn) first + sin(turn) first x ... the direction at that turn
///        |
///   -----o-----> x  axis        One plane has two half-planes: that of y > 0, and its other side, at half a turn more.
///        |
class AxisSections {
 public:
  /// The axis and `zero`, the direction at turn 0, are unit and at a right angle, and so is `quarter`, that at a quarter turn:
  /// the sense of the turn is the caller's.
  ///
  /// An edge between two marked vertices is where the mesh ends; without marks it ends nowhere.
  AxisSections(const TriMesh& mesh, const Vec3& centre, const Vec3& axis, const Vec3& zero,
               const Vec3& quarter, std::vector<char> marks = {});

  /// The section by the plane at this turn (radians), both sides of the axis. A vertex in the plane counts as above
  /// it, so contours of closed meshes close.
  Contour at(double turn) const;

  Vec3 direction(double turn) const noexcept;
  /// A point of the plane at this turn, in the mesh's frame.
  Vec3 point(double turn, const Vec2& p) const noexcept;

 private:
  const std::vector<Triangle>& triangles_;
  std::vector<char> marks_;
  Vec3 centre_, axis_, zero_, quarter_;
  std::vector<double> along_, on_zero_, on_quarter_;  ///< coordinates of the vertices
  bool is_left_handed_;                               ///< axis, zero and quarter
};

/// The pieces on the side of y > 0, cut where they cross the axis; or those of y < 0, mirrored. The solid stays on the left.
Contour upper_half(const Contour& contour);
Contour lower_half(const Contour& contour);

/// Whether a piece faces away from the origin, as the outside of what lies around it does; a cavity's wall faces it.
bool faces_outwards(const ContourPiece& piece);
/// Likewise, away from the axis: for pieces of y >= 0.
bool faces_away_from_axis(const ContourPiece& piece);

/// The part of a piece within a circle about a point; empty if there is none.
bool clip_to_circle(ContourPiece& piece, const Vec2& centre, double radius);
/// The part with x between two values.
bool clip_to_range(ContourPiece& piece, double low, double high);

}  // namespace condyle::measure
