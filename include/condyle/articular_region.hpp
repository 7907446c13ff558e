#pragma once

#include <optional>

#include "condyle/angle.hpp"
#include "condyle/joint.hpp"

namespace condyle {

/// Directions in F around one of them.
struct ArticularCone {
  Vec3 axis;  ///< in F, any length but zero
  Angle half_angle;
};

/// The part of the joint where its bodies are meant to slide on each other: a ball about the joint centre,
/// or the part of it in a cone. What lies in it is articular, everything else (rim, neck, trochanter) is not.
///
///        ____
///      /  M   .   \   rim          . radius: as far as the head reaches into the socket, and a little more
///     |   head .---+----
///      .      .   /   neck
///        ----
struct ArticularRegion {
  double radius_mm = 0;
  std::optional<ArticularCone> cone = {};

  /// Whether a point given in F lies in it; on its border counts.
  bool holds(const Vec3& p_F) const noexcept;
};

/// A head's joint space is some tenths of a millimetre to 4 mm wide and its radius 20 to 30 mm: 1.1 radii
/// reach across it and stay inside the rim.
inline constexpr double articular_radii_of_head = 1.1;

/// The ball of articular_radii_of_head radii of the mobile body's head, found as find_sphere() does, about
/// the joint centre. Empty for a hinge and where no head is found within a radius of the centre: nothing is
/// guessed.
std::optional<ArticularRegion> find_articular_region(const Joint& joint);

}  // namespace condyle
