#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "condyle/error.hpp"
#include "io/motion/curve_files.hpp"

namespace condyle::io {
namespace {

/// Between a frame and the next one. std::lerp of a NaN and a number may be that number.
double between(const std::vector<double>& at, const std::vector<double>& y, std::size_t before, double t) {
  const double a = y[before], b = y[before + 1];
  if (std::isnan(a) || std::isnan(b)) return std::nan("");
  return std::lerp(a, b, (t - at[before]) / (at[before + 1] - at[before]));
}

}  // namespace

Curves cycle_of(const Curves& curves, double start_s, double end_s, std::size_t points) {
  assert(curves.values.size() == curves.names.size());
  if (points < 2) throw UsageError(fmt::format("a cycle has at least 2 points, not {}", points));
  if (!(start_s < end_s)) throw UsageError(fmt::format("a cycle from {} to {} s is empty", start_s, end_s));
  if (curves.at.empty() || start_s < curves.at.front() || end_s > curves.at.back())
    throw UsageError(curves.at.empty()
                         ? std::string("a cycle of a motion without frames")
                         : fmt::format("a cycle from {} to {} s is not within the motion, {} to {} s",
                                       start_s, end_s, curves.at.front(), curves.at.back()));
  Curves cycle{.axis = "cycle_percent", .at = {}, .names = curves.names, .values = {}};
  cycle.values.resize(curves.names.size());
  for (std::size_t i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points - 1);
    const double t = std::lerp(start_s, end_s, share);  // exact at both ends
    cycle.at.push_back(100 * share);
    const auto after =
        static_cast<std::size_t>(std::upper_bound(curves.at.begin(), curves.at.end(), t) - curves.at.begin());
    const std::size_t before = after - 1;
    for (std::size_t c = 0; c < curves.values.size(); ++c) {
      const std::vector<double>& y = curves.values[c];
      assert(y.size() == curves.at.size());
      cycle.values[c].push_back(curves.at[before] == t ? y[before]  // the last frame has none after it
                                                       : between(curves.at, y, before, t));
    }
  }
  return cycle;
}

}  // namespace condyle::io
