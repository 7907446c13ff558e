#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "condyle/io/recorded_motion.hpp"

namespace condyle::io {

/// Range that a model allows one of its coordinates, in degrees or mm. It changes no pose, as in OpenSim.
struct CoordinateLimits {
  std::string name;
  CoordinateKind kind = CoordinateKind::angle;
  std::optional<std::array<double, 2>> range = {};
  std::optional<double> locked_at = {};
};

/// Collects what the recorded coordinates of a motion are beyond, to one note of each kind.
class BeyondLimits {
 public:
  /// `values`: one per frame, degrees or mm, NaN for gaps.
  void check(const CoordinateLimits& limits, std::span<const double> values);

  std::vector<motion::ContactNote> notes() const;

 private:
  std::string beyond_, unlocked_;
};

}  // namespace condyle::io
