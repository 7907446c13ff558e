#include "io/result/frame_result.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "condyle/io/pose_text.hpp"
#include "core/rounded.hpp"
#include "core/trigonometry.hpp"
#include "io/file/shown_point.hpp"
#include "io/result/json.hpp"
#include "io/result/movement_words.hpp"
#include "io/result/parameters.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/repair_text.hpp"

namespace condyle::io {
namespace {

using io::Json;

constexpr const char* said_of_skin =
    "    markers on skin slide over bone: what moves with the joint is in no residual and no bound\n";

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

/// How far the mobile body's point lies from the fixed one's where the bones are given.
double apart_as_given_mm(const LoadedJoint& loaded, const kinematics::FunctionalCentre& found) {
  const auto& [angles, translation] = loaded.report.placement.reference_pose;
  Pose X_FM = pose_at(loaded.joint.coordinates(), angles);
  X_FM.translation() = translation;
  return (X_FM * found.in_mobile - found.in_fixed).norm();
}

/// Of an axis of the fixed body: its turn from the joint's first axis, and how far the joint's centre lies from it.
std::pair<Angle, double> from_joint_axis(const LoadedJoint& loaded, const kinematics::AxisInBody& axis) {
  const Vec3 first = axis_of(JointAngle::flexion, loaded.joint.coordinates(), {});
  return {Angle::radians(
              core::arctangent(first.cross(axis.direction).norm(), std::abs(first.dot(axis.direction)))),
          axis.point.cross(axis.direction).norm()};
}

std::string text_of(const LoadedJoint& loaded, const FunctionalFrame& by_motion) {
  const Pose& X_WF = loaded.report.placement.X_WF;
  const auto head = [&](const auto& found) {
    return fmt::format(
        "  by motion, {} poses of {}, which turn by {:.1f} deg about one axis and {:.1f} off it:\n",
        found.poses, by_motion.path.filename().string(), found.turning.about_axis.degrees(),
        found.turning.off_axis.degrees());
  };
  const auto prepared = [&] {
    std::string lines;
    for (const std::string& note : by_motion.processing) lines += fmt::format("    prepared {}\n", note);
    return lines;
  };
  if (const auto* centre = std::get_if<kinematics::FunctionalCentre>(&by_motion.found)) {
    const Vec3 in_meshes = X_WF * centre->in_fixed;
    const double per_mm = 1 / mm_per(loaded.report.file.joint.units);
    return head(*centre) +
           fmt::format(
               "    centre {} mm in the frame of the meshes, {:.2f} mm from the one above; 95 % within "
               "{:.2f} mm\n    residual {:.2f} mm; the bones as given have it {:.2f} mm apart\n    for the "
               "joint file: frame.centre = [{:.6g}, {:.6g}, {:.6g}], uncertainty.centre = {:.3g} by noise "
               "alone\n",
               shown(in_meshes), centre->in_fixed.norm(), centre->centre_bound_mm, centre->residual_mm,
               apart_as_given_mm(loaded, *centre), per_mm * in_meshes.x(), per_mm * in_meshes.y(),
               per_mm * in_meshes.z(), per_mm * centre->sd_mm) +
           said_of_skin + prepared();
  }
  const auto& axis = std::get<kinematics::FunctionalAxis>(by_motion.found);
  const auto [turn, beside_mm] = from_joint_axis(loaded, axis.in_fixed);
  return head(axis) +
         fmt::format(
             "    axis through {} mm along {} in the frame of the meshes\n    {:.1f} deg from the joint's "
             "first "
             "axis, {:.2f} mm from its centre; 95 % within {:.1f} deg and {:.2f} mm; residual {:.2f} mm\n",
             shown(X_WF * axis.in_fixed.point), shown(X_WF.linear() * axis.in_fixed.direction),
             turn.degrees(), beside_mm, axis.direction_bound.degrees(), axis.axis_bound_mm,
             axis.residual_mm) +
         said_of_skin + prepared();
}

Json json_of(const LoadedJoint& loaded, const FunctionalFrame& by_motion) {
  const Pose& X_WF = loaded.report.placement.X_WF;
  Json json{{"file", by_motion.path.string()}};
  const auto add = [&](const auto& found) {
    json["poses"] = found.poses;
    json["turning_deg"] = {{"about_axis", found.turning.about_axis.degrees()},
                           {"off_axis", found.turning.off_axis.degrees()}};
    json["residual_mm"] = found.residual_mm;
  };
  if (const auto* centre = std::get_if<kinematics::FunctionalCentre>(&by_motion.found)) {
    add(*centre);
    json["centre_mm"] = io::numbers(X_WF * centre->in_fixed);
    json["from_joint_centre_mm"] = centre->in_fixed.norm();
    json["centre_bound_mm"] = centre->centre_bound_mm;
    json["sd_mm"] = centre->sd_mm;
    json["apart_as_given_mm"] = apart_as_given_mm(loaded, *centre);
  } else {
    const auto& axis = std::get<kinematics::FunctionalAxis>(by_motion.found);
    const auto [turn, beside_mm] = from_joint_axis(loaded, axis.in_fixed);
    add(axis);
    json["point_mm"] = io::numbers(X_WF * axis.in_fixed.point);
    json["direction"] = io::numbers(Vec3(X_WF.linear() * axis.in_fixed.direction));
    json["from_joint_axis_deg"] = turn.degrees();
    json["from_joint_centre_mm"] = beside_mm;
    json["direction_bound_deg"] = axis.direction_bound.degrees();
    json["axis_bound_mm"] = axis.axis_bound_mm;
  }
  json["processing"] = by_motion.processing;
  return json;
}

}  // namespace

std::string to_text(const LoadedJoint& loaded, const FunctionalFrame* by_motion) {
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
  return by_motion ? out + text_of(loaded, *by_motion) : out;
}

std::string frame_json(const LoadedJoint& loaded, std::span<const JointNote> notes, const Provenance* from,
                       const FunctionalFrame* by_motion) {
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
  if (by_motion) out["by_motion"] = json_of(loaded, *by_motion);
  out["fixed"] = json_of(joint.fixed, report.fixed, placement.fixed.bounds);
  out["mobile"] = json_of(joint.mobile, report.mobile, placement.mobile.bounds);
  out["processing"] = report.processing;
  out["notes"] = io::notes_json(notes);
  out["provenance"] = io::provenance_json(from);
  return io::document(out);
}

}  // namespace condyle::io
