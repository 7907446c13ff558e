#include "condyle/io/map_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <vector>

#include "condyle/io/grid_text.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/rom_result.hpp"
#include "io/result/map_summary.hpp"

namespace condyle {
namespace {

/// Blanks for underscores.
std::string spaced(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string movement_words(JointAngle angle, TurnSense sense) {
  return spaced(movement_name(angle, sense));
}

std::string axis_label(JointAngle angle) {
  return fmt::format("{} (+) / {} (\xE2\x88\x92), degrees", movement_words(angle, TurnSense::positive),
                     movement_words(angle, TurnSense::negative));
}

std::vector<double> values_of(const GridAxis& axis) {
  std::vector<double> values;
  for (std::size_t i = 0; i < axis.count(); ++i) values.push_back(axis.value_deg(i));
  return values;
}

MapPointKind kind_of(LimitReason reason) noexcept {
  switch (reason) {
    case LimitReason::contact:
      return MapPointKind::contact;
    case LimitReason::end_of_range:
      return MapPointKind::end_of_range;
    case LimitReason::contact_at_start:
      return MapPointKind::contact_at_start;
  }
  return MapPointKind::contact;
}

/// Of the free range: no more than both ends tell.
MapPointKind kind_of(const MapPoint& point) noexcept {
  if (!point.free_at_start()) return MapPointKind::contact_at_start;
  const bool ended = point.negative.reason == LimitReason::end_of_range ||
                     point.positive.reason == LimitReason::end_of_range;
  return ended ? MapPointKind::end_of_range : MapPointKind::contact;
}

std::string quantity_of(JointAngle varied, MapView view) {
  switch (view) {
    case MapView::positive_limit:
      return "limit of " + movement_words(varied, TurnSense::positive);
    case MapView::negative_limit:
      return "limit of " + movement_words(varied, TurnSense::negative);
    case MapView::free_range:
      return "free range of " + spaced(name_of(varied));
  }
  return "";
}

std::string csv_of(const TurnEnd& end) {
  std::string text = fmt::format(",{},{},{}", name_of(end.reason),
                                 end.reason == LimitReason::end_of_range ? "" : (end.articular ? "1" : "0"),
                                 end.shortfall.degrees());
  if (!end.contact) return text + ",,,";
  const Vec3& p = end.contact->fixed_point;
  return text + fmt::format(",{},{},{}", p.x(), p.y(), p.z());
}

}  // namespace

std::string_view movement_name(JointAngle angle, TurnSense sense) noexcept {
  const bool positive = sense == TurnSense::positive;
  switch (angle) {
    case JointAngle::flexion:
      return positive ? "flexion" : "extension";
    case JointAngle::adduction:
      return positive ? "adduction" : "abduction";
    case JointAngle::internal_rotation:
      return positive ? "internal_rotation" : "external_rotation";
  }
  return "";
}

std::string map_text(const MotionMap& map) {
  assert(map.complete());
  const MapSummary summary = summarise(map);
  std::string text = fmt::format("map of {} over {} and {}, {} points\n", spaced(name_of(map.grid.vary)),
                                 to_text(map.grid.column), to_text(map.grid.row), map.points.size());
  const auto line = [&](TurnSense sense, const ReasonCounts& counts) {
    text += fmt::format("  {:<18} {} end in contact, {} at the end of the range, {} in contact at start\n",
                        movement_words(map.grid.vary, sense), counts[LimitReason::contact],
                        counts[LimitReason::end_of_range], counts[LimitReason::contact_at_start]);
  };
  line(TurnSense::positive, summary.positive_ends);
  line(TurnSense::negative, summary.negative_ends);
  return text + fmt::format("  free volume        {:.6g} deg^3, {:.6g} deg^3 weighted by cos(adduction)\n",
                            summary.volume.plain_deg3, summary.volume.cosine_weighted_deg3);
}

std::string map_csv(const MotionMap& map) {
  assert(map.complete());
  const MapGrid& grid = map.grid;
  const std::string_view varied = name_of(grid.vary);
  std::string text = fmt::format("{0}_deg,{1}_deg,{2}_lower_deg,{2}_upper_deg", name_of(grid.column.angle),
                                 name_of(grid.row.angle), varied);
  for (const char* end : {"lower", "upper"})
    text += fmt::format(
        ",{0}_reason,{0}_articular,{0}_shortfall_deg,{0}_contact_x_mm,{0}_contact_y_mm,{0}_contact_z_mm",
        end);
  text += "\n";
  const std::size_t columns = grid.column.count();
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const auto& [negative, positive] = *map.points[i];
    text += fmt::format("{},{},{},{}{}{}\n", grid.column.value_deg(i % columns),
                        grid.row.value_deg(i / columns), (grid.start - negative.turned).degrees(),
                        (grid.start + positive.turned).degrees(), csv_of(negative), csv_of(positive));
  }
  return text;
}

MapPlot plot_of(const MotionMap& map, MapView view, std::string_view joint_name) {
  assert(map.complete());
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
  for (const auto& point : map.points) {
    const auto& [negative, positive] = *point;
    switch (view) {
      case MapView::positive_limit:
        plot.values.push_back(positive.turned.degrees());
        plot.kinds.push_back(kind_of(positive.reason));
        break;
      case MapView::negative_limit:
        plot.values.push_back(negative.turned.degrees());
        plot.kinds.push_back(kind_of(negative.reason));
        break;
      case MapView::free_range:
        plot.values.push_back((negative.turned + positive.turned).degrees());
        plot.kinds.push_back(kind_of(*point));
        break;
    }
  }
  return plot;
}

}  // namespace condyle
