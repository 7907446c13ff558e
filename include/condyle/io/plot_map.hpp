#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/result/plot_axes.hpp"

namespace condyle {

/// What is known of the quantity at one grid point.
enum class MapPointKind : std::uint8_t {
  contact,           ///< contact ends the motion: the value is where
  end_of_range,      ///< nothing touches in the range asked for: the value is that range, or past it
  contact_at_start,  ///< in contact before any turn: no value
};

/// A quantity in degrees over two held angles.
struct MapPlot {
  PlotHeading heading;
  std::string quantity;             ///< "limit of internal rotation", named at the colour bar
  std::string x_label, y_label;     ///< of the held angles, unit included
  std::vector<double> x, y;         ///< degrees, ascending, at least one of each
  std::vector<double> values;       ///< degrees, at row * x.size() + column; read where there is a value
  std::vector<MapPointKind> kinds;  ///< as many
};

/// The map as filled contours with a colour bar, SVG text. Points in contact at the start are left out and
/// hatched; where the range ends without contact the colour is hatched. A map of one row or column
/// has no area to fill and is drawn as a curve.
std::string map_plot(const MapPlot& map);

}  // namespace condyle
