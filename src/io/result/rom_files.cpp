#include "io/result/rom_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "condyle/io/mesh_file.hpp"
#include "io/file/figure_ending.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/crate.hpp"
#include "io/result/map_result.hpp"
#include "io/result/map_summary.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/zone_result.hpp"

namespace condyle::io {
namespace {

/// Whether it is what condyle.plot draws of some result: of an earlier one, it would belie this one.
bool is_drawn_of_rom(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  if (dot == name.npos || !io::is_figure_ending(name.substr(dot))) return false;
  const std::string_view stem = name.substr(0, dot);
  for (const std::string_view each : {"limits", "limit_bands", "clock_face", "map_free_range"})
    if (stem == each) return true;
  for (const Anatomy joint : all_anatomies)
    for (const auto& [positive, negative] : coordinate_names(joint))
      for (const std::string_view movement : {positive, negative})
        if (stem == fmt::format("map_{}", movement) || stem == fmt::format("map_{}_ends", movement))
          return true;
  for (const std::string_view translation : {"x", "y", "z"})
    if (stem == fmt::format("map_{}", translation) || stem == fmt::format("map_negative_{}", translation))
      return true;
  return false;
}

/// Whether some result has a file of this name.
bool is_of_rom(std::string_view name) {
  if (name.starts_with("zone_")) return name.ends_with("_fixed.vtp") || name.ends_with("_mobile.vtp");
  static constexpr std::string_view names[] = {"rom.json",          "limits.csv", "bearing.vtp", "map.csv",
                                               "map_intervals.csv", "map.vtp",    crate_name};
  return std::find(std::begin(names), std::end(names), name) != std::end(names) || is_drawn_of_rom(name);
}

void write_zones(OutputFolder& out, const RomResult& result, const VtpOptions& vtp) {
  for (std::size_t i = 0; i < result.answer.zones.size(); ++i) {
    if (!result.answer.zones[i]) continue;
    const motion::ImpingementZone& zone = *result.answer.zones[i];
    const auto write = [&](std::string_view role, const TriMesh& mesh, const motion::BodyZone& body) {
      const MeshArray in_zone = zone_cell_array(body, mesh.triangles.size());
      const std::string motion = file_name_part(zone.limit.motion.name);
      write_vtp(out.file(fmt::format("zone_{:02}_{}_{}.vtp", i + 1, motion, role)), mesh,
                zone_point_arrays(body), {&in_zone, 1}, vtp);
    };
    const AnswerFrame frame = frame_of(result);
    const Pose X_FM = zone_pose(zone, result.joint.coordinates());
    write("fixed", frame.fixed_mesh(result.joint.fixed.mesh), zone.fixed);
    write("mobile", frame.fixed_mesh(posed(X_FM, result.joint.mobile.mesh)), zone.mobile);
  }
}

/// Code of the reason for an interval's end in a VTP file.
std::int32_t code_of(motion::LimitReason reason) noexcept {
  switch (reason) {
    case motion::LimitReason::end_of_range:
      return 0;
    case motion::LimitReason::contact:
    case motion::LimitReason::contact_at_start:
      return 1;
    case motion::LimitReason::ligament:
    case motion::LimitReason::strained_at_start:
      return 2;
  }
  return 1;
}
constexpr std::int32_t nothing_free = -1;

/// Which of the joint's ligaments makes an interval's end.
std::int32_t ligament_of(const motion::MapEnd& end) noexcept {
  return end.ligament ? static_cast<std::int32_t>(*end.ligament) : -1;
}

/// Names of the ligaments, each with its line's end, and which of them end the free intervals.
void add_ligaments(const motion::MotionMap& map, std::span<const Ligament> ligaments, VtpOptions& options) {
  std::string names;
  for (const Ligament& ligament : ligaments) names += ligament.name + "\n";
  std::vector<double> low, high;
  for (std::size_t i = 0; i < map.grid.size(); ++i)
    for (const motion::MapInterval& free : map.point(i).intervals) {
      low.push_back(ligament_of(free.low));
      high.push_back(ligament_of(free.high));
    }
  options.fields.push_back({"ligaments", std::move(names)});
  options.fields.push_back({"interval_low_ligament", std::move(low)});
  options.fields.push_back({"interval_high_ligament", std::move(high)});
}

/// The free intervals of all points, which are more than a value per point.
void add_intervals(const motion::MotionMap& map, VtpOptions& options) {
  MapIntervals all = all_intervals(map);
  const auto codes = [](const std::vector<motion::LimitReason>& reasons) {
    std::vector<double> numbers;
    for (const motion::LimitReason reason : reasons) numbers.push_back(code_of(reason));
    return numbers;
  };
  options.fields.push_back({"interval_offset", std::vector<double>(all.offset.begin(), all.offset.end())});
  options.fields.push_back({fmt::format("interval_low_{}", map.grid.vary.unit()), std::move(all.low)});
  options.fields.push_back({fmt::format("interval_high_{}", map.grid.vary.unit()), std::move(all.high)});
  options.fields.push_back({"interval_low_reason", codes(all.low_reason)});
  options.fields.push_back({"interval_high_reason", codes(all.high_reason)});
}

/// The grid as a flat surface in degrees and mm, columns along x and rows along y, with what is free at its points.
void write_map_surface(const std::filesystem::path& path, const motion::MotionMap& map,
                       std::span<const Ligament> ligaments, VtpOptions options) {
  const std::size_t columns = map.grid.column.count(), rows = map.grid.row.count();
  TriMesh surface;
  std::vector<double> lower, upper, width;
  std::vector<std::int32_t> intervals, lower_reason, upper_reason, lower_ligament, upper_ligament;
  std::vector<std::uint8_t> free_at_start;
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    surface.vertices.push_back({map.grid.column.value(i % columns), map.grid.row.value(i / columns), 0});
    const motion::MapPoint point = map.point(i);
    const motion::MapInterval* drawn = point.nearest_to_start();
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    lower.push_back(drawn ? drawn->low.value : none);
    upper.push_back(drawn ? drawn->high.value : none);
    lower_reason.push_back(drawn ? code_of(drawn->low.reason) : nothing_free);
    upper_reason.push_back(drawn ? code_of(drawn->high.reason) : nothing_free);
    lower_ligament.push_back(drawn ? ligament_of(drawn->low) : -1);
    upper_ligament.push_back(drawn ? ligament_of(drawn->high) : -1);
    double free = 0;
    for (const motion::MapInterval& interval : point.intervals) free += interval.width;
    width.push_back(free);
    intervals.push_back(static_cast<std::int32_t>(point.intervals.size()));
    free_at_start.push_back(point.free_at_start() ? 1 : 0);
  }
  for (std::size_t row = 0; row + 1 < rows; ++row)
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const auto a = static_cast<Index>(row * columns + column), b = a + 1;
      const auto d = static_cast<Index>(a + columns), c = d + 1;
      surface.triangles.push_back({a, b, c});
      surface.triangles.push_back({a, c, d});
    }
  const auto in_unit = [&](std::string_view name) {
    return fmt::format("{}_{}", name, map.grid.vary.unit());
  };
  std::vector<MeshArray> arrays = {
      {in_unit("free_width"), std::move(width)},  {in_unit("lower"), std::move(lower)},
      {in_unit("upper"), std::move(upper)},       {"lower_reason", std::move(lower_reason)},
      {"upper_reason", std::move(upper_reason)},  {"free_intervals", std::move(intervals)},
      {"free_at_start", std::move(free_at_start)}};
  add_intervals(map, options);
  if (!ligaments.empty()) {
    arrays.push_back({"lower_ligament", std::move(lower_ligament)});
    arrays.push_back({"upper_ligament", std::move(upper_ligament)});
    add_ligaments(map, ligaments, options);
  }
  write_vtp(path, surface, arrays, {}, options);
}

