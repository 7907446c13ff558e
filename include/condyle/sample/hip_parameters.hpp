#pragma once

#include <optional>

#include "condyle/angle.hpp"
#include "condyle/points.hpp"

namespace condyle {

/// The measures of the sample hip, as a clinician or a designer of implants would state them. Defaults are
/// those of an average adult; ranges are what adult hips show, somewhat widened. Sizes not named here grow
/// with the head (femur) or the socket (hip bone).
struct HipParameters {
  /// Radius of the femoral head, mm, 18 to 32.
  double head_radius_mm = 24;
  /// Bony joint space: radius of the socket less radius of the head, which are concentric; mm, 2 to 6.
  double joint_space_mm = 3.5;

  /// Between the neck's axis and the shaft's axis, both pointing away from where they meet; 110 to 145
  /// degrees.
  Angle neck_shaft_angle = Angle::degrees(127);
  /// Angle about the shaft by which the neck points forward of the frontal plane; -15 to 45 degrees.
  Angle femoral_anteversion = Angle::degrees(15);
  /// Half the neck's front-to-back width where it is narrowest; mm, 8 to 0.8 head radii.
  double neck_radius_mm = 13;
  /// Along the neck's axis from the head's centre to the shaft's axis; mm, 40 to 65.
  double neck_length_mm = 50;
  /// Along the shaft's axis from there to the cut at its lower end; mm, 60 to 250.
  double shaft_length_mm = 100;
  /// With this set, a cam bump on the head-neck junction at half past one around the neck's axis,
  /// anterosuperior, that makes this alpha angle there; from sample::native_alpha_angle(), but at least 50,
  /// to 90 degrees. Without, no bump: head and neck make the native angle, which no constant could stand for.
  std::optional<Angle> alpha_angle = {};

  /// Between the socket's opening direction and the vertical, Murray's anatomical inclination; 35 to 65
  /// degrees.
  Angle acetabular_inclination = Angle::degrees(50);
  /// By which the opening direction, seen from above, points forward of straight lateral, Murray's anatomical
  /// anteversion; -10 to 35 degrees.
  Angle acetabular_version = Angle::degrees(18);
  /// In the frontal plane through the head's centre, from the vertical to the socket's edge, positive
  /// laterally; 15 to 45 degrees.
  Angle lateral_centre_edge_angle = Angle::degrees(33);

  friend bool operator==(const HipParameters&, const HipParameters&) = default;
};

}  // namespace condyle
