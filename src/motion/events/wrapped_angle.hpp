#pragma once

#include "condyle/angle.hpp"

namespace condyle::motion {

/// The angle in [0, 2 pi), for one less than a full turn away from it.
inline double wrapped(double angle) noexcept {
  if (angle < 0) angle += two_pi;
  return angle >= two_pi ? angle - two_pi : angle;
}

}  // namespace condyle::motion
