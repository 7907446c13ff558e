#pragma once

#include <cmath>

#include "condyle/angle.hpp"

namespace condyle::core {

/// The same direction in [0, 2 pi), of an angle of any size in radians. Within a turn of that interval, where
/// nearly all angles are, without a division; a small negative angle that would round to 2 pi becomes 0.
inline double wrapped(double radians) noexcept {
  if (radians <= -two_pi || radians >= 2 * two_pi) radians = std::fmod(radians, two_pi);
  if (radians < 0) radians += two_pi;
  return radians >= two_pi ? radians - two_pi : radians;
}

}  // namespace condyle::core
