#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "growth.hpp"

/// Plots on logarithmic axes, as SVG text.

namespace bench {

struct Series {
  std::string label;   ///< Beside its last point.
  std::string family;  ///< One colour each, explained in the legend.
  std::vector<SizeAndCost> points;
};

struct LogPlot {
  std::string title, subtitle;
  std::string x_label, y_label;
  std::vector<Series> series;
  /// Words for the row below the axis where a cost of 0 is drawn; empty where there is none.
  std::string zero_label;
};

/// Points joined to a line per series, decades as grid. Labels stand in one column on the right, moved apart
/// where they would overlap, with a thin line from the point to its label.
std::string svg_text(const LogPlot& plot);

}  // namespace bench
