#include <fmt/format.h>

#include <string>
#include <vector>

#include "condyle/io/map_result.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/result/movement_words.hpp"
#include "io/result/plot_map.hpp"

namespace condyle::io {
namespace {

std::string axis_label(JointAngle angle) {
  return fmt::format("{} (+) / {} (\xE2\x88\x92), degrees", movement_words(angle, RotationSense::positive),
                     movement_words(angle, RotationSense::negative));
}

std::vector<double> values_of(const GridAxis& axis) {
  std::vector<double> values;
  for (std::size_t i = 0; i < axis.count(); ++i) values.push_back(axis.value_deg(i));
  return values;
}

/// Of the free range: an end without contact leaves it open.
LimitReason reason_of(const RotationLimits& point) noexcept {
  if (!point.free_at_start()) return LimitReason::contact_at_start;
  const bool ended = point.negative.reason == LimitReason::end_of_range ||
                     point.positive.reason == LimitReason::end_of_range;
  return ended ? LimitReason::end_of_range : LimitReason::contact;
}

std::string quantity_of(JointAngle varied, MapView view) {
  switch (view) {
    case MapView::positive_limit:
      return "limit of " + movement_words(varied, RotationSense::positive);
    case MapView::negative_limit:
      return "limit of " + movement_words(varied, RotationSense::negative);
    case MapView::free_range:
      return "free range of " + spaced(name_of(varied));
  }
  return "";
}

}  // namespace

MapPlot plot_of(const MotionMap& map, MapView view, std::string_view joint_name) {
  const MapGrid& grid = map.grid;
  const std::string quantity = quantity_of(grid.vary, view);
  std::string subject = fmt::format("{} over {} and {}", quantity, spaced(name_of(grid.column.angle)),
                                    spaced(name_of(grid.row.angle)));
  subject[0] = static_cast<char>(subject[0] - 'a' + 'A');
  MapPlot plot;
  plot.heading = {std::string(joint_name), subject};
  plot.quantity = quantity;
  plot.x_label = axis_label(grid.column.angle);
  plot.y_label = axis_label(grid.row.angle);
  plot.x = values_of(grid.column);
  plot.y = values_of(grid.row);
  for (const RotationLimits& point : map.points) {
    const Limit &negative = point.negative, &positive = point.positive;
    switch (view) {
      case MapView::positive_limit:
        plot.values.push_back(positive.turned.degrees());
        plot.reasons.push_back(positive.reason);
        break;
      case MapView::negative_limit:
        plot.values.push_back(negative.turned.degrees());
        plot.reasons.push_back(negative.reason);
        break;
      case MapView::free_range:
        plot.values.push_back((negative.turned + positive.turned).degrees());
        plot.reasons.push_back(reason_of(point));
        break;
    }
  }
  return plot;
}

}  // namespace condyle::io
