#include "io/joint/grid_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/file/in_quotes.hpp"

namespace condyle::io {
namespace {

[[noreturn]] void fail(std::string_view text) {
  throw UsageError(fmt::format(
      "map: {} is not of the form flexion=-20:120:1 (first, last and step in degrees, of x, y and z in mm)",
      io::in_quotes(text)));
}

double number(std::string_view digits, std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) fail(text);
  return value;
}

}  // namespace

motion::GridAxis parse_grid_axis(std::string_view text, Anatomy joint) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos) fail(text);
  std::vector<double> values;
  for (std::size_t at = equals; at != text.npos;) {
    const std::size_t end = text.find(':', at + 1);
    values.push_back(number(text.substr(at + 1, end == text.npos ? end : end - at - 1), text));
    at = end;
  }
  if (values.size() > 3) fail(text);
  motion::GridAxis axis{map_coordinate_named(text.substr(0, equals), joint), values.front(), values.front(),
                        1};
  if (values.size() > 1) axis.last = values[1];
  if (values.size() > 2) axis.step = values[2];
  return axis;
}

std::string to_text(const motion::GridAxis& axis, Anatomy joint) {
  return fmt::format("{}={}:{}:{}", name_of(axis.coordinate, joint), axis.first, axis.last, axis.step);
}

motion::MapCoordinate map_coordinate_named(std::string_view name, Anatomy joint) {
  if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z')
    return motion::MapCoordinate::translation(name[0] - 'x');
  return joint_angle_named(name, joint);
}

motion::MapGrid parse_grid(std::span<const std::string> axes, std::string_view vary, Anatomy joint) {
  if (axes.size() < 2)
    throw UsageError("map: a map needs two coordinates, such as flexion=0:120:5 and adduction=-30:30:5");
  motion::MapGrid grid{.row = parse_grid_axis(axes[1], joint), .column = parse_grid_axis(axes[0], joint)};
  if (!vary.empty())
    grid.vary = map_coordinate_named(vary, joint);
  else if (!grid.row.coordinate.is_angle() || !grid.column.coordinate.is_angle())
    throw UsageError("vary: a map over a translation needs the angle or the translation that varies");
  else
    for (const JointAngle angle : all_joint_angles)
      if (grid.row.coordinate != angle && grid.column.coordinate != angle) grid.vary = angle;
  std::vector<motion::MapCoordinate> named{grid.row.coordinate, grid.column.coordinate, grid.vary};
  for (const std::string& text : axes.subspan(2)) {
    const motion::GridAxis axis = parse_grid_axis(text, joint);
    if (!axis.coordinate.is_angle() || axis.last != axis.first)
      throw UsageError(fmt::format("map: {} does not hold an angle at one value", io::in_quotes(text)));
    if (std::find(named.begin(), named.end(), axis.coordinate) != named.end())
      throw UsageError(fmt::format("map: {} is on an axis, varies or is held already", io::in_quotes(text)));
    named.push_back(axis.coordinate);
    grid.held.angles =
        motion::turned_by(grid.held.angles, axis.coordinate.angle(), Angle::degrees(axis.first));
  }
  return grid;
}

}  // namespace condyle::io
