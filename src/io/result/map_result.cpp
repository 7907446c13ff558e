#include "io/result/map_result.hpp"

#include <fmt/format.h>

#include "condyle/io/pose_text.hpp"
#include "io/file/csv_fields.hpp"
#include "io/joint/grid_text.hpp"
#include "io/result/map_summary.hpp"
#include "io/result/movement_words.hpp"
#include "io/result/rom_result.hpp"

namespace condyle::io {
namespace {

/// Headings of what csv_of() writes.
std::string end_columns(std::string_view end) {
  return fmt::format(
      ",{0}_reason,{0}_contact_kind,{0}_error_bound_deg,{0}_bearing_contact_deg,"
      "{0}_contact_x_mm,{0}_contact_y_mm,{0}_contact_z_mm,{0}_ligament",
      end);
}

std::string csv_of(const motion::Limit& end, std::span<const Ligament> ligaments, const AnswerFrame& frame) {
  std::string text =
      fmt::format(",{},{},{},{}", name_of(end.reason),
                  end.reason == motion::LimitReason::end_of_range || end.ligament ? "" : name_of(end.kind()),
                  end.error_bound.degrees(),
                  end.bearing_contact ? fmt::format("{}", end.bearing_contact->turned.degrees()) : "");
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

std::string map_text(const motion::MotionMap& map) {
  const MapSummary summary = map_summary_of(map);
  std::string text = fmt::format(
      "map of {} over {} and {}, {} points\n", io::spaced(name_of(map.grid.vary, map.anatomy)),
      to_text(map.grid.column, map.anatomy), to_text(map.grid.row, map.anatomy), map.points.size());
  const auto line = [&](RotationSense sense, const ReasonCounts& counts) {
    text += fmt::format("  {:<18} {} end in contact, {} at the end of the range, {} in contact at start\n",
                        io::movement_words(map.grid.vary, sense, map.anatomy),
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
    text += fmt::format("  not free at the start but at other angles: {} points\n", summary.free_elsewhere);
  if (summary.with_islands > 0)
    text += fmt::format("  free again beyond contact: {} points\n", summary.with_islands);
  return text + fmt::format("  free volume        {:.6g} deg^3, {:.6g} deg^3 weighted by {}({})\n",
                            summary.volume.plain_deg3, summary.volume.weighted_deg3,
                            map.anatomy == Anatomy::shoulder ? "sin" : "cos",
                            name_of(JointAngle::adduction, map.anatomy));
}

std::string map_csv(const motion::MotionMap& map, std::span<const Ligament> ligaments,
                    const AnswerFrame& frame) {
  const motion::MapGrid& grid = map.grid;
  const std::string_view varied = name_of(grid.vary, map.anatomy);
  std::string text =
      fmt::format("{0}_deg,{1}_deg,{2}_lower_deg,{2}_upper_deg", name_of(grid.column.angle, map.anatomy),
                  name_of(grid.row.angle, map.anatomy), varied);
  for (const char* end : {"lower", "upper"}) text += end_columns(end);
  text += "\n";
  const std::size_t columns = grid.column.count();
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const motion::Limit &negative = map.points[i].from_start.negative,
                        &positive = map.points[i].from_start.positive;
    text +=
        fmt::format("{},{},{},{}{}{}\n", grid.column.value_deg(i % columns), grid.row.value_deg(i / columns),
                    (grid.start - negative.turned).degrees(), (grid.start + positive.turned).degrees(),
                    csv_of(negative, ligaments, frame), csv_of(positive, ligaments, frame));
  }
  return text;
}

std::string map_intervals_csv(const motion::MotionMap& map, std::span<const Ligament> ligaments,
                              const AnswerFrame& frame) {
  const motion::MapGrid& grid = map.grid;
  std::string text = fmt::format("{0}_deg,{1}_deg,{2}_low_deg,{2}_high_deg,holds_start",
                                 name_of(grid.column.angle, map.anatomy),
                                 name_of(grid.row.angle, map.anatomy), name_of(grid.vary, map.anatomy));
  for (const char* end : {"low", "high"}) text += end_columns(end);
  text += "\n";
  const std::size_t columns = grid.column.count();
  for (std::size_t i = 0; i < map.points.size(); ++i)
    for (const motion::FreeInterval& free : map.points[i].intervals)
      text += fmt::format("{},{},{},{},{}{}{}\n", grid.column.value_deg(i % columns),
                          grid.row.value_deg(i / columns), (grid.start + free.low).degrees(),
                          (grid.start + free.high).degrees(), free.holds_start() ? 1 : 0,
                          csv_of(free.at_low, ligaments, frame), csv_of(free.at_high, ligaments, frame));
  return text;
}

}  // namespace condyle::io
