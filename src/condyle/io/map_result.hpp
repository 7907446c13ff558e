#pragma once

#include <string>
#include <vector>

#include "condyle/io/plot_map.hpp"
#include "condyle/kinematics/joint.hpp"
#include "condyle/motion/motion_map.hpp"

/// What `condyle rom --map` found, as text. Every key, column, unit and sign is in docs/formats.md.

namespace condyle {

/// A complete map of a joint and on which terms it was made.
struct MapResult {
  const Joint& joint;
  const MotionMap& map;
  std::vector<std::string> terms;  ///< as of RomResult
};

/// The summary as JSON text: grid, counts by reason, free volume and areas. The points are in the CSV.
std::string map_json(const MapResult& result);

/// The summary for people, a few lines.
std::string map_text(const MapResult& result);

/// One line per grid point, row by row, with a header line: the held angles, both limits of the varied angle
/// as values of that angle, how they end, and the contact points. Numbers to the last bit.
std::string map_csv(const MapResult& result);

/// What of a map is drawn.
enum class MapView {
  positive_limit,  ///< how far it turns in the positive sense: flexion, adduction or internal rotation
  negative_limit,  ///< the other way, as a positive number of degrees
  free_range,      ///< both together
};

/// The map as map_plot() draws it, the columns to the right and the rows up.
MapPlot plot_of(const MapResult& result, MapView view);

/// "flexion" or "extension", and so on: the clinical word for turning an angle in a sense.
std::string_view movement_name(JointAngle angle, TurnSense sense) noexcept;

}  // namespace condyle
