#pragma once

#include <algorithm>
#include <cmath>

#include "condyle/angle.hpp"
#include "motion/events/turn_function.hpp"

/// What a feature occupies around the axis, in terms that turning leaves alone or merely shifts.

namespace condyle::motion {

/// Bounds on a feature in the axis frame: distance from the axis, height along it and distance from the
/// frame's origin stay as they are when the feature turns by t; the arc of directions shifts by t.
///
///           ^ axis                        top view
///    z.hi --+----+----+                      . - ~ .     arc from `theta`
///           |    |feat|                    .  \feat/  .  over `theta_width`
///    z.lo --+----+----+                   .    \_ /    .
///           |  rho.lo rho.hi              .     o      .
///
/// The distance r from the origin follows from rho and z for a point but not for boxes: with the origin in
/// the centre of a ball joint, head and socket are two shells apart in r that no box in (rho, z) tells apart.
///
/// All bounds include what rounding may have moved.
struct CylinderBox {
  double rho_lo, rho_hi;
  double z_lo, z_hi;
  double r_lo, r_hi;
  double theta;        ///< Start of the arc, within a rounding of [0, 2 pi).
  double theta_width;  ///< In [0, 2 pi]; 2 pi where the axis passes through or touches the feature.

  /// Whether the two can touch at some angle.
  bool shares_profile(const CylinderBox& b) const noexcept {
    return rho_lo <= b.rho_hi && b.rho_lo <= rho_hi && z_lo <= b.z_hi && b.z_lo <= z_hi && r_lo <= b.r_hi &&
           b.r_lo <= r_hi;
  }
};

/// The angle in [0, 2 pi), for one less than a turn away from it.
inline double wrapped(double angle) noexcept {
  if (angle < 0) angle += two_pi;
  return angle >= two_pi ? angle - two_pi : angle;
}

/// Whether two arcs share a direction.
inline bool arcs_meet(const CylinderBox& a, const CylinderBox& b) noexcept {
  return wrapped(b.theta - a.theta) <= a.theta_width || wrapped(a.theta - b.theta) <= b.theta_width;
}

/// How far `ahead` is from the arc `behind` when that turns in the positive sense: 0 where they meet.
///
///   behind.theta ===== )- - gap - -> ( ===== ahead
inline double gap_to(const CylinderBox& behind, const CylinderBox& ahead) noexcept {
  if (arcs_meet(behind, ahead)) return 0;
  return wrapped(wrapped(ahead.theta - behind.theta) - behind.theta_width);
}

enum class TurnDirection : int { positive = 1, negative = -1 };

/// Lower bound on the size of any turn in the given direction that makes the two touch.
inline double gap_in_turn(const CylinderBox& turning, const CylinderBox& resting,
                          TurnDirection direction) noexcept {
  return direction == TurnDirection::positive ? gap_to(turning, resting) : gap_to(resting, turning);
}

/// A point's place around the axis.
struct CylinderPoint {
  double rho, theta, r;
};

/// Bounds on the distance from the origin of anything: what turning about any axis through it leaves alone.
struct DistanceRange {
  double lo, hi;
};

/// Of a triangle.
DistanceRange distance_range(const Triple<double>& a, const Triple<double>& b,
                             const Triple<double>& c) noexcept;

CylinderPoint cylinder_point(const Triple<double>& p) noexcept;
CylinderBox box_of_vertex(const Triple<double>& p, const CylinderPoint& at) noexcept;
CylinderBox box_of_edge(const Triple<double>& a, const CylinderPoint& at_a, const Triple<double>& b,
                        const CylinderPoint& at_b) noexcept;
/// From the boxes of its three edges and the place of its corners.
CylinderBox box_of_triangle(const Triple<double>& a, const CylinderPoint& at_a, const Triple<double>& b,
                            const CylinderPoint& at_b, const Triple<double>& c,
                            const CylinderPoint& at_c) noexcept;
/// Of everything within `half` of the centre along each axis.
CylinderBox box_of_box(const Triple<double>& centre, const Triple<double>& half) noexcept;
/// Around both, its arc the shorter of the two that cover both.
CylinderBox hull(const CylinderBox& a, const CylinderBox& b) noexcept;

}  // namespace condyle::motion
