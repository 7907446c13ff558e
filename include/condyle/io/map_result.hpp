#pragma once

#include <string>
#include <string_view>

#include "condyle/io/plot_map.hpp"
#include "condyle/motion_map.hpp"

/// What `condyle rom --map` found, as text. Every key, column, unit and sign is in docs/formats.md.

namespace condyle {

/// The summary for people, a few lines: how the ends are spread over the reasons, and the free volume. The
/// map is complete, here and below.
std::string map_text(const MotionMap& map);

/// One line per grid point, row by row, with a header line: the held angles, both limits of the varied angle
/// as values of that angle, how they end, and the contact points. Numbers to the last bit.
std::string map_csv(const MotionMap& map);

/// What of a map is drawn.
enum class MapView {
  positive_limit,  ///< how far it turns in the positive sense: flexion, adduction or internal rotation
  negative_limit,  ///< the other way, as a positive number of degrees
  free_range,      ///< both together
};

/// The map as map_plot() draws it, the columns to the right and the rows up, under the joint's name.
MapPlot plot_of(const MotionMap& map, MapView view, std::string_view joint_name);

/// "flexion" or "extension", and so on: the clinical word for turning an angle in a sense.
std::string_view movement_name(JointAngle angle, TurnSense sense) noexcept;

}  // namespace condyle
