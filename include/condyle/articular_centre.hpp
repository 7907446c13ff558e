#pragma once

#include <cstddef>

#include "condyle/points.hpp"

namespace condyle {

/// How the centre of a head follows its socket: the translation that makes the joint space even, within bounds
/// (docs/mathematics.md, section 6).
struct CentreRule {
  /// No larger shift is made: the centre of a hip moves by a millimetre or two against its socket.
  double largest_shift_mm = 3;
  /// Wider than any joint space: a ray that first meets the socket further off sees the rim or beyond.
  double largest_gap_mm = 6;
};

/// A small translation of the mobile body at one pose.
struct CentreShift {
  Vec3 translation_mm = Vec3::Zero();  ///< of M in F
  double gap_mm = 0;            ///< between the narrowest and the middle width of the evened joint space
  double spread_before_mm = 0;  ///< of the joint space about its middle, robust deviation, before
  double spread_after_mm = 0;   ///< and after
  std::size_t vertices = 0;     ///< of the head, that face the socket
  bool cut_back = false;        ///< an even joint space would need more than largest_shift_mm
};

}  // namespace condyle
