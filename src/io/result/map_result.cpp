#include "io/result/map_result.hpp"

#include <fmt/format.h>

#include "condyle/io/pose_text.hpp"
#include "io/file/csv_fields.hpp"
#include "io/joint/grid_text.hpp"
#include "io/result/map_summary.hpp"
#include "io/result/movement_words.hpp"

namespace condyle::io {
namespace {

/// Headings of what csv_of() writes, and before them those of the point and of what is free.
std::string header_of(const motion::MotionMap& map, std::string_view low, std::string_view high,
                      std::string_view more) {
  const motion::MapGrid& grid = map.grid;
  const auto name = [&](motion::MapCoordinate coordinate) { return name_of(coordinate, map.anatomy); };
  const std::string_view unit = grid.vary.unit();
  std::string text = fmt::format("{0}_{1},{2}_{3},{4}_{5}_{7},{4}_{6}_{7}{8}", name(grid.column.coordinate),
                                 grid.column.coordinate.unit(), name(grid.row.coordinate),
                                 grid.row.coordinate.unit(), name(grid.vary), low, high, unit, more);
  for (const std::string_view end : {low, high})
    text += fmt::format(
        ",{0}_reason,{0}_contact_kind,{0}_error_bound_{1},{0}_bearing_contact_{1},"
        "{0}_contact_x_mm,{0}_contact_y_mm,{0}_contact_z_mm,{0}_ligament",
        end, unit);
  return text + "\n";
}

std::string csv_of(const motion::MapEnd& end, std::span<const Ligament> ligaments, const AnswerFrame& frame) {
  std::string text =
      fmt::format(",{},{},{},{}", name_of(end.reason),
                  end.reason == motion::LimitReason::end_of_range || end.ligament ? "" : name_of(end.kind()),
                  end.error_bound, end.bearing_contact ? fmt::format("{}", *end.bearing_contact) : "");
  if (end.ligament) return text + ",,,," + csv_field(ligaments[*end.ligament].name);
  if (!end.contact) return text + ",,,,";
  const Vec3 p = frame.fixed_point(end.contact->fixed_point);
  return text + fmt::format(",{},{},{},", p.x(), p.y(), p.z());
}

}  // namespace

std::string_view movement_name(JointAngle angle, RotationSense sense, Anatomy joint) noexcept {
  const auto& [positive, negative] = coordinate_names(joint)[static_cast<std::size_t>(angle)];
  return sense == RotationSense::positive ? positive : negative;
}

std::string movement_name(motion::MapCoordinate coordinate, RotationSense sense, Anatomy joint) {
  if (coordinate.is_angle()) return std::string(movement_name(coordinate.angle(), sense, joint));
  return (sense == RotationSense::positive ? "" : "negative_") + std::string(name_of(coordinate, joint));
}

std::string map_text(const motion::MotionMap& map) {
  const MapSummary summary = map_summary_of(map);
  std::string text =
      fmt::format("map of {} over {} and {}, {} points\n", io::spaced(name_of(map.grid.vary, map.anatomy)),
                  to_text(map.grid.column, map.anatomy), to_text(map.grid.row, map.anatomy), map.grid.size());
  const auto line = [&](RotationSense sense, const ReasonCounts& counts) {
    text += fmt::format("  {:<18} {} end in contact, {} at the end of the range, {} in contact at start\n",
                        io::spaced(movement_name(map.grid.vary, sense, map.anatomy)),
                        counts[motion::LimitReason::contact], counts[motion::LimitReason::end_of_range],
                        counts[motion::LimitReason::contact_at_start]);
    if (const std::size_t count =
            counts[motion::LimitReason::ligament] + counts[motion::LimitReason::strained_at_start];
        count > 0)
      text += fmt::format("  {:<18} {} end by a ligament\n", "", count);
  };
  line(RotationSense::positive, summary.positive_ends);
  line(RotationSense::negative, summary.negative_ends);
  if (summary.free_elsewhere > 0)
    text += fmt::format("  not free at the start but at other {}: {} points\n",
                        map.grid.vary.is_angle() ? "angles" : "places", summary.free_elsewhere);
  if (summary.with_islands > 0)
    text += fmt::format("  free again beyond contact: {} points\n", summary.with_islands);
  if (map.grid.translates()) return text;
  return text + fmt::format("  free volume        {:.6g} deg^3, {:.6g} deg^3 weighted by {}({})\n",
                            summary.volume.plain_deg3, summary.volume.weighted_deg3,
                            map.anatomy == Anatomy::shoulder ? "sin" : "cos",
                            name_of(JointAngle::adduction, map.anatomy));
}

std::string map_csv(const motion::MotionMap& map, std::span<const Ligament> ligaments,
                    const AnswerFrame& frame) {
  const motion::MapGrid& grid = map.grid;
  std::string text = header_of(map, "lower", "upper", "");
  const std::size_t columns = grid.column.count();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const motion::MapPoint point = map.point(i);
    text += fmt::format("{},{},{},{}{}{}\n", grid.column.value(i % columns), grid.row.value(i / columns),
                        point.negative.value, point.positive.value, csv_of(point.negative, ligaments, frame),
                        csv_of(point.positive, ligaments, frame));
  }
  return text;
}

std::string map_intervals_csv(const motion::MotionMap& map, std::span<const Ligament> ligaments,
                              const AnswerFrame& frame) {
  const motion::MapGrid& grid = map.grid;
  std::string text = header_of(map, "low", "high", ",holds_start");
  const std::size_t columns = grid.column.count();
  for (std::size_t i = 0; i < grid.size(); ++i)
    for (const motion::MapInterval& free : map.point(i).intervals)
      text += fmt::format("{},{},{},{},{}{}{}\n", grid.column.value(i % columns), grid.row.value(i / columns),
                          free.low.value, free.high.value, free.holds_start() ? 1 : 0,
                          csv_of(free.low, ligaments, frame), csv_of(free.high, ligaments, frame));
  return text;
}

}  // namespace condyle::io
