#include "condyle/io/rom_files.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "condyle/io/map_result.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/output_folder.hpp"
#include "condyle/io/zone_result.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/clock_contacts.hpp"
#include "io/result/plot_clock_face.hpp"
#include "io/result/plot_limits.hpp"
#include "io/result/plot_map.hpp"

namespace condyle {
namespace {

void write_zones(OutputFolder& out, const RomResult& result) {
  for (std::size_t i = 0; i < result.zones.size(); ++i) {
    if (!result.zones[i]) continue;
    const ImpingementZone& zone = *result.zones[i];
    const auto write = [&](std::string_view role, const TriMesh& mesh, const BodyZone& body) {
      const MeshArray in_zone = zone_cell_array(body, mesh.triangles.size());
      const std::string motion = file_name_part(zone.limit.motion.name);
      write_vtp(out.file(fmt::format("zone_{:02}_{}_{}.vtp", i + 1, motion, role)), mesh,
                zone_point_arrays(body), {&in_zone, 1});
    };
    write("fixed", result.joint.fixed.mesh, zone.fixed);
    write("mobile", posed(zone_pose(zone, result.joint.side), result.joint.mobile.mesh), zone.mobile);
  }
}

void write_map(OutputFolder& out, const MotionMap& map, std::string_view joint_name) {
  const auto draw = [&](std::string_view name, io::MapView view) {
    io::write_whole_file(out.file(fmt::format("map_{}.svg", name)),
                         io::map_plot(io::plot_of(map, view, joint_name)));
  };
  io::write_whole_file(out.file("map.csv"), map_csv(map));
  draw(movement_name(map.grid.vary, RotationSense::positive), io::MapView::positive_limit);
  draw(movement_name(map.grid.vary, RotationSense::negative), io::MapView::negative_limit);
  draw("free_range", io::MapView::free_range);
}

/// The mobile body at zero angles, triangles of the bearing surface marked.
void write_bearing(OutputFolder& out, const RomResult& result) {
  if (!result.bearing.surface) return;
  const auto& marks = result.bearing.surface->triangles;
  const MeshArray bearing{"bearing", marks};
  write_vtp(out.file("bearing.vtp"), result.joint.mobile.mesh, {}, {&bearing, 1});
}

}  // namespace

void write_rom(const std::filesystem::path& folder, const RomResult& result) {
  OutputFolder out(folder);
  const std::string& name = result.joint.name;
  io::write_whole_file(out.file("rom.json"), rom_json(result));
  io::write_whole_file(out.file("limits.csv"), rom_csv(result));
  io::write_whole_file(
      out.file("limits.svg"),
      io::limits_plot({name, "How far each motion turns from its start"}, result.limits, result.bands));
  if (result.joint.kind == JointKind::ball)
    io::write_whole_file(out.file("clock_face.svg"),
                         io::clock_face_plot({name,
                                              "Where motions end, seen from the joint centre in the sagittal "
                                              "plane: 12 superior, 3 anterior"},
                                             io::clock_contacts(result)));
  write_bearing(out, result);
  write_zones(out, result);
  if (result.map) write_map(out, *result.map, name);
  out.commit();
}

}  // namespace condyle
