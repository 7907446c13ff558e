#pragma once

#include "condyle/sample/field.hpp"
#include "condyle/sample/hip_parameters.hpp"

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

/// Right proximal femur: head, neck, both trochanters, shaft. The head is the exact sphere wherever nothing
/// else comes within the seam's width of it.
Solid femur_shape(const HipParameters&);

}  // namespace condyle::sample
