#include "io/result/frame_result.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "condyle/io/pose_text.hpp"
#include "core/rounded.hpp"
#include "io/file/shown_point.hpp"
#include "io/result/json.hpp"
#include "io/result/movement_words.hpp"
#include "io/result/parameters.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/repair_text.hpp"

namespace condyle::io {
namespace {

using io::Json;

/// The frame's axes by their anatomical names.
std::array<std::pair<const char*, Vec3>, 3> axes_of(const Pose& X_WF) {
  const auto& m = X_WF.linear();
  return {{{"anterior", m.col(0)}, {"superior", m.col(1)}, {"right", m.col(2)}}};
}

std::string text_of(const char* role, const Body& body, const std::vector<BodyMeshReport>& meshes,
                    const BoundingBox& bounds) {
  std::string text;
  for (const BodyMeshReport& mesh : meshes)
    text += fmt::format("  {:<8} {}{}: {}, {} vertices, {} triangles\n", text.empty() ? role : "", body.name,
                        mesh.part.empty() ? "" : ", " + mesh.part, mesh.mesh.string(), mesh.vertices,
                        mesh.triangles);
  const auto& [low, high] = bounds;
  const auto span = [](double from, double to) {
    return core::rounded(from, 3) + " .. " + core::rounded(to, 3);
  };
  return text + fmt::format("           x {}, y {}, z {} mm\n", span(low.x(), high.x()),
                            span(low.y(), high.y()), span(low.z(), high.z()));
}

void add_mesh(Json& json, const BodyMeshReport& report) {
  Json repairs = Json::array();
  for (const RepairDone& done : report.repairs)
    repairs.push_back({{"repair", name_of(done.repair)}, {"count", done.count}});
  json["mesh"] = report.mesh.string();
  json["vertices"] = report.vertices;
  json["triangles"] = report.triangles;
  json["welded_vertices"] = report.welded_vertices;
  json["split_polygons"] = report.split_polygons;
  json["guessed_polygons"] = report.guessed_polygons;
  json["repairs"] = std::move(repairs);
}

Json json_of(const Body& body, const std::vector<BodyMeshReport>& meshes, const BoundingBox& bounds) {
  Json json{{"name", body.name}};
  if (body.parts.empty()) {
    add_mesh(json, meshes.front());
  } else {
    for (const BodyMeshReport& mesh : meshes) {
      Json part{{"name", mesh.part}};
      add_mesh(part, mesh);
      json["meshes"].push_back(std::move(part));
    }
  }
  json["bounds_mm"] = {{"low", io::numbers(bounds.low)}, {"high", io::numbers(bounds.high)}};
  return json;
}

Json json_of(const SphericalPatch& head) {
  return {{"shape", "sphere"},
          {"radius_mm", head.fit.sphere.radius},
          {"rms_residual_mm", head.fit.rms_residual},
          {"largest_residual_mm", head.fit.largest_residual},
          {"coverage", head.coverage},
          {"centre_bound_mm", io::nullable(head.centre_bound_mm)},
          {"vertex_count", head.fit.vertices.size()},
          {"vertices", head.fit.vertices}};
}

Json json_of(const CylinderFit& fit, Angle axis_rotation) {
  return {{"shape", "cylinder"},
          {"radius_mm", fit.cylinder.radius},
          {"direction", io::numbers(fit.cylinder.direction)},
          {"rms_residual_mm", fit.rms_residual},
          {"largest_residual_mm", fit.largest_residual},
          {"coverage", fit.coverage},
          {"direction_bound_deg", fit.direction_bound ? Json(fit.direction_bound->degrees()) : Json()},
          {"axis_bound_mm", io::nullable(fit.axis_bound_mm)},
          {"axis_rotation_deg", axis_rotation.degrees()},
          {"vertex_count", fit.vertices.size()},
          {"vertices", fit.vertices}};
}

/// "Z", "+X" or "-X": a coordinate axis as people write it. Z has the same sense on both sides and is signed where that
/// is negative only.
std::string letter_of(const Vec3& axis) {
  int largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  const char letter = "XYZ"[largest];
  if (axis[largest] < 0) return {'-', letter};
  return letter == 'Z' ? std::string("Z") : std::string{'+', letter};
}

/// ", knee": nothing for a hinge of no joint.
std::string words_of_anatomy(const Joint& joint) {
  return joint.names_its_joint() ? fmt::format(", {}", name_of(joint.anatomy)) : std::string();
}

/// As it was given, or as landmarks or anatomy give it.
PoseDegrees reference_pose_of(const JointReport& report) {
  const ZeroFrom from = report.placement.zero_from;
  if (from != ZeroFrom::landmarks && from != ZeroFrom::anatomy) return report.file.reference_pose;
  const auto& [angles, translation] = report.placement.reference_pose;
  return {angles.flexion.degrees(), angles.adduction.degrees(), angles.internal_rotation.degrees(),
          translation};
}

}  // namespace

std::string to_text(const LoadedJoint& loaded) {
  const auto& [joint, report] = loaded;
  const JointPlacement& placement = report.placement;
  std::string out = fmt::format("{}: {} joint{}, {} side{}\n", joint.name, name_of(joint.kind),
                                words_of_anatomy(joint), name_of(joint.side), whose_text(joint));
  out += io::parameters_text(joint);
  out += fmt::format("  {:<8} {} mm in the frame of the meshes\n", "centre",
                     shown(placement.X_WF.translation()));
  for (const auto& [name, axis] : axes_of(placement.X_WF))
    out += fmt::format("  {:<8} {}\n", name, shown(axis));
  out += fmt::format("  {:<8} ", "angles");
  for (const JointAngle angle : all_joint_angles) {
    if (angle != JointAngle::flexion && joint.kind == JointKind::hinge) break;
    out += fmt::format("{}{} about {}", angle == JointAngle::flexion ? "" : ", then ",
                       io::spaced(name_of(angle, joint.anatomy)),
                       letter_of(axis_of(angle, joint.coordinates(), {})));
  }
  if (joint.kind == JointKind::free)
    out += joint.translation_frame == TranslationFrame::fixed
               ? "; translation along X, Y and Z of the fixed body"
               : "; translation along the joint's axes";
  out += fmt::format("\n  reference pose {}\n", to_text(reference_pose_of(report), joint.anatomy));
  out += text_of("fixed", joint.fixed, report.fixed, placement.fixed.bounds) +
         text_of("mobile", joint.mobile, report.mobile, placement.mobile.bounds);
  for (const std::string& note : report.processing) out += fmt::format("  {:<8} {}\n", "prepared", note);
  return out;
}

std::string frame_json(const LoadedJoint& loaded, std::span<const JointNote> notes, const Provenance* from) {
  const auto& [joint, report] = loaded;
  const JointPlacement& placement = report.placement;
  Json out{{"file", report.file.path.string()},
           {"name", joint.name},
           {"kind", name_of(joint.kind)},
           {"anatomy", io::anatomy_json(joint)},
           {"side", name_of(joint.side)},
           {"units_of_meshes", name_of(report.file.joint.units)},
           {"centre_mm", io::numbers(placement.X_WF.translation())}};
  for (const auto& [name, axis] : axes_of(placement.X_WF)) out["axes"][name] = io::numbers(axis);
  out["reference_pose_deg"] = io::pose_json(reference_pose_of(report), joint.anatomy);
  if (joint.kind == JointKind::free) {
    out["reference_translation_mm"] = io::numbers(placement.reference_pose.translation_mm);
    out["translation_frame"] = name_of(joint.translation_frame);
  }
  out["fit"] = placement.sphere     ? json_of(*placement.sphere)
               : placement.cylinder ? json_of(*placement.cylinder, placement.axis_rotation)
                                    : Json();
  out["fixed"] = json_of(joint.fixed, report.fixed, placement.fixed.bounds);
  out["mobile"] = json_of(joint.mobile, report.mobile, placement.mobile.bounds);
  out["processing"] = report.processing;
  out["notes"] = io::notes_json(notes);
  out["provenance"] = io::provenance_json(from);
  return io::document(out);
}

}  // namespace condyle::io
