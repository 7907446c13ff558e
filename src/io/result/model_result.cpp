#include "io/result/model_result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/version.hpp"
#include "io/file/plain_text.hpp"
#include "io/model/joint_mapping.hpp"
#include "io/model/welded_bodies.hpp"
#include "io/result/json.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle::io {
namespace {

/// A joint's kind as a joint file would state it; empty for a joint that cannot be read.
std::optional<JointMapping> mapping_of_names(const StandingModel& model, const ModelJoint& joint) {
  if (!joint.transform || joint.coordinates.empty()) return std::nullopt;
  return mapping_of(model, joint, io::anatomy_of(joint), io::side_of(joint).value_or(Side::right));
}

/// The meshes of one of a joint's bodies and of what is welded to it.
struct MeshesFound {
  std::size_t found = 0, all = 0;
  std::string why_not = {};  ///< one line if a weld or a mesh cannot be read
};

/// Looks up what inspection says of each joint of a model.
class InspectedModel {
 public:
  explicit InspectedModel(const Model& model) : standing_(model), welded_(model) {}

  std::optional<JointMapping> mapping(const ModelJoint& joint) const {
    return mapping_of_names(standing_, joint);
  }

  MeshesFound meshes(const ModelJoint& joint, BodyRole role) {
    const WeldedBodies::Group group = welded_.group_of(joint, role);
    if (group.size <= largest_group) return count(joint, role);
    const auto known = of_group_.find(group.number);
    return known != of_group_.end() ? known->second
                                    : of_group_.emplace(group.number, count(joint, role)).first->second;
  }

  /// One line if nothing can be made of the joint: itself, a weld or a mesh of its bodies cannot be read.
  std::string why_refused(const ModelJoint& joint) {
    if (!joint.transform) return joint.why_not;
    const std::string why = meshes(joint, BodyRole::fixed).why_not;
    return why.empty() ? meshes(joint, BodyRole::mobile).why_not : why;
  }

 private:
  /// Bodies, welds and meshes that hang together, up to which each joint of them is looked at by itself. A skeleton has some 200
  /// bones, of which few are welded. More are counted once for all their joints, and the welds among them like the others, as
  /// each by itself would take the square.
  static constexpr std::size_t largest_group = 500;

  MeshesFound count(const ModelJoint& joint, BodyRole role) const {
    try {
      const std::vector<ModelMesh> meshes = welded_.meshes_of(joint, role);
      const auto found = std::count_if(meshes.begin(), meshes.end(),
                                       [](const ModelMesh& mesh) { return mesh.path.has_value(); });
      return {static_cast<std::size_t>(found), meshes.size()};
    } catch (const FileError& error) {
      return {.why_not = error.what()};
    }
  }

