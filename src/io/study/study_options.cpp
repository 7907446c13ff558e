#include "io/study/study_options.hpp"

#include "io/joint/grid_text.hpp"
#include "io/result/contact_terms.hpp"
#include "io/result/json.hpp"

namespace condyle::io {
namespace {

void add_forces(Json& json, const std::optional<Vec3>& force_n, const std::vector<Vec3>& free_directions) {
  json["force_anterior_superior_lateral_n"] = force_n ? numbers(*force_n) : Json(nullptr);
  json["free_directions_anterior_superior_lateral"] = Json::array();
  for (const Vec3& direction : free_directions)
    json["free_directions_anterior_superior_lateral"].push_back(numbers(direction));
}

void add_contact(Json& json, const ContactChanges& given) {
  json["casting"] = given.casting ? Json(name_of(*given.casting)) : Json(nullptr);
  json["rule"] = given.rule ? Json(name_of(*given.rule)) : Json(nullptr);
  json["reach_mm"] = nullable(given.reach_mm);
  json["law"] = given.law ? Json(name_of(*given.law)) : Json(nullptr);
  json["youngs_modulus_mpa"] = given.youngs_modulus_mpa;
  json["poisson_ratio"] = given.poisson_ratio;
  json["thickness_mm"] = given.thickness_mm;
}

Json load_json(const StudyLoad& load, Anatomy joint) {
  Json json;
  json["pose"] = pose_json(load.at, joint);
  add_forces(json, load.force_n, load.free_directions);
  add_contact(json, load.contact);
  return json;
}

Json follow_load_json(const StudyFollowLoad& load) {
  Json json;
  add_forces(json, load.force_n, load.free_directions);
  add_contact(json, load.contact);
  return json;
}

Json resection_json(const StudyResection& resection) {
  const plan::ResectionOptions& cut = resection.cut;
  Json json;
  for (const auto& [motion, reach, is_gain] : resection.targets)
    json[is_gain ? "gain_deg" : "reach_deg"][motion] = plan::asked_degrees(reach);
  json["fixed_share"] = cut.fixed_share;
  json["margin_mm"] = cut.margin_mm;
  json["burr_mm"] = nullable(cut.burr_mm);
  json["deepest_mm"] = nullable(cut.mobile.deepest_mm);
  json["within_mm"] = nullable(cut.mobile.within_mm);
  json["edge_mm"] = cut.edge_mm;
  return json;
}

}  // namespace

std::string options_json(const StudyOptions& options) {
  Json json;
  json["anatomy"] = name_of(options.anatomy);
  json["motions"] = options.motions.empty() ? Json("all") : Json(options.motions);
  json["bearing"] = options.bearing.rule == motion::BearingRule::count ? Json("count") : Json("leave_out");
  json["bearing_margin_mm"] = nullable(options.bearing.margin_mm);
  json["accept_reference_contact"] = options.reference_contact == motion::ReferenceContact::accept;
  json["exclude_reference_contacts"] = options.leave_out_reference_contacts
                                           ? Json(options.leave_out_reference_contacts->rings)
                                           : Json(nullptr);
  if (const auto& map = options.map)
    json["map"] = {to_text(map->column, options.anatomy), to_text(map->row, options.anatomy),
                   name_of(map->vary, options.anatomy)};
  if (const auto& bands = options.bands)
    json["bands"] = {{"samples", bands->samples},
                     {"seed", nullable(bands->seed)},
                     {"sigma_centre_mm", nullable(bands->centre_mm)},
                     {"sigma_axes_deg", nullable(bands->axes_deg)},
                     {"sigma_surface_mm", nullable(bands->surface_mm)}};
  if (options.depth_at) json["depth_at"] = pose_json(*options.depth_at, options.anatomy);
  if (options.measures) json["measures"] = true;
  if (options.resection) json["resection"] = resection_json(*options.resection);
  if (options.load) json["load"] = load_json(*options.load, options.anatomy);
  if (options.follow_load) json["follow_load"] = follow_load_json(*options.follow_load);
  return json.dump();
}

}  // namespace condyle::io
