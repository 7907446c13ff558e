#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "condyle/motion_map.hpp"
#include "io/result/plot_axes.hpp"

namespace condyle::io {

/// A quantity in degrees over two held angles.
struct MapPlot {
  PlotHeading heading;
  std::string quantity;              ///< "limit of internal rotation", named at the colour bar
  std::string x_label, y_label;      ///< of the held angles, unit included
  std::vector<double> x, y;          ///< degrees, ascending, at least one of each
  std::vector<double> values;        ///< degrees, at row * x.size() + column; read where there is a value
  std::vector<LimitReason> reasons;  ///< as many; no value for contact_at_start, at least it for end_of_range
  /// As many, or none where none is so: points that are free, but not at the start; points with other free intervals.
  std::vector<bool> starts_in_contact, has_islands;
};

/// The map as filled contours with labels and a colour bar, SVG text. Points that are free nowhere are left out and
/// hatched; the cells around points whose range ends without contact, that are not free at the start, or that have
/// other free intervals too, are hatched over the colour. A map of one row or column has no area to fill and is drawn
/// as a curve.
std::string map_plot(const MapPlot& map);

/// What of a map is drawn.
enum class MapView {
  positive_limit,  ///< how far it turns in the positive sense: flexion, adduction or internal rotation
  negative_limit,  ///< the other way, as a positive number of degrees
  free_range,      ///< both together
};

/// The map as map_plot() draws it, the columns to the right and the rows up, under the joint's name.
MapPlot plot_of(const MotionMap& map, MapView view, std::string_view joint_name);

}  // namespace condyle::io
