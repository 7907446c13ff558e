#pragma once

#include <span>

#include "condyle/angle.hpp"
#include "condyle/pose.hpp"

/// The centre, or the axis, about which one body turned in the other, from recorded poses of both: SCoRE and SARA of Ehrig et al. (2006,
/// doi 10.1016/j.jbiomech.2005.10.002; 2007, J Biomech 40:2150). docs/mathematics/01-setting.md.

namespace condyle::kinematics {

/// Less turning than this, root mean square, leaves a centre or an axis open.
inline constexpr Angle least_turning = Angle::degrees(5);
/// Fewer poses are refused.
inline constexpr std::size_t fewest_poses = 20;

/// How much rotations are about one axis, their main one, and off it: each a root mean square about the mean.
struct Turning {
  Angle about_axis, off_axis;
};

/// Bounds are those of 200 resamples of stretches of the recording. What moves with the joint, as skin over bone does, is in no residual and
/// in no bound.
struct FunctionalCentre {
  Vec3 in_fixed, in_mobile;  ///< mm, in each body's frame
  double residual_mm;        ///< root mean square distance of the two
  double centre_bound_mm;    ///< 95 % of resamples have in_fixed within
  double sd_mm;              ///< of each coordinate of in_fixed: root mean square over the three
  Turning turning;
  std::size_t poses;
};

/// The point that lies best in one place of both bodies: the least sum of squares of X_FM in_mobile - in_fixed, in closed form; the choice of
/// frames changes nothing. Deterministic. Throws MeshError for fewer than fewest_poses, and where rotations leave their main axis by less than
/// least_turning: any point of that axis would do.
[[nodiscard]] FunctionalCentre functional_centre(std::span<const Pose> X_FM);

/// An axis as a point, mm, and a unit vector of which the largest component is positive.
struct AxisInBody {
  Vec3 point, direction;
};

struct FunctionalAxis {
  AxisInBody in_fixed,
      in_mobile;          ///< points: that which lies best in one place, nearest to the mobile frame's origin
  double residual_mm;     ///< root mean square distance of the two points
  Angle direction_bound;  ///< 95 % of resamples have the fixed body's direction within
  double axis_bound_mm;   ///< and their axis this near to its point
  Turning turning;
  std::size_t poses;
};

/// The axis about which the mobile body turned. Throws MeshError for fewer than fewest_poses, for less turning about it than least_turning,
/// and if rotations leave it by more than half as much: there is no one axis.
[[nodiscard]] FunctionalAxis functional_axis(std::span<const Pose> X_FM);

}  // namespace condyle::kinematics
