#include "condyle/io/jam_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <set>
#include <string>
#include <string_view>

#include "condyle/error.hpp"
#include "io/file/h5_image.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/whole_file.hpp"

/// Names and shapes are those of OpenSim-JAM (opensim-jam-org/opensim-core: writeH5File of OpenSim/JAM/JointMechanicsTool.cpp,
/// the outputs of OpenSim/Simulation/Model/Smith2018ArticularContactForce.h without their "casting_" or "target_"; regions as
/// Smith2018ContactMesh.cpp there sorts triangles).

namespace condyle::io {
namespace {

/// Whether JAM's scripts (jam_analysis.m) can take this as the name of a field.
bool is_field_name(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && name.size() <= 63 && is_letter(name[0]) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

void check_names(const std::filesystem::path& path, std::span<const JamContact> contacts,
                 std::span<const JamCoordinate> coordinates) {
  const auto fail = [&](std::string_view what) {
    throw FileError(fmt::format("{}: cannot be written: {}", path.string(), what));
  };
  const auto check = [&](const std::string& name) {
    if (!is_field_name(name))
      fail(fmt::format("{} must be a letter and then up to 62 letters, digits and _", io::in_quotes(name)));
  };
  std::set<std::string_view> known;
  for (const auto& [name, casting, target] : contacts) {
    for (const std::string& each : {name, casting.mesh, target.mesh}) check(each);
    if (!known.insert(name).second) fail(fmt::format("contact {} is there twice", io::in_quotes(name)));
    if (casting.mesh == target.mesh)
      fail(fmt::format("contact {} has two meshes of one name, {}", io::in_quotes(name),
                       io::in_quotes(target.mesh)));
  }
  known.clear();
  for (const auto& [name, values] : coordinates) {
    check(name);
    if (!known.insert(name).second) fail(fmt::format("coordinate {} is there twice", io::in_quotes(name)));
  }
}

/// Visits the values of totals, by JAM's names for them.
void for_each_of_totals(const auto& scalar, const auto& vector) {
  scalar("contact_area", &JamTotals::contact_area_m2);
  scalar("mean_proximity", &JamTotals::mean_proximity_m);
  scalar("max_proximity", &JamTotals::max_proximity_m);
  vector("center_of_proximity", &JamTotals::centre_of_proximity_m);
  scalar("mean_pressure", &JamTotals::mean_pressure_pa);
  scalar("max_pressure", &JamTotals::max_pressure_pa);
  vector("center_of_pressure", &JamTotals::centre_of_pressure_m);
  vector("contact_force", &JamTotals::contact_force_n);
  vector("contact_moment", &JamTotals::contact_moment_nm);
}

/// A vector of totals_of(frame) in each row.
void add_vectors(H5Image& file, const std::string& path, const std::vector<JamFrame>& frames,
                 Vec3 JamTotals::*member, const auto& totals_of) {
  std::vector<double> values;
  for (const JamFrame& frame : frames)
    for (const double value : totals_of(frame).*member) values.push_back(value);
  file.numbers(path, values, frames.size(), 3);
}

void add_totals(H5Image& file, const std::string& group, const std::vector<JamFrame>& frames) {
  const std::string start = group + "/total_";
  for_each_of_totals(
      [&](const std::string& name, double JamTotals::*member) {
        std::vector<double> values;
        for (const JamFrame& frame : frames) values.push_back(frame.total.*member);
        file.numbers(start + name, values, frames.size(), 0);
      },
      [&](const std::string& name, Vec3 JamTotals::*member) {
        add_vectors(file, start + name, frames, member,
                    [](const JamFrame& frame) -> const JamTotals& { return frame.total; });
      });
}

/// A column for each region; of vectors a data set for each, named by its number.
void add_regions(H5Image& file, const std::string& group, const std::vector<JamFrame>& frames) {
  const std::string start = group + "/regional_";
  for_each_of_totals(
      [&](const std::string& name, double JamTotals::*member) {
        std::vector<double> values;
        for (const JamFrame& frame : frames)
          for (const JamTotals& region : frame.regional) values.push_back(region.*member);
        file.numbers(start + name, values, frames.size(), jam_regions);
      },
      [&](const std::string& name, Vec3 JamTotals::*member) {
        file.group(start + name);
        for (std::size_t region = 0; region < jam_regions; ++region)
          add_vectors(file, start + name + "/" + std::to_string(region), frames, member,
                      [&](const JamFrame& frame) -> const JamTotals& { return frame.regional[region]; });
      });
}

void add_triangles(H5Image& file, const std::string& path, const std::vector<JamFrame>& frames,
                   std::vector<double> JamFrame::*member) {
  const std::size_t triangles = (frames.front().*member).size();
  std::vector<double> values;
  for (const JamFrame& frame : frames)
    values.insert(values.end(), (frame.*member).begin(), (frame.*member).end());
  if (triangles > 0) file.numbers(path, values, frames.size(), triangles);
}

void add_surface(H5Image& file, const std::string& contact, const JamSurface& surface) {
  const std::string group = contact + "/" + surface.mesh;
  file.group(group);
  const std::vector<JamFrame>& frames = surface.frames;
  if (frames.empty()) return;
  add_totals(file, group, frames);
  if (!frames.front().regional.empty()) add_regions(file, group, frames);
  add_triangles(file, group + "/triangle_proximity", frames, &JamFrame::triangle_proximity_m);
  add_triangles(file, group + "/triangle_pressure", frames, &JamFrame::triangle_pressure_pa);
}

std::string jam_bytes(std::span<const double> times_s, std::span<const JamContact> contacts,
                      std::span<const JamCoordinate> coordinates) {
  H5Image file;
  file.numbers("/time", {times_s.begin(), times_s.end()}, times_s.size(), 0);
  const std::string forces = "/model/forceset/Smith2018ArticularContactForce";
  for (const char* group : {"/model", "/model/forceset", forces.c_str()}) file.group(group);
  if (!coordinates.empty()) file.group("/model/coordinateset");
  for (const auto& [name, values] : coordinates) {
    assert(values.size() == times_s.size());
    const std::string group = "/model/coordinateset/" + name;
    file.group(group);
    file.numbers(group + "/value", values, values.size(), 0);
  }
  for (const JamContact& contact : contacts) {
    file.group(forces + "/" + contact.name);
    for (const JamSurface* surface : {&contact.casting, &contact.target}) {
      assert(surface->frames.empty() || surface->frames.size() == times_s.size());
      for ([[maybe_unused]] const JamFrame& frame : surface->frames)
        assert(frame.regional.size() == (surface->frames.front().regional.empty() ? 0 : jam_regions));
      add_surface(file, forces + "/" + contact.name, *surface);
    }
  }
  return file.bytes();
}

}  // namespace

void write_jam_file(const std::filesystem::path& path, std::span<const double> times_s,
                    std::span<const JamContact> contacts, std::span<const JamCoordinate> coordinates) {
  check_names(path, contacts, coordinates);
  std::string bytes;
  try {
    bytes = jam_bytes(times_s, contacts, coordinates);
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
  }
  io::write_whole_file(path, bytes);
}

}  // namespace condyle::io
