#pragma once

#include <optional>
#include <span>

namespace bench {

struct SizeAndCost {
  double size, cost;
};

/// The exponent b of cost ~ size^b that fits best: the slope of the line of least squares through the
/// logarithms. Empty for fewer than three sizes.
std::optional<double> fitted_exponent(std::span<const SizeAndCost> measured);

}  // namespace bench
