#include "io/result/depth_parts.hpp"
#include "core/rounded.hpp"

#include <fmt/format.h>

#include "io/file/csv_fields.hpp"
#include "io/file/format_version.hpp"
#include "io/result/movement_words.hpp"
#include "io/result/parameters.hpp"
#include "io/result/pose_state.hpp"

namespace condyle::io {
namespace {

Json matrix_json(const Pose& X) {
  Json rows = Json::array();
  for (int i = 0; i < 4; ++i)
    rows.push_back({X(i, 0) + 0.0, X(i, 1) + 0.0, X(i, 2) + 0.0, X(i, 3) + 0.0});  // no -0
  return rows;
}

}  // namespace

Json depth_header(const DepthQuestion& question, const DepthAnswer& answer, const char* method) {
  const auto& [joint, pose, X_FM, notes, provenance] = question;
  Json json{{"condyle", format_version},
            {"joint", joint.name},
            {"fixed", joint.fixed.name},
            {"mobile", joint.mobile.name},
            {"anatomy", anatomy_json(joint)},
            {"side", joint.side == Side::right ? "right" : "left"},
            {"method", method},
            {"pose_deg", pose_json(pose, joint.anatomy)},
            {"X_FM", matrix_json(X_FM)},
            {"caveats", answer.caveats},
            {"notes", notes_json(notes)}};
  if (joint.kind == JointKind::free) {
    json["translation_mm"] = numbers(pose.translation_mm);
    json["translation_frame"] = name_of(joint.translation_frame);
  }
  add_standing(json, answer.standing, joint.anatomy);
  json["deepest_place"] = nullptr;
  if (const auto& deepest = answer.deepest_place)
    json["deepest_place"] = {{"body", deepest->of == BodyRole::fixed ? "fixed" : "mobile"},
                             {"depth_mm", deepest->depth_mm},
                             {"error_mm", deepest->error_mm},
                             {"place_mm", numbers(question.frame().fixed_point(deepest->place))},
                             {"exit_mm", numbers(question.frame().fixed_point(deepest->exit))}};
  return json;
}

std::string depth_headline(const DepthQuestion& question, const DepthAnswer& answer, std::size_t pairs) {
  const auto& [joint, pose, X_FM, notes, provenance] = question;
  std::string text = fmt::format("{}: {} in {}", joint.name, joint.mobile.name, joint.fixed.name);
  for (const JointAngle angle : all_joint_angles)
    text += fmt::format(", {} {}", spaced(name_of(angle, joint.anatomy)), pose[angle]);
  text += " deg";
  if (joint.kind == JointKind::free)
    text += fmt::format(", x {}, y {}, z {} mm", pose.translation_mm.x(), pose.translation_mm.y(),
                        pose.translation_mm.z());
  text += whose_text(joint) + "\n" + parameters_text(joint);
  for (const std::string& caveat : answer.caveats) text += fmt::format("  {}\n", caveat);
  text += fmt::format("  {}; {} intersecting triangle pairs\n",
                      answer.standing       ? state_text(*answer.standing, joint.anatomy)
                      : answer.in_contact() ? "in contact"
                                            : "free",
                      pairs);
  if (answer.standing)
    if (const std::string left = to_limit_text(*answer.standing, joint.anatomy); !left.empty())
      text += "  " + left + "\n";
  if (const auto& deepest = answer.deepest_place)
    text += fmt::format("  depth: {:.3f} mm to the nearest surface, {} at {}\n", deepest->depth_mm,
                        (deepest->of == BodyRole::fixed ? joint.fixed : joint.mobile).name,
                        place_text(question.frame().fixed_point(deepest->place)).substr(3));
  return text;
}

std::string inside_line(const Body& body, std::size_t inside, std::size_t on_surface) {
  std::string line =
      fmt::format("  {}: {} of {} vertices inside", body.name, inside, body.mesh.vertices().size());
  if (on_surface > 0) line += fmt::format(", {} exactly on the surface", on_surface);
  return line + "\n";
}

std::string place_text(const Vec3& p) {
  return "at " + core::rounded(p, 2) + " mm";
}

std::string measures_text(const DepthQuestion& question, const contact::ContactMeasures& measures) {
  std::string areas;
  const auto add_area = [&](const Body& body, const std::optional<contact::ContactPatch>& patch) {
    if (!patch || !patch->mean_depth_mm) return;
    areas += fmt::format("{} {:.1f} mm2 of {} (mean depth {:.3f} mm)", areas.empty() ? "" : ",",
                         patch->area_mm2, body.name, *patch->mean_depth_mm);
  };
  add_area(question.joint.mobile, measures.mobile);
  add_area(question.joint.fixed, measures.fixed);
  std::string text;
  if (measures.centroid)
    text += fmt::format("  contact area:{}, centred {}\n", areas,
                        place_text(question.frame().fixed_point(*measures.centroid)));
  if (measures.centroid && measures.volume_mm3)
    text += fmt::format("  penetration volume: {} mm3, to within {}\n",
                        core::rounded(*measures.volume_mm3, 4), core::at_most(measures.volume_error_mm3, 1));
  const auto add_again = [&](const Body& body, double covered_again_mm3) {
    if (covered_again_mm3 > 0)
      text += fmt::format("    of it {:.4g} mm3 are counted again: {} covers them more than once\n",
                          covered_again_mm3, body.name);
  };
  add_again(question.joint.mobile, measures.mobile_covered_again_mm3);
  add_again(question.joint.fixed, measures.fixed_covered_again_mm3);
  return text + nearest_text(measures);
}

std::string nearest_text(const contact::ContactMeasures& measures) {
  return fmt::format("  nearest distance of the surfaces: {:.3f} mm\n", measures.nearest.distance_mm);
}

void add_measures(Json& json, const DepthQuestion& question, const contact::ContactMeasures& measures) {
  const AnswerFrame frame = question.frame();
  const auto point = [&](const std::optional<Vec3>& p) {
    return p ? numbers(frame.fixed_point(*p)) : Json(nullptr);
  };
  const auto patch_json = [&](const std::optional<contact::ContactPatch>& patch) -> Json {
    if (!patch) return nullptr;
    return {{"area_mm2", patch->area_mm2},
            {"mean_depth_mm", nullable(patch->mean_depth_mm)},
            {"centroid_mm", point(patch->centroid)}};
  };
  json["contact"] = {
      {"mobile", patch_json(measures.mobile)},
      {"fixed", patch_json(measures.fixed)},
      {"centroid_mm", point(measures.centroid)},
      {"volume_mm3", nullable(measures.volume_mm3)},
      {"volume_error_mm3", measures.volume_mm3 ? Json(measures.volume_error_mm3) : Json(nullptr)},
      {"mobile_covered_again_mm3", measures.mobile_covered_again_mm3},
      {"fixed_covered_again_mm3", measures.fixed_covered_again_mm3}};
  add_nearest(json, question, measures);
}

void add_nearest(Json& json, const DepthQuestion& question, const contact::ContactMeasures& measures) {
  const AnswerFrame frame = question.frame();
  json["nearest_distance_mm"] = measures.nearest.distance_mm;
  json["nearest_points_mm"] = {{"mobile", numbers(frame.fixed_point(measures.nearest.on_mobile))},
                               {"fixed", numbers(frame.fixed_point(measures.nearest.on_fixed))}};
}

MeshArray nearest_array(const std::vector<double>& distances) {
  return {"nearest_distance_mm", distances};
}

std::string open_line(const Body& body) {
  return fmt::format("  {}: no answer, the other mesh is open and has no inside\n", body.name);
}

void add_part(Json& json, const char* key, const Body& body, Index vertex) {
  if (const BodyPart* part = part_of_vertex(body, vertex))
    json[key] = {{"name", part->name}, {"vertex", vertex - part->first_vertex}};
}

std::string vertex_text(const Body& body, Index vertex) {
  const BodyPart* part = part_of_vertex(body, vertex);
  return fmt::format("vertex {} of {}{}", vertex, body.name,
                     part ? fmt::format(" ({} of {})", vertex - part->first_vertex, part->name) : "");
}

DepthArrays arrays_of(const Body& body, std::vector<MeshArray> points,
                      const std::vector<contact::TrianglePair>& pairs, Index contact::TrianglePair::*triangle,
                      std::vector<MeshArray> triangles) {
  std::vector<std::uint8_t> in_contact(body.mesh.triangles().size());
  for (const contact::TrianglePair& pair : pairs) in_contact[pair.*triangle] = 1;
  if (!body.parts.empty()) {
    std::vector<std::int32_t> part;
    for (std::size_t i = 0; i < body.parts.size(); ++i)
      part.insert(part.end(), body.parts[i].vertices, static_cast<std::int32_t>(i));
    points.push_back({"part", std::move(part)});
  }
  triangles.push_back({"in_contact", std::move(in_contact)});
  return {std::move(points), std::move(triangles)};
}

std::string pairs_csv(const Joint& joint, const std::vector<contact::TrianglePair>& pairs) {
  const bool parts = !joint.fixed.parts.empty() || !joint.mobile.parts.empty();
  std::string text =
      fmt::format("fixed_triangle,mobile_triangle{}\n", parts ? ",fixed_part,mobile_part" : "");
  const auto name_of_part = [](const Body& body, Index triangle) {
    const BodyPart* part = part_of_triangle(body, triangle);
    return part ? csv_field(part->name) : std::string();
  };
  for (const auto& [fixed, mobile] : pairs) {
    text += fmt::format("{},{}", fixed, mobile);
    if (parts)
      text += fmt::format(",{},{}", name_of_part(joint.fixed, fixed), name_of_part(joint.mobile, mobile));
    text += "\n";
  }
  return text;
}

std::optional<JointAngle> angle_of(contact::DepthKind kind) noexcept {
  switch (kind) {
    case contact::DepthKind::flexion:
      return JointAngle::flexion;
    case contact::DepthKind::adduction:
      return JointAngle::adduction;
    case contact::DepthKind::internal_rotation:
      return JointAngle::internal_rotation;
    case contact::DepthKind::none:
    case contact::DepthKind::radial:
    case contact::DepthKind::nearest:
      break;
  }
  return std::nullopt;
}

DepthResult depth_result(const DepthQuestion& question, const DepthAnswer& answer) {
  if (const auto* rays = std::get_if<RayDepths>(&answer.depths))
    return io::ray_result(question, answer, *rays);
  if (const auto* arcs = std::get_if<ArcDepths>(&answer.depths))
    return io::arc_result(question, answer, *arcs);
  return io::normal_result(question, answer, std::get<contact::NormalContact>(answer.depths));
}

}  // namespace condyle::io
