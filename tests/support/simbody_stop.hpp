#pragma once

#include <array>

namespace condyle::test {

/// A body of Simbody on a pin about an axis through the origin, held by its linear stop between two ends, in radians.
struct SimbodyStop {
  std::array<double, 3> axis;
  std::array<double, 2> ends;

  /// Where the stop begins to act on the way from 0, to 1e-13.
  double begin(double towards) const;
  /// A point of the body, as Simbody poses it.
  std::array<double, 3> posed(const std::array<double, 3>& point, double angle) const;
};

}  // namespace condyle::test
