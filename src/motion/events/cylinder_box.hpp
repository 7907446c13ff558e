#pragma once

#include <algorithm>
#include <cmath>

#include "condyle/first_contact.hpp"
#include "motion/events/rotation_function.hpp"
#include "motion/events/wrapped_angle.hpp"

/// Bounds of a feature around the axis, in quantities that a rotation keeps or merely shifts.

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
/// the centre of a ball joint, head and socket are two shells apart in r that no box in (rho, z) separates.
///
/// All bounds include what rounding may have moved.
struct CylinderBox {
  double rho_lo, rho_hi;
  double z_lo, z_hi;
  double r_lo, r_hi;
  double theta;        ///< Start of the arc, within a rounding of [0, 2 pi).
  double theta_width;  ///< In [0, 2 pi]; 2 pi where the axis meets the feature.

  /// Whether the two can meet at some angle.
  bool overlaps_profile(const CylinderBox& b) const noexcept {
    return rho_lo <= b.rho_hi && b.rho_lo <= rho_hi && z_lo <= b.z_hi && b.z_lo <= z_hi && r_lo <= b.r_hi &&
           b.r_lo <= r_hi;
  }
};

/// Whether two arcs share a direction.
inline bool arcs_meet(const CylinderBox& a, const CylinderBox& b) noexcept {
  return wrapped(b.theta - a.theta) <= a.theta_width || wrapped(a.theta - b.theta) <= b.theta_width;
}

/// How far `behind` turns in the positive sense until it reaches `ahead`: 0 where their arcs meet.
///
///   behind.theta ===== )- - gap - -> ( ===== ahead
inline double gap_to(const CylinderBox& behind, const CylinderBox& ahead) noexcept {
  if (arcs_meet(behind, ahead)) return 0;
  return wrapped(wrapped(ahead.theta - behind.theta) - behind.theta_width);
}

/// Lower bound on the size of any rotation in the given sense that makes the two meet.
inline double gap_in_sense(const CylinderBox& rotating, const CylinderBox& stationary,
                           RotationSense sense) noexcept {
  return sense == RotationSense::positive ? gap_to(rotating, stationary) : gap_to(stationary, rotating);
}

/// A point's cylinder coordinates but for the height, and its distance from the origin.
struct CylinderPoint {
  double rho, theta, r;
};

CylinderPoint cylinder_point(const Triple<double>& p) noexcept;
CylinderBox box_of_vertex(const Triple<double>& p, const CylinderPoint& at) noexcept;
CylinderBox box_of_edge(const Triple<double>& a, const CylinderPoint& at_a, const Triple<double>& b,
                        const CylinderPoint& at_b) noexcept;
/// From its corners.
CylinderBox box_of_triangle(const Triple<double>& a, const CylinderPoint& at_a, const Triple<double>& b,
                            const CylinderPoint& at_b, const Triple<double>& c,
                            const CylinderPoint& at_c) noexcept;
/// Box of everything within `half` of the centre along each axis.
CylinderBox box_of_box(const Triple<double>& centre, const Triple<double>& half) noexcept;
/// Around both, its arc the shorter of the two that cover both.
CylinderBox hull(const CylinderBox& a, const CylinderBox& b) noexcept;

}  // namespace condyle::motion
