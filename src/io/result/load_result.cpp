#include "io/result/load_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/rounded.hpp"
#include "io/file/format_version.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/joint/depth_surfaces.hpp"
#include "io/result/contact_terms.hpp"
#include "io/result/depth_parts.hpp"
#include "io/result/json.hpp"
#include "io/result/parameters.hpp"
#include "io/result/pose_state.hpp"
#include "io/result/pressure_map.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/scope_text.hpp"

namespace condyle::io {
namespace {

using io::Json;

bool is_of_load(std::string_view name) {
  static constexpr std::string_view names[] = {"fixed.vtp", "mobile.vtp", "load.json"};
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

Json wrench_json(const contact::Wrench& wrench) {
  return {{"force_n", io::numbers(wrench.force_n)}, {"moment_nmm", io::numbers(wrench.moment_nmm)}};
}

/// The force on the casting body, and the moment on the body that the joint file names for it.
Json totals_json(const ContactEntry& contact, contact::ContactTotals totals) {
  if (contact.moment_on == MomentOn::target) totals.moment_nmm = -totals.moment_nmm;
  return io::totals_json(totals, true);
}

Json surface_json(const ContactEntry& contact, const Body& body,
                  const std::optional<contact::SurfaceContact>& surface) {
  if (!surface) return nullptr;
  Json json = totals_json(contact, surface->totals);
  const contact::FaceContact* deepest = io::deepest_of(*surface);
  json["deepest_triangle"] = deepest ? Json(deepest->face) : Json(nullptr);
  if (deepest) io::add_triangle_part(json, "deepest_part", body, deepest->face);
  json["met_from_front"] = surface->met_from_front;
  json["rim_faces"] = surface->rim_faces;
  json["oblique_area_mm2"] = surface->oblique_area_mm2;
  json["peak_is_oblique"] = surface->peak_is_oblique;
  json["max_strain"] = surface->max_strain;
  return json;
}

/// Sums over the faces of a region.
contact::ContactTotals region_totals(const ContactEntry& contact, const RegionEntry& region, const Body& body,
                                     const contact::SurfaceContact& surface) {
  return contact::totals_of(contact::faces_within(surface.faces, body.mesh, region.half_spaces), body.mesh,
                            contact.rays.rule);
}

/// Loads of each region of a casting surface; an empty list if the joint file has none.
Json regions_json(const ContactEntry& contact, const Body& body,
                  const std::optional<contact::SurfaceContact>& surface) {
  if (!surface) return nullptr;
  Json regions = Json::array();
  for (const RegionEntry& region : contact.regions) {
    Json json = totals_json(contact, region_totals(contact, region, body, *surface));
    json["name"] = region.name;
    regions.push_back(std::move(json));
  }
  return regions;
}

std::string surface_text(const ContactEntry& contact, const Body& body,
                         const std::optional<contact::SurfaceContact>& surface) {
  if (!surface) return "";
  const contact::ContactTotals& totals = surface->totals;
  const std::string oblique = io::oblique_text(*surface, contact.rays.rule);
  if (totals.triangles == 0) return fmt::format("  {}: no contact\n", body.name) + oblique;
  const Index deepest = io::deepest_of(*surface)->face;
  std::string text =
      fmt::format("  {}: {:.2f} mm2 in contact, depth {:.3f} mm in the mean, {:.3f} at most, triangle {}{}\n",
                  body.name, totals.area_mm2, totals.mean_depth_mm, totals.max_depth_mm, deepest,
                  io::triangle_part_text(body, deepest));
  text += fmt::format("    pressure {:.3f} MPa in the mean, {:.3f} at most, centre {} mm of its own frame\n",
                      totals.mean_pressure_mpa, totals.max_pressure_mpa,
                      core::rounded(*totals.centre_of_pressure, 2));
  for (const RegionEntry& region : contact.regions) {
    const contact::ContactTotals of = region_totals(contact, region, body, *surface);
    text += of.triangles == 0
                ? fmt::format("    {}: no contact\n", region.name)
                : fmt::format("    {}: {:.2f} mm2, pressure {:.3f} MPa at most, force {} N, {:.2f} in all\n",
                              region.name, of.area_mm2, of.max_pressure_mpa, core::rounded(of.force_n, 2),
                              of.force_n.norm());
  }
  if (surface->met_from_front > 0)
    text += fmt::format("    {} rays met the open surface from its front: overlap there may be none\n",
                        surface->met_from_front);
  return text + oblique;
}

/// The question that depths along arcs at the answered pose belong to.
DepthQuestion depth_question(const LoadQuestion& question, const LoadAnswer& answer, const Joint& surfaces) {
  return {.joint = surfaces,
          .pose = question.pose,
          .X_FM = answer.X_FM,
          .notes = {},
          .provenance = question.provenance};
}

}  // namespace

std::string load_text(const LoadQuestion& question, const LoadAnswer& answer) {
  const Joint& joint = question.joint;
  std::string text = fmt::format("{}: {} in {}, {}{}\n", joint.name, joint.mobile.name, joint.fixed.name,
                                 to_text(question.pose, joint.anatomy), whose_text(joint));
  text += io::parameters_text(joint);
  text += io::contact_caveats_text(question.contact, question.surfaces, true);
  for (const std::string& caveat : answer.caveats) text += fmt::format("  {}\n", caveat);
  if (answer.standing) text += fmt::format("  {}\n", state_text(*answer.standing, joint.anatomy));
  if (answer.balanced) {
    const Vec3 moved = answer.X_FM.translation() - question.X_FM.translation();
    if (answer.balanced->outcome == contact::BalanceOutcome::balanced)
      text += fmt::format("  balanced after {} steps, {} mm from the pose given\n", answer.balanced->steps,
                          core::rounded(moved, 2));
    else
      text += fmt::format("  {}\n", contact::reason_of(*answer.balanced));
  }
  text += surface_text(question.contact, question.surfaces.fixed, answer.contact.fixed) +
          surface_text(question.contact, question.surfaces.mobile, answer.contact.mobile);
  const contact::Wrench& load = answer.contact.on_mobile;
  text +=
      fmt::format("  on {}: force {} N, {:.2f} in all; moment {} N mm about its origin\n", joint.mobile.name,
                  core::rounded(load.force_n, 2), load.force_n.norm(), core::rounded(load.moment_nmm, 2));
  for (const LigamentAlong& ligament : answer.ligaments)
    if (const auto& at = ligament.frames.front(); at && at->tension_n > 0)
      text +=
          fmt::format("  ligament {}: {:.2f} N, strain {:.4f}\n", ligament.name, at->tension_n, at->strain);
  if (answer.refined_force_n) text += io::refined_force_text(load.force_n, *answer.refined_force_n);
  if (answer.cut_off_by_reach > 0)
    text += fmt::format("  the reach of {} mm cuts off {} rays that would be in contact\n",
                        question.contact.rays.reach_mm, answer.cut_off_by_reach);
  if (answer.arcs) {
    const Joint surfaces = joint_of_surfaces(question.contact, joint);
    text += deepest_arcs_text(depth_question(question, answer, surfaces), *answer.arcs);
    if (!answer.arcs->contact.mobile_in_fixed) text += open_line(surfaces.mobile);
    if (!answer.arcs->contact.fixed_in_mobile) text += open_line(surfaces.fixed);
  }
  return text;
}

std::string load_json(const LoadQuestion& question, const LoadAnswer& answer) {
  const Joint& joint = question.joint;
  Json json{{"condyle", io::format_version},
            {"joint", joint.name},
            {"fixed", question.surfaces.fixed.name},
            {"mobile", question.surfaces.mobile.name},
            {"anatomy", io::anatomy_json(joint)},
            {"side", name_of(joint.side)},
            {"pose_deg", io::pose_json(question.pose, joint.anatomy)},
            {"contact", io::contact_caveats(question.contact, true)}};
  if (joint.kind == JointKind::free) {
    json["translation_mm"] = io::numbers(question.pose.translation_mm);
    json["translation_frame"] = name_of(joint.translation_frame);
  }
  for (const LigamentAlong& ligament : answer.ligaments)
    if (const auto& at = ligament.frames.front())
      json["ligaments"].push_back({{"name", ligament.name},
                                   {"length_mm", at->length_mm},
                                   {"strain", at->strain},
                                   {"tension_n", at->tension_n}});
  Json rows = Json::array();
  for (int r = 0; r < 4; ++r)
    rows.push_back({answer.X_FM.matrix()(r, 0), answer.X_FM.matrix()(r, 1), answer.X_FM.matrix()(r, 2),
                    answer.X_FM.matrix()(r, 3)});
  json["X_FM"] = std::move(rows);
  if (answer.balanced) {
    json["balance"] = {{"outcome", name_of(answer.balanced->outcome)},
                       {"reason", contact::reason_of(*answer.balanced)},
                       {"steps", answer.balanced->steps},
                       {"load", wrench_json(question.load->on_mobile)},
                       {"load_frame", question.load->frame == BodyRole::fixed ? "fixed" : "mobile"},
                       {"moved_mm", io::numbers(answer.X_FM.translation() - question.X_FM.translation())},
                       {"residual", wrench_json(answer.balanced->residual)}};
  }
  json["fixed_surface"] = surface_json(question.contact, question.surfaces.fixed, answer.contact.fixed);
  json["mobile_surface"] = surface_json(question.contact, question.surfaces.mobile, answer.contact.mobile);
  if (!question.contact.regions.empty()) {
    json["fixed_regions"] = regions_json(question.contact, question.surfaces.fixed, answer.contact.fixed);
    json["mobile_regions"] = regions_json(question.contact, question.surfaces.mobile, answer.contact.mobile);
  }
  add_standing(json, answer.standing, joint.anatomy);
  if (answer.arcs) {
    const Joint surfaces = joint_of_surfaces(question.contact, joint);
    add_arcs(json["arcs"], depth_question(question, answer, surfaces), *answer.arcs);
  }
  json["on_mobile"] = wrench_json(answer.contact.on_mobile);
  json["refined_force_n"] = answer.refined_force_n ? io::numbers(*answer.refined_force_n) : Json(nullptr);
  json["energy_nmm"] = answer.contact.energy_nmm;
  json["cut_off_by_reach"] = answer.cut_off_by_reach;
  json["caveats"] = answer.caveats;
  json["notes"] = io::notes_json(question.notes, answer.notes);
  json["scope"] = scope_text(question.contact, question.surfaces);
  json["provenance"] = io::provenance_json(question.provenance);
  return io::document(std::move(json));
}

void check_load_folder(const std::filesystem::path& folder, const Provenance* from) {
  OutputFolder{folder, is_of_load, io::files_read(from)};
}

std::vector<std::filesystem::path> write_load(const std::filesystem::path& folder,
                                              const LoadQuestion& question, const LoadAnswer& answer,
                                              VtpEncoding encoding) {
  OutputFolder out(folder, is_of_load, io::files_read(question.provenance), "load.json");
  const AnswerFrame frame = question.provenance ? question.provenance->frame : AnswerFrame{};
  const VtpOptions options{encoding, io::provenance_fields(question.provenance)};
  const auto write = [&](const char* name, const Body& body, const TriMesh& in_F,
                         const std::optional<contact::SurfaceContact>& surface) {
    const std::vector<MeshArray> arrays =
        surface ? io::pressure_map(*surface, body, true) : io::part_map(body);
    write_vtp(out.file(name), frame.fixed_mesh(in_F), {}, arrays, options);
  };
  const auto& [fixed, mobile] = question.surfaces;
  write("fixed.vtp", fixed, fixed.mesh, answer.contact.fixed);
  write("mobile.vtp", mobile, posed(answer.X_FM, mobile.mesh), answer.contact.mobile);
  io::write_whole_file(out.file("load.json"), load_json(question, answer));
  return out.commit();
}

}  // namespace condyle::io
