#pragma once

#include "condyle/sample/hip.hpp"
#include "sample/field.hpp"

namespace condyle::sample {

/// Where the axes of a right femur lie, in the joint frame: millimetres, X anterior, Y superior, Z to the
/// right, origin at the head's centre.
///
///       head O
///          \        the neck meets the shaft's axis at `foot`; `distal` points down the shaft,
///           \ neck  `lateral` to the right at right angles to it, both in the frontal plane;
///       foot *      a positive anteversion puts the foot behind the head
///            |
///            | distal
struct FemurAxes {
  Vec3 neck, distal, lateral;
  Vec3 foot;
};
FemurAxes femur_axes(const HipParameters&) noexcept;

/// Where a cam sits: half past one on the clock around the neck, midway between superior (12) and anterior
/// (3), at right angles to the neck's axis. Superior lies in the plane of neck and shaft. Measured in the
/// plane of the neck's axis and this direction, which radial images of the neck call anterosuperior.
Vec3 cam_direction(const FemurAxes& axes) noexcept;

/// The alpha angle at the cam's clock position that head and neck make without a cam. Alpha (Noetzli et al.,
/// J Bone Joint Surg Br 2002) is the angle between the neck's axis and the line from the head's centre to
/// where the contour, traced from the head towards the neck, leaves the head's circle: where it is half a
/// per cent of the head's radius outside (`cam_departure`). He measured it in the oblique axial plane, at 3
/// o'clock; here it is measured in the plane of cam_direction().
Angle native_alpha_angle(const HipParameters&);

/// Right proximal femur: head, neck, both trochanters, shaft, and the cam where alpha_angle is set, which is
/// then at least the native one. The head is the exact sphere wherever nothing else comes within the seam's
/// width of it.
Solid femur_shape(const HipParameters&);

}  // namespace condyle::sample
