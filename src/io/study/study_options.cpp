#include "io/study/study_options.hpp"

#include "condyle/io/grid_text.hpp"
#include "io/result/json.hpp"

namespace condyle::io {

std::string options_json(const StudyOptions& options) {
  Json json;
  json["anatomy"] = name_of(options.anatomy);
  json["motions"] = options.motions.empty() ? Json("all") : Json(options.motions);
  json["bearing"] = options.bearing.rule == BearingRule::count ? Json("count") : Json("leave_out");
  json["bearing_margin_mm"] = nullable(options.bearing.margin_mm);
  json["accept_reference_contact"] = options.reference_contact == ReferenceContact::accept;
  json["exclude_reference_contacts"] = options.leave_out_reference_contacts
                                           ? Json(options.leave_out_reference_contacts->rings)
                                           : Json(nullptr);
  if (const auto& map = options.map)
    json["map"] = {to_text(map->column, options.anatomy), to_text(map->row, options.anatomy),
                   name_of(map->vary, options.anatomy)};
  if (const auto& bands = options.bands)
    json["bands"] = {{"samples", bands->samples},
                     {"seed", bands->seed},
                     {"sigma_centre_mm", nullable(bands->sigma.centre_mm)},
                     {"sigma_axes_deg", nullable(bands->sigma.axes_deg)},
                     {"sigma_surface_mm", nullable(bands->sigma.surface_mm)}};
  if (options.depth_at) json["depth_at"] = pose_json(*options.depth_at, options.anatomy);
  return json.dump();
}

}  // namespace condyle::io

namespace condyle {

Uncertainty StudyUncertainty::over(const Uncertainty& of_file) const noexcept {
  Uncertainty sigma = of_file;
  if (centre_mm) sigma.centre_mm = *centre_mm;
  if (axes_deg) sigma.axes = Angle::degrees(*axes_deg);
  if (surface_mm) sigma.surface_mm = *surface_mm;
  return sigma;
}

}  // namespace condyle
