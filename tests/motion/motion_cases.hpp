#pragma once

#include "condyle/range_of_motion.hpp"
#include "support/test.hpp"

/// Parts of the cases that several tests of motions have in common.

namespace condyle::test {

/// Coordinates go through at most two rotations and one arctangent: some ten roundings of angles of a few
/// radians, each 2^-53 of it; contact itself is short by at most 4e-12.
inline constexpr double angle_tolerance = 5e-12;

inline motion::Motion flexion() {
  return motion::hip_motions().front();
}

/// A box somewhere between 25 and 60 mm from the centre.
inline TriMesh random_box(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1, 1), far(25, 60), size(2, 9);
  Vec3 direction(place(random), place(random), place(random));
  const Vec3 centre = direction.normalized() * far(random);
  const Vec3 half(size(random), size(random), size(random));
  return box(centre - half, centre + half);
}

}  // namespace condyle::test
