#pragma once

#include "condyle/pose.hpp"

namespace condyle::kinematics {

/// Axes of a joint frame as the bones show them, in the frame of their meshes; unit, orthonormal. Z = X x Y points to the
/// right on either side of the body, so that axes need no side.
struct ShownAxes {
  Vec3 anterior, superior;
  Vec3 right() const { return anterior.cross(superior); }
};

/// The component of a direction perpendicular to a unit axis, normalised.
inline Vec3 square_to(const Vec3& axis, const Vec3& direction) {
  return (direction - direction.dot(axis) * axis).normalized();
}

}  // namespace condyle::kinematics
