#pragma once

#include <array>

#include "condyle/angle.hpp"
#include "sample/femur_shape.hpp"
#include "sample/field.hpp"

namespace condyle::sample {

/// How far beyond the head's circle a contour counts as having left it, in head radii: 0.12 mm on a head of
/// 24 mm. Well above what flat triangles and rounding do, well below what an image shows.
inline constexpr double cam_departure = 0.005;

/// A cam: a ball that looks out of the head at its junction with the neck, and a taper from there that sinks
/// into the neck. In the plane of the neck's axis n and the bump's clock position d:
///
///     d | . - ~ - .   head
///       |           *  the circles cross
///       |         .-- o --.
///       |        (    c    ` - .
///     O +---------`---------------` end ---> n
///
/// Both are swept around the neck's axis by three quarters of an hour to either side of d.
///
/// Turning c about O moves the crossing and leaves the bump's height over the head as it is. The farther c
/// is turned out of the neck, the more of the bump is seen.
struct Cam {
  Ball bump, end;  ///< in the plane of the middle of the bump
  double head_radius = 0;
  Vec3 neck = Vec3::UnitZ(), out = Vec3::UnitX();  ///< n and d: unit, at right angles

  FieldValue operator()(const Vec3& p) const noexcept;

  /// The sweep's middle and ends: what finer triangles are for.
  std::array<Ball, 3> places() const noexcept;

  /// Width of the seam around it: narrow on the head, where the contour must be seen to leave the circle,
  /// wide on the neck, where the two meet at a flat angle anyway.
  FieldValue seam(const Vec3& p) const noexcept;
};

/// The cam whose circle crosses the head's at this angle from the neck's axis. `grown` from 0 to 1: from one
/// that hardly looks out of neck and head, crossing at 15 degrees, to a full one, crossing at 30 degrees and
/// standing 0.14 head radii out of the head.
Cam cam_crossing_at(const HipParameters& hip, Angle crossing, double grown) noexcept;

}  // namespace condyle::sample
