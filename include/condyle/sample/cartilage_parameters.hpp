#pragma once

namespace condyle {

/// The cartilages of the sample hip. They lie on the bones, without a gap between: the joint space is the sum
/// of femoral thickness, clearance and acetabular thickness.
struct CartilageParameters {
  /// Gap between the two articular surfaces, spheres about the hip centre; below zero they overlap by so
  /// much. mm, -0.5 to 1.
  double clearance_mm = 0.2;
  /// Thickness of the femoral cartilage, mm, 1 to 3. The acetabular one has what is left of the joint space,
  /// which must be at least 1 mm: 1.65 mm at the defaults.
  double femoral_thickness_mm = 1.65;

  friend bool operator==(const CartilageParameters&, const CartilageParameters&) = default;
};

}  // namespace condyle
