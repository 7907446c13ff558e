#include <fmt/format.h>

#include "condyle/error.hpp"
#include "condyle/io/model_file.hpp"
#include "core/near_name.hpp"
#include "io/file/in_quotes.hpp"
#include "io/model/spatial_transform.hpp"

namespace condyle::io {

std::string_view name_of(CoordinateMotion motion) noexcept {
  switch (motion) {
    case CoordinateMotion::rotational:
      return "rotational";
    case CoordinateMotion::translational:
      return "translational";
    case CoordinateMotion::coupled:
      break;
  }
  return "coupled";
}

std::string_view name_of(ModelNoteCode code) noexcept {
  switch (code) {
    case ModelNoteCode::missing_mesh:
      return "missing_mesh";
    case ModelNoteCode::other_case:
      return "other_case";
    case ModelNoteCode::mirrored:
      return "mirrored";
    case ModelNoteCode::uneven_scale:
      return "uneven_scale";
    case ModelNoteCode::repeated_mesh:
      return "repeated_mesh";
    case ModelNoteCode::not_used:
      return "not_used";
    case ModelNoteCode::welded:
      return "welded";
    case ModelNoteCode::oblique_axis:
      return "oblique_axis";
    case ModelNoteCode::turned_frame:
      return "turned_frame";
    case ModelNoteCode::given_otherwise:
      return "given_otherwise";
    case ModelNoteCode::contact_left_out:
      return "contact_left_out";
    case ModelNoteCode::several_contacts:
      return "several_contacts";
    case ModelNoteCode::measured_thickness:
      return "measured_thickness";
    case ModelNoteCode::reverse_passed_over:
      return "reverse_passed_over";
    case ModelNoteCode::exchanged_bodies:
      return "exchanged_bodies";
    case ModelNoteCode::coupled_coordinate:
      return "coupled_coordinate";
    case ModelNoteCode::no_length_unit:
      return "no_length_unit";
    case ModelNoteCode::no_name:
      return "no_name";
    case ModelNoteCode::left_out:
      break;
  }
  return "left_out";
}

std::string to_text(const ModelNote& note) {
  return fmt::format("{}: {}", name_of(note.code), note.text);
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
