#include "condyle/io/jam_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "condyle/error.hpp"
#include "io/file/h5_image.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/whole_file.hpp"

/// Names and shapes are those of OpenSim-JAM (opensim-jam-org/opensim-core: writeH5File of OpenSim/JAM/JointMechanicsTool.cpp,
/// the outputs of OpenSim/Simulation/Model/Smith2018ArticularContactForce.h without their "casting_" or "target_").

namespace condyle {
namespace {

/// What JAM's scripts (jam_analysis.m) can take as the name of a field.
bool is_field_name(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && name.size() <= 63 && is_letter(name[0]) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

void check_names(const std::filesystem::path& path, std::span<const JamContact> contacts) {
  const auto fail = [&](std::string_view what) {
    throw FileError(fmt::format("{}: cannot be written: {}", path.string(), what));
  };
  std::set<std::string_view> known;
  for (const auto& [name, casting, target] : contacts) {
    for (const std::string& each : {name, casting.mesh, target.mesh})
      if (!is_field_name(each))
        fail(fmt::format("{} must be a letter and then up to 62 letters, digits and _", io::in_quotes(each)));
    if (!known.insert(name).second) fail(fmt::format("contact {} is there twice", io::in_quotes(name)));
    if (casting.mesh == target.mesh)
      fail(fmt::format("contact {} has two meshes of one name, {}", io::in_quotes(name),
                       io::in_quotes(target.mesh)));
  }
}

void add(io::H5Image& file, const std::string& path, double JamFrame::*member,
         const std::vector<JamFrame>& frames) {
  std::vector<double> values;
  for (const JamFrame& frame : frames) values.push_back(frame.*member);
  file.numbers(path, values, frames.size(), 0);
}

void add(io::H5Image& file, const std::string& path, Vec3 JamFrame::*member,
         const std::vector<JamFrame>& frames) {
  std::vector<double> values;
  for (const JamFrame& frame : frames)
    for (const double value : frame.*member) values.push_back(value);
  file.numbers(path, values, frames.size(), 3);
}

void add(io::H5Image& file, const std::string& path, std::vector<double> JamFrame::*member,
         const std::vector<JamFrame>& frames) {
  const std::size_t triangles = (frames.front().*member).size();
  std::vector<double> values;
  for (const JamFrame& frame : frames)
    values.insert(values.end(), (frame.*member).begin(), (frame.*member).end());
  if (triangles > 0) file.numbers(path, values, frames.size(), triangles);
}

void add_surface(io::H5Image& file, const std::string& contact, const JamSurface& surface) {
  const std::string group = contact + "/" + surface.mesh;
  file.group(group);
  if (surface.frames.empty()) return;
  const auto each = [&](const char* name, auto member) {
    add(file, group + "/" + name, member, surface.frames);
  };
  each("total_contact_area", &JamFrame::contact_area_m2);
  each("total_mean_proximity", &JamFrame::mean_proximity_m);
  each("total_max_proximity", &JamFrame::max_proximity_m);
  each("total_center_of_proximity", &JamFrame::centre_of_proximity_m);
  each("total_mean_pressure", &JamFrame::mean_pressure_pa);
  each("total_max_pressure", &JamFrame::max_pressure_pa);
  each("total_center_of_pressure", &JamFrame::centre_of_pressure_m);
  each("total_contact_force", &JamFrame::contact_force_n);
  each("total_contact_moment", &JamFrame::contact_moment_nm);
  each("triangle_proximity", &JamFrame::triangle_proximity_m);
  each("triangle_pressure", &JamFrame::triangle_pressure_pa);
}

std::string jam_bytes(std::span<const double> times_s, std::span<const JamContact> contacts) {
  io::H5Image file;
  file.numbers("/time", {times_s.begin(), times_s.end()}, times_s.size(), 0);
  const std::string forces = "/model/forceset/Smith2018ArticularContactForce";
  for (const char* group : {"/model", "/model/forceset", forces.c_str()}) file.group(group);
  for (const JamContact& contact : contacts) {
    file.group(forces + "/" + contact.name);
    for (const JamSurface* surface : {&contact.casting, &contact.target}) {
      assert(surface->frames.empty() || surface->frames.size() == times_s.size());
      add_surface(file, forces + "/" + contact.name, *surface);
    }
  }
  return file.bytes();
}

}  // namespace

void write_jam_file(const std::filesystem::path& path, std::span<const double> times_s,
                    std::span<const JamContact> contacts) {
  check_names(path, contacts);
  std::string bytes;
  try {
    bytes = jam_bytes(times_s, contacts);
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
  }
  io::write_whole_file(path, bytes);
}

}  // namespace condyle
