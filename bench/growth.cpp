#include "growth.hpp"

#include <cmath>

namespace bench {

std::optional<double> fitted_exponent(std::span<const SizeAndCost> measured) {
  if (measured.size() < 3) return std::nullopt;
  const auto n = static_cast<double>(measured.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [size, cost] : measured) {
    const double u = std::log(size), v = std::log(cost);
    x += u, y += v, xx += u * u, xy += u * v;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace bench
