#include <fmt/format.h>

#include <iterator>
#include <numbers>

#include "condyle/error.hpp"
#include "condyle/io/model_file.hpp"
#include "core/near_name.hpp"
#include "io/file/in_quotes.hpp"
#include "io/model/spatial_transform.hpp"

namespace condyle::io {

std::string_view name_of(CoordinateMotion motion) noexcept {
  constexpr std::string_view names[] = {"rotational", "translational", "coupled"};
  static_assert(std::size(names) == static_cast<std::size_t>(CoordinateMotion::coupled) + 1);
  return names[static_cast<std::size_t>(motion)];
}

std::string_view name_of(ModelNoteCode code) noexcept {
  constexpr std::string_view names[] = {"missing_mesh",
                                        "other_case",
                                        "mirrored",
                                        "uneven_scale",
                                        "repeated_mesh",
                                        "not_used",
                                        "welded",
                                        "oblique_axis",
                                        "turned_frame",
                                        "given_otherwise",
                                        "contact_left_out",
                                        "several_contacts",
                                        "measured_thickness",
                                        "reverse_passed_over",
                                        "exchanged_bodies",
                                        "coupled_coordinate",
                                        "no_length_unit",
                                        "no_name",
                                        "ligament_left_out",
                                        "endless_cylinder",
                                        "unlikely_range",
                                        "left_out"};
  static_assert(std::size(names) == static_cast<std::size_t>(ModelNoteCode::left_out) + 1);
  return names[static_cast<std::size_t>(code)];
}

std::string to_text(const ModelNote& note) {
  return fmt::format("{}: {}", name_of(note.code), note.text);
}

std::string stop_text(const ModelCoordinate& coordinate, std::string_view before, std::string_view behind) {
  if (!coordinate.stop) return {};
  const bool is_angle = coordinate.motion == CoordinateMotion::rotational;
  const double unit = is_angle ? 180 / std::numbers::pi : 1;
  const char* unit_name = is_angle ? "deg" : coordinate.motion == CoordinateMotion::coupled ? "rad" : "m";
  return fmt::format("{}held from {:.6g} to {:.6g} {} by a force{}", before, unit * (*coordinate.stop)[0],
                     unit * (*coordinate.stop)[1], unit_name, behind);
}

std::vector<double> ModelJoint::defaults() const {
  std::vector<double> values;
  for (const ModelCoordinate& coordinate : coordinates) values.push_back(coordinate.default_value);
  return values;
}

Pose pose_of(const ModelJoint& joint, std::span<const double> q) {
  if (!joint.transform) throw FileError(joint.why_not);
  if (q.size() != joint.coordinates.size())
    throw UsageError(fmt::format("joint {} has {} coordinates, and {} values are given",
                                 io::in_quotes(joint.name), joint.coordinates.size(), q.size()));
  return joint.X_PF * io::pose_of(joint.transform->axes, q) * inverted(joint.X_CM);
}

const ModelJoint& joint_named(const Model& model, std::string_view name) {
  std::vector<std::string> names;
  for (const ModelJoint& joint : model.joints) {
    if (joint.name.empty()) continue;  // nobody can ask for it
    if (joint.name == name) {
      if (!joint.transform) throw FileError(joint.why_not);
      return joint;
    }
    names.push_back(joint.name);
  }
  std::string list;
  for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
  throw UsageError(fmt::format("{}: no joint {}{}; there are {}", model.path.string(), io::in_quotes(name),
                               core::did_you_mean(name, names), list.empty() ? "none" : list));
}

}  // namespace condyle::io
