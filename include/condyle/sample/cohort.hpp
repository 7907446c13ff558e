#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "condyle/angle.hpp"
#include "condyle/sample/hip_parameters.hpp"

/// Hips with measures drawn at random, for anybody to try a study on. docs/cohort.md has where the distributions come from.

namespace condyle {

/// A normal distribution cut off at both ends. Of a measure that goes with the head, in head radii.
struct MeasureDistribution {
  std::string_view measure;  ///< its name in hip_measures()
  std::string_view unit;     ///< "mm", "deg", or "head radii"
  double mean, standard_deviation, low, high;
};

/// One for each measure that is drawn, each independent of the others; those not drawn are as HipParameters has them.
std::span<const MeasureDistribution> cohort_distributions() noexcept;

/// A hip of a cohort.
struct CohortHip {
  HipParameters measures;  ///< rounded to 0.1 mm and 0.1 degrees
  bool is_left;
  /// The alpha angle that the femur has: of its cam, or without one that of head and neck.
  Angle alpha_angle;
};

/// Hip k of the cohort of this seed, which does not depend on how many there are. An alpha angle drawn below the least of a
/// cam makes a hip without one. Some microseconds.
CohortHip cohort_hip(std::uint64_t seed, std::uint64_t k);

}  // namespace condyle
