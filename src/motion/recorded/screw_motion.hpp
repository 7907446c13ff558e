#pragma once

#include "condyle/angle.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"
#include "motion/search/path_clearance.hpp"

namespace condyle::motion {

/// Past this the sense in which a body turned would hang on rounding and on noise.
inline constexpr Angle most_rotation = Angle::degrees(179);

/// The largest distance of a point of a mesh from its origin.
double reach_of(const Mesh& mesh);

/// From one pose to another by a screw motion: a rotation about one line of F together with a shift along it.
///
///     | axis        s = 1        R(s) = R_axis(s rotation) R(0)
///     |   . - ' ' - o
///     | .         .            every point of the body turns by s rotation about the line and moves by
///     o - . . - '   s = 0      s slide along it, at one speed all the way
///     |
///
/// The segment of a motion between two samples of it, as far as two samples determine it. Among all rotations that
/// lead from one to the other the one below half a turn; in which sense two poses half a turn apart are connected is
/// not known, and rotation() then is pi to rounding.
class ScrewMotion {
 public:
  /// The largest distance of a mobile point from its origin, in mm, decides which differences are rounding.
  ScrewMotion(const Pose& from, const Pose& to, double reach_mm);

  /// At a fraction of the way, in [0, 1]; `from` to the bit at 0, `to` to rounding at 1.
  Pose at(double s) const;

  /// From 0 to pi, about axis().
  Angle rotation() const noexcept { return Angle::radians(rotation_); }
  /// Unit direction in F; any where nothing turns.
  const Vec3& axis() const noexcept { return axis_; }
  /// The point of the axis that is nearest to the origin's place at the end; where nothing turns that place.
  Vec3 point() const { return from_.translation() + cosine_ + shift_; }
  /// Whether both poses have the same translation, so that the body rotates about its origin. Translations that differ
  /// by no more than placing a point rounds, 4 u (reach + |t|) in a coordinate, are the same.
  bool holds_origin() const noexcept { return holds_origin_; }
  /// Whether no point moves by more than that.
  bool is_still() const noexcept { return holds_origin_ && rotation_ == 0; }
  /// Per whole way.
  const Speed& speed() const noexcept { return speed_; }

 private:
  Pose from_;
  Vec3 axis_;
  double rotation_ = 0;
  bool holds_origin_ = false;
  /// The origin's way: shift s + sine sin(s rotation) + cosine (1 - cos(s rotation)).
  Vec3 shift_, sine_ = Vec3::Zero(), cosine_ = Vec3::Zero();
  Speed speed_;
};

}  // namespace condyle::motion