  StandingModel standing_;
  WeldedBodies welded_;
  std::map<std::size_t, MeshesFound> of_group_;
};

std::string model_joint_text(InspectedModel& model, const ModelJoint& joint) {
  const std::string label = joint.name.empty() ? "(no name)" : joint.name;
  if (const std::string why = model.why_refused(joint); !why.empty())
    return fmt::format("  {}: {}\n", label, why);
  std::string coordinates;
  for (const ModelCoordinate& coordinate : joint.coordinates)
    coordinates += (coordinates.empty() ? "" : ", ") + coordinate.name + stop_text(coordinate, " (", ")");
  const auto mapping = model.mapping(joint);
  const MeshesFound fixed = model.meshes(joint, BodyRole::fixed),
                    mobile = model.meshes(joint, BodyRole::mobile);
  return fmt::format(
      "  {}: {} in {}, {}{}; meshes found {} of {} and {} of {}{}\n", label, joint.child_body,
      joint.parent_body, mapping ? fmt::format("{} ({})", name_of(mapping->kind), joint.type) : joint.type,
      mapping && mapping->columns.empty() ? ", posed by the model" : "", fixed.found, fixed.all, mobile.found,
      mobile.all, coordinates.empty() ? "" : "; coordinates " + coordinates);
}

std::string model_text(const Model& model) {
  std::string text = fmt::format("{}\n  model {}, version {}: {} bodies, {} joints\n", model.path.string(),
                                 model.name, model.version, model.bodies.size(), model.joints.size());
  InspectedModel inspected(model);
  for (const ModelJoint& joint : model.joints) text += model_joint_text(inspected, joint);
  for (const ModelContact& contact : model.contacts)
    text += fmt::format("  contact {}: {} on {}{}\n", contact.name, contact.casting, contact.target,
                        contact.applies ? "" : ", not applied");
  for (const ModelCoupler& coupler : model.couplers)
    text += fmt::format("  constraint {}: {} follows {}\n", coupler.name, coupler.dependent,
                        fmt::join(coupler.independent, ", "));
  if (!model.ligaments.empty()) text += fmt::format("  {} ligaments\n", model.ligaments.size());
  for (const ModelMesh& mesh : model.meshes)
    if (!mesh.path && mesh.why_not.empty())
      text += fmt::format("  missing: {} of {}\n", mesh.file, mesh.body);
  for (const auto& [kind, count] : model.ignored) text += fmt::format("  not used: {} {}\n", count, kind);
  for (const ModelNote& note : model.notes) text += fmt::format("  note: {}\n", to_text(note));
  return text;
}

Json model_coordinate_json(const ModelCoordinate& coordinate) {
  Json json{{"name", coordinate.name},
            {"motion", name_of(coordinate.motion)},
            {"default", coordinate.default_value},
            {"range", nullptr},
            {"clamped", coordinate.is_clamped},
            {"locked", coordinate.is_locked},
            {"prescribed", coordinate.is_prescribed},
            {"stop", nullable(coordinate.stop)}};
  if (coordinate.range) json["range"] = *coordinate.range;
  return json;
}

Json model_mesh_json(const ModelMesh& mesh) {
  Json json{{"body", mesh.body}, {"file", mesh.file}, {"path", nullptr}, {"scale", numbers(mesh.scale)}};
  if (mesh.path) json["path"] = mesh.path->string();
  return json;
}

Json model_ligament_json(const ModelLigament& ligament) {
  Json json{{"name", ligament.name},
            {"points", Json::array()},
            {"wraps", ligament.wraps},
            {"slack_length", ligament.slack_length},
            {"stiffness_n", ligament.stiffness_n},
            {"transition_strain", ligament.transition_strain},
            {"applies", ligament.applies}};
  for (const ModelLigament::Point& point : ligament.points)
    json["points"].push_back({{"body", point.body}, {"location", numbers(point.p)}});
  return json;
}

Json model_joint_json(InspectedModel& model, const ModelJoint& joint) {
  Json json{{"name", joint.name},
            {"type", joint.type},
            {"line", joint.line},
            {"parent_body", joint.parent_body},
            {"child_body", joint.child_body},
            {"kind", nullptr},
            {"anatomy", nullptr},
            {"side", nullptr},
            {"posed_by_model", nullptr},
            {"coordinates", Json::array()},
            {"refused", nullptr}};
  for (const ModelCoordinate& coordinate : joint.coordinates)
    json["coordinates"].push_back(model_coordinate_json(coordinate));
  if (std::string why = model.why_refused(joint); !why.empty()) json["refused"] = std::move(why);
  if (const auto anatomy = io::anatomy_of(joint)) json["anatomy"] = name_of(*anatomy);
  if (const auto side = io::side_of(joint)) json["side"] = name_of(*side);
  if (const auto mapping = model.mapping(joint)) {
    json["kind"] = name_of(mapping->kind);
    json["posed_by_model"] = mapping->columns.empty();
  }
  return json;
}

Json model_json(const Model& model) {
  Json json{{"file", model.path.string()}, {"name", model.name}, {"version", model.version}};
  json["bodies"] = model.bodies;
  for (const char* list : {"joints", "meshes", "contacts", "couplers", "ligaments"})
    json[list] = Json::array();
  InspectedModel inspected(model);
  for (const ModelJoint& joint : model.joints) json["joints"].push_back(model_joint_json(inspected, joint));
  for (const ModelMesh& mesh : model.meshes) json["meshes"].push_back(model_mesh_json(mesh));
  for (const ModelContact& contact : model.contacts)
    json["contacts"].push_back({{"name", contact.name},
                                {"casting", contact.casting},
                                {"target", contact.target},
                                {"applies", contact.applies}});
  for (const ModelCoupler& coupler : model.couplers)
    json["couplers"].push_back(
        {{"name", coupler.name}, {"dependent", coupler.dependent}, {"independent", coupler.independent}});
  for (const ModelLigament& ligament : model.ligaments)
    json["ligaments"].push_back(model_ligament_json(ligament));
  json["not_used"] = Json(model.ignored);
  json["notes"] = Json::array();
  for (const ModelNote& note : model.notes)
    json["notes"].push_back({{"code", name_of(note.code)}, {"text", note.text}});
  return json;
}

}  // namespace

std::string models_text(std::span<const Model> models) {
  std::string text;
  for (const Model& model : models) text += plain_text(model_text(model), LineEnds::keep);
  return text;
}

std::string models_json(std::span<const Model> models, const std::vector<std::string>& command) {
  Json list = Json::array(), files = Json::array();
  for (const Model& model : models) {
    list.push_back(model_json(model));
    files.push_back(file_json(model.path, model.digest));
  }
  return document(
      {{"models", std::move(list)},
       {"provenance", {{"version", version}, {"command", command}, {"models", std::move(files)}}}});
}

}  // namespace condyle::io
