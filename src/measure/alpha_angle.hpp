#pragma once

#include <array>
#include <optional>
#include <string>

#include "measure/fit_circle.hpp"

namespace condyle::measure {

/// How far outside its circle a contour has left it, mm: real heads are 0.14 mm off their circle in a plane.
inline constexpr std::array alpha_tolerances_mm{0.5, 1.0};
/// The circle is that of the contour farther than this from the neck, degrees.
inline constexpr double circle_begins_deg = 75;
/// Contour farther than this from the head's centre is not the neck's, in radii of the head.
inline constexpr double neck_reach = 1.6;

struct AlphaPoint {
  double alpha_deg;
  Vec2 point;  ///< where the contour comes within the tolerance
  /// The largest angle below a right one at which the contour is outside again, as on a cam with a groove behind it.
  std::optional<double> outside_again_deg;
};

struct AlphaFinding {
  std::optional<AlphaPoint> alpha;
  std::string why_none;
};

/// The circle of a head in a plane of the neck's axis, from both sides of its section. x is along the neck, from the head's
/// centre. Walls of cavities in the bone are no part of it. Empty if too little of a circle is there.
std::optional<CircleFit> head_circle(const Contour& section, double head_radius);

/// The alpha angle on one side of the axis. Coming from the neck, the first angle at the circle's centre at which the
/// outermost contour is within the tolerance:
///
///       . - ~ .
///     /    .   \ _ alpha      rays at smaller angles meet contour farther out than the radius and the tolerance
///    (    o - - -) - - x
///
/// `half` is that side, y >= 0; `circle` is mirrored with it. Exact for the contour as it is: no steps of the angle.
AlphaFinding alpha_angle(const Contour& half, const Circle& circle, double head_radius, double tolerance_mm);

/// Whether the mesh ends within 0.3 to 1.6 head radii along the neck's axis and one of it.
bool neck_ends(const Contour& half, double head_radius);

/// The least distance of the bone's outside from the neck's axis between 0.3 and 1.6 head radii from the centre; empty if there is none.
std::optional<Vec2> narrowest_neck(const Contour& half, double head_radius);

}  // namespace condyle::measure
