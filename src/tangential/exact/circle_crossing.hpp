#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/pose.hpp"
#include "condyle/tangential.hpp"
#include "core/predicates.hpp"

/// Where the circle of a rotating point meets a triangle: docs/mathematics/04-tangential-method.md. Everything here is
/// in the axis frame.

namespace condyle::tangential {

/// Change of the solid at a point where a circle, walked counter-clockwise seen from +z, crosses its surface.
enum class Passage : signed char { leaves = -1, enters = 1 };

/// One crossing of a point's circle with a triangle.
struct CircleCrossing {
  /// Radians from the point, in [-pi, pi], not 0: positive ahead (counter-clockwise), negative behind.
  double angle;
  Passage passage;
  Index triangle;

  /// Counter-clockwise from the point, in (0, 2 pi].
  double ahead() const noexcept { return angle > 0 ? angle : angle + two_pi; }
  /// Clockwise from the point, in (0, 2 pi].
  double behind() const noexcept { return angle < 0 ? -angle : two_pi - angle; }

  /// Order in which the circle, walked counter-clockwise from the point, meets them.
  friend bool operator<(const CircleCrossing& a, const CircleCrossing& b) noexcept {
    if ((a.angle > 0) != (b.angle > 0)) return a.angle > 0;
    if (a.angle != b.angle) return a.angle < b.angle;
    if (a.passage != b.passage) return a.passage == Passage::enters;
    return a.triangle < b.triangle;
  }
};

/// The circle of a point about z, infinitely little smaller and lower than it is: a vertex at its height
/// counts as above it, an end exactly on it as outside, and the point itself is infinitely little ahead.
/// One shift for all triangles: around a closed mesh entries and exits then alternate along every cut, and
/// sum to zero.
struct Circle {
  Vec3 point;
  double squared_radius;
  /// At least every |x|, |y| of the triangles and of the point: bounds of rounding are in its units.
  double scale;

  Vec3 centre() const noexcept { return {0, 0, point.z()}; }
};

/// The circle of a point; `scale` of the triangles only.
Circle circle_through(const Vec3& point, double scale) noexcept;

/// A triangle whose corners are stored elsewhere.
using TriangleRef = std::array<const Vec3*, 3>;

/// The segment in which a triangle meets the plane at the circle's height, from p to q with the solid on its
/// left (seen from +z).
///
///          upper         upper
///            |             |          solid: beyond the page
///     -------p------------>q-------   z = h
///            |             |          outside: this side of it
///          lower         lower
///
/// Each end lies on an edge of the triangle, from `lower` (below the height) to `upper` (at it or above), and
/// is computed from lower to upper: both triangles at the edge get the same bits. Ends err by at most 12u
/// scale in x and in y: 5u of |upper - lower| <= 2 scale, and the last sum.
struct CircleCut {
  struct End {
    const Vec3 *lower, *upper;  ///< Corners of `triangle`.
    double x, y;
  };
  End p, q;
  TriangleRef triangle;
};

/// Appends the crossings of the circle with one triangle, in no order: none, one or two. Which ones there
/// are, and on which side of the point each lies, is exact for the doubles given. Angles err by at most e /
/// (rho sin g), with e = 17u scale the error of an end and g the angle at which circle and triangle meet; in
/// the worst case, touching, by sqrt(2 e / rho). At rho = scale that is some 1e-14 of a radian, and 1e-7 at a
/// touch.
void add_crossings(const Circle& circle, const TriangleRef& triangle, Index number,
                   std::vector<CircleCrossing>& out, TangentialWork& work);

/// How the ray from the point away from the axis, at its height, crosses this triangle: +1 where it leaves the
/// solid there, -1 where it enters, 0 if they do not meet. Summed over all
/// triangles: the winding number of the infinitely little shifted point, also where the point itself is on
/// the surface.
int outward_crossing(const Circle& circle, const TriangleRef& triangle, TangentialWork& work);

}  // namespace condyle::tangential
