#pragma once

#include <optional>

#include "condyle/angle.hpp"
#include "condyle/fit.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/mesh.hpp"

/// Where on the socket's rim, and where around the neck: two clock faces.

namespace condyle {

/// A clock face in a body's frame, seen with 12 up and 3 anterior whichever side of the body it is on:
///
///             12  twelve (superior)
///              |
///     9 -------+------- 3  three (anterior)
///              |
///              6
struct ClockFace {
  Vec3 twelve, three;  ///< unit, at a right angle

  /// The hour of a direction from the centre, in [0, 12): 0 is 12 o'clock, 1.5 half past one. Along the
  /// face's normal there is no hour: 0.
  double hour_of(const Vec3& direction) const noexcept;
  /// The same as an angle from 12 towards 3, in [0, 360) degrees.
  Angle angle_of(const Vec3& direction) const noexcept;
};

/// The face whose plane has this normal (either sense, any length but zero): 12 is Y of the joint frame and 3
/// is X, each as it falls on the plane, X as far as it is across 12. Throws UsageError if the normal is
/// within a degree of Y, or 12 and X leave no 3.
ClockFace clock_face(const Vec3& normal);

/// The acetabular clock if the opening plane is not given: the sagittal plane, normal Z. Published clock
/// positions refer to the opening plane itself; between the two a position moves by up to half an hour or so,
/// depending on inclination and version.
ClockFace sagittal_clock();

/// The acetabular clock in the plane of the rim: the plane fitted to the rim as the head sees it, 6 o'clock at the
/// acetabular notch, where published clock positions have it. Head and mesh in F. Empty if no rim or no notch is
/// found, or the plane leaves no 3 o'clock.
std::optional<ClockFace> find_rim_clock(const TriMesh& fixed, const Sphere& head);

/// Which of the two a position refers to.
enum class ClockPlane { sagittal, rim };

/// The femoral neck: from the head's centre outwards, in M.
struct NeckAxis {
  Vec3 direction;  ///< unit
};

/// The neck's axis as the mesh has it: the direction of the centroid, by area, of all triangles with their
/// corners between 1.2 and 1.6 head radii from the joint centre. There the femur consists only of the neck;
/// nearer is the head, farther begin the trochanters. Empty if there is nothing in that shell, or it lies
/// around the centre more evenly than any neck does.
std::optional<NeckAxis> find_neck_axis(const TriMesh& mobile, double head_radius_mm);

/// The clock around the neck: its plane is across the neck's axis.
ClockFace neck_clock(const NeckAxis& neck);

}  // namespace condyle
