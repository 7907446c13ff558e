#include <fmt/format.h>

#include <string>
#include <vector>

#include "condyle/io/map_result.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/result/movement_words.hpp"
#include "io/result/plot_map.hpp"

namespace condyle::io {
namespace {

std::string axis_label(JointAngle angle, Anatomy joint) {
  return fmt::format("{} (+) / {} (\xE2\x88\x92), degrees",
                     movement_words(angle, RotationSense::positive, joint),
                     movement_words(angle, RotationSense::negative, joint));
}

std::vector<double> values_of(const GridAxis& axis) {
  std::vector<double> values;
  for (std::size_t i = 0; i < axis.count(); ++i) values.push_back(axis.value_deg(i));
  return values;
}

/// At the ends of the interval that is drawn; where nothing is free, in contact.
LimitReason reason_of(const FreeInterval* free, MapView view) noexcept {
  if (!free) return LimitReason::contact_at_start;
  const bool low_open = free->at_low.reason == LimitReason::end_of_range;
  const bool high_open = free->at_high.reason == LimitReason::end_of_range;
  const bool open = view == MapView::positive_limit   ? high_open
                    : view == MapView::negative_limit ? low_open
                                                      : low_open || high_open;
  return open ? LimitReason::end_of_range : LimitReason::contact;
}

/// Where the interval ends, from the start; below zero where it does not reach the start.
double value_of(const FreeInterval& free, MapView view) noexcept {
  switch (view) {
    case MapView::positive_limit:
      return free.high.degrees();
    case MapView::negative_limit:
      return (-free.low).degrees();
    case MapView::free_range:
      return (free.high - free.low).degrees();
  }
  return 0;
}

std::string quantity_of(JointAngle varied, MapView view, Anatomy joint) {
  switch (view) {
    case MapView::positive_limit:
      return "limit of " + movement_words(varied, RotationSense::positive, joint);
    case MapView::negative_limit:
      return "limit of " + movement_words(varied, RotationSense::negative, joint);
    case MapView::free_range:
      return "free range of " + spaced(name_of(varied, joint));
  }
  return "";
}

}  // namespace

MapPlot plot_of(const MotionMap& map, MapView view, std::string_view joint_name) {
  const MapGrid& grid = map.grid;
  const std::string quantity = quantity_of(grid.vary, view, map.anatomy);
  std::string subject =
      fmt::format("{} over {} and {}", quantity, spaced(name_of(grid.column.angle, map.anatomy)),
                  spaced(name_of(grid.row.angle, map.anatomy)));
  subject[0] = static_cast<char>(subject[0] - 'a' + 'A');
  MapPlot plot;
  plot.heading = {std::string(joint_name), subject};
  plot.quantity = quantity;
  plot.x_label = axis_label(grid.column.angle, map.anatomy);
  plot.y_label = axis_label(grid.row.angle, map.anatomy);
  plot.x = values_of(grid.column);
  plot.y = values_of(grid.row);
  for (const FreeAngles& point : map.points) {
    const FreeInterval* drawn = point.nearest_to_start();
    plot.values.push_back(drawn ? value_of(*drawn, view) : 0);
    plot.reasons.push_back(reason_of(drawn, view));
    plot.starts_in_contact.push_back(!point.from_start.free_at_start() && drawn);
    plot.has_islands.push_back(point.intervals.size() > 1);
  }
  return plot;
}

}  // namespace condyle::io
