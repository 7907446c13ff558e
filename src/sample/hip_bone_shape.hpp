#pragma once

#include "condyle/sample/hip.hpp"
#include "sample/field.hpp"

namespace condyle::sample {

/// The socket of a right hip, in the joint frame: millimetres, X anterior, Y superior, Z to the right, origin
/// at the hip centre.
///
///            . - ~ .  <- rim at `rim_radius` about the opening's axis
///          /         |
///         (     O    |--->  opening
///          \         |
///            ` - _ .       rim plane: p . opening = rim_offset, behind the centre where it covers less than half
struct Socket {
  double radius = 0;
  Vec3 opening = Vec3::UnitZ();
  double rim_offset = 0;
  Vec3 notch = -Vec3::UnitY();  ///< in the rim plane, to where the rim is notched: down, slightly forwards
};
Socket socket_of(const HipParameters&) noexcept;

/// Socket radius at which skeleton, labrum and fossa were drawn, mm; others are these scaled.
inline constexpr double nominal_socket_radius = 27.5;

/// Right hip bone: socket with rim and inferior notch, iliac wing with both spines, ischium with tuberosity
/// and spine, both pubic rami about the obturator hole. Genus 1.
Solid hip_bone_shape(const HipParameters&);

}  // namespace condyle::sample