void write_map(OutputFolder& out, const RomResult& result, const VtpOptions& vtp) {
  const motion::MotionMap& map = *result.answer.map;
  const std::string comments = io::provenance_comments(result.provenance, result.notes);
  io::write_whole_file(out.file("map.csv"),
                       comments + map_csv(map, result.joint.ligaments, frame_of(result)));
  io::write_whole_file(out.file("map_intervals.csv"),
                       comments + map_intervals_csv(map, result.joint.ligaments, frame_of(result)));
  if (map.grid.row.count() > 1 && map.grid.column.count() > 1)
    write_map_surface(out.file("map.vtp"), map, result.joint.ligaments, vtp);
}

/// The mobile body at zero angles, triangles of the bearing surface marked.
void write_bearing(OutputFolder& out, const RomResult& result, const VtpOptions& vtp) {
  if (!result.answer.bearing.surface) return;
  const auto& marks = result.answer.bearing.surface->triangles;
  const MeshArray bearing{"bearing", marks};
  write_vtp(out.file("bearing.vtp"), frame_of(result).mobile_mesh(result.joint.mobile.mesh), {},
            {&bearing, 1}, vtp);
}

}  // namespace

void check_rom_folder(const std::filesystem::path& folder, const Provenance* from) {
  OutputFolder{folder, is_of_rom, io::files_read(from)};
}

std::vector<std::filesystem::path> write_rom(const std::filesystem::path& folder, const RomResult& result,
                                             VtpEncoding encoding,
                                             const std::optional<std::string>& crate_date) {
  OutputFolder out(folder, is_of_rom, io::files_read(result.provenance), "rom.json");
  io::write_whole_file(out.file("rom.json"), rom_json(result));
  io::write_whole_file(out.file("limits.csv"), rom_csv(result));
  const VtpOptions vtp{encoding, io::provenance_fields(result.provenance)};
  write_bearing(out, result, vtp);
  write_zones(out, result, vtp);
  if (result.answer.map) write_map(out, result, vtp);
  if (crate_date && result.provenance != nullptr)
    write_crate(out, crate_run_of(*result.provenance, *crate_date, "condyle rom"));
  return out.commit();
}

}  // namespace condyle::io
