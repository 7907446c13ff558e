#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/result/json.hpp"
#include "io/result/rom_result.hpp"

/// How far the limits of one joint are from those of another, of which the one was made by a change: docs/report.md.

namespace condyle::io {

/// Kind of a difference: a bound if the range of one of the two motions ends without contact.
enum class DifferenceIs : std::uint8_t { exact, at_least, at_most };

/// A difference shown as 0.0 degrees is no change, however certain: remeshed bones differ by as much.
inline constexpr double least_change_deg = 0.05;

/// 5, 50 and 95 % of the differences between joints that are displaced by the same amounts, degrees.
struct DifferenceBand {
  double p5_deg, median_deg, p95_deg;

  /// Whether 5 to 95 % lie on one side of zero, by `least_change_deg` or more.
  bool leaves_out_zero() const noexcept { return p5_deg >= least_change_deg || p95_deg <= -least_change_deg; }
};

/// The difference of one motion's limits: after minus before.
struct LimitDifference {
  std::string motion;
  /// Nothing if neither motion ends by contact, or either starts in contact.
  std::optional<double> by_deg = {};
  DifferenceIs is = DifferenceIs::exact;
  /// If both have bands of the same seed and number of samples.
  std::optional<DifferenceBand> band = {};
};

/// One per motion. Both results are of the same motions in the same order.
std::vector<LimitDifference> limit_differences(const RangeAnswer& before, const RangeAnswer& after);

/// A list, in which what is not known is null.
Json differences_json(const std::vector<LimitDifference>& differences);

}  // namespace condyle::io
