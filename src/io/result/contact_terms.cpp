#include "io/result/contact_terms.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace condyle::io {
namespace {

Json layer_json(const std::optional<LayerEntry>& layer) {
  if (!layer) return nullptr;
  Json json{{"youngs_modulus_mpa", layer->youngs_modulus_mpa}, {"poisson_ratio", layer->poisson_ratio}};
  if (layer->thickness_file) {
    json["thickness_file"] = layer->thickness_file->string();
    return json;
  }
  if (layer->behind) json["thickness_to"] = layer->behind->string();
  json[layer->behind ? "thickness_elsewhere_mm" : "thickness_mm"] =
      layer->thickness_mm > 0 ? Json(layer->thickness_mm) : Json(nullptr);
  return json;
}

std::string layer_text(const std::optional<LayerEntry>& layer) {
  if (!layer) return "rigid";
  const std::string elastic =
      fmt::format("E {} MPa, nu {}, ", layer->youngs_modulus_mpa, layer->poisson_ratio);
  if (layer->thickness_file) return elastic + "thickness of each vertex given";
  if (!layer->behind) return elastic + fmt::format("{} mm", layer->thickness_mm);
  return elastic + "thickness measured" +
         (layer->thickness_mm > 0 ? fmt::format(", {} mm where nothing lies behind", layer->thickness_mm)
                                  : "");
}

}  // namespace

std::string_view name_of(contact::Casting casting) noexcept {
  return casting == contact::Casting::fixed    ? "fixed"
         : casting == contact::Casting::mobile ? "mobile"
                                               : "both";
}
std::string_view name_of(contact::FaceRule rule) noexcept {
  return rule == contact::FaceRule::face_centre ? "face_centre" : "cut_faces";
}
std::string_view name_of(contact::PressureLaw law) noexcept {
  return law == contact::PressureLaw::linear ? "linear" : "logarithmic";
}

Json contact_caveats(const ContactEntry& entry, bool with_pressure) {
  Json json{{"casting", name_of(entry.casting)},
            {"rule", name_of(entry.rays.rule)},
            {"reach_mm", entry.rays.reach_mm}};
  if (!with_pressure) return json;
  json["law"] = name_of(entry.law);
  json["fixed_layer"] = layer_json(entry.fixed);
  json["mobile_layer"] = layer_json(entry.mobile);
  json["moment_on"] = entry.moment_on == MomentOn::casting ? "casting" : "target";
  return json;
}

std::string contact_caveats_text(const ContactEntry& entry, const ContactSurfaces& surfaces,
                                 bool with_pressure) {
  const std::string caster = entry.casting == contact::Casting::both    ? "both surfaces"
                             : entry.casting == contact::Casting::fixed ? surfaces.fixed.name
                                                                        : surfaces.mobile.name;
  std::string text = fmt::format(
      "  rays along normals of {}, {}, reach {} mm\n", caster,
      entry.rays.rule == contact::FaceRule::face_centre ? "one per face" : "faces cut where the depth is 0",
      entry.rays.reach_mm);
  if (with_pressure)
    text += fmt::format("  {} law; {}: {}; {}: {}\n", name_of(entry.law), surfaces.fixed.name,
                        layer_text(entry.fixed), surfaces.mobile.name, layer_text(entry.mobile));
  return text;
}

Json totals_json(const contact::ContactTotals& totals, bool with_pressure) {
  const auto point = [](const std::optional<Vec3>& p) { return p ? numbers(*p) : Json(nullptr); };
  Json json{{"triangles", totals.triangles},
            {"area_mm2", totals.area_mm2},
            {"mean_depth_mm", totals.mean_depth_mm},
            {"max_depth_mm", totals.max_depth_mm},
            {"centre_of_depth_mm", point(totals.centre_of_depth)}};
  if (!with_pressure) return json;
  json["mean_pressure_mpa"] = totals.mean_pressure_mpa;
  json["max_pressure_mpa"] = totals.max_pressure_mpa;
  json["centre_of_pressure_mm"] = point(totals.centre_of_pressure);
  json["force_n"] = numbers(totals.force_n);
  json["moment_nmm"] = numbers(totals.moment_nmm);
  return json;
}

std::string oblique_text(const contact::SurfaceContact& surface, contact::FaceRule rule) {
  // Less than this would print as nothing.
  if (surface.oblique_area_mm2 < 0.005) return "";
  const std::string area = fmt::format("    {:.2f} mm2", surface.oblique_area_mm2);
  if (rule == contact::FaceRule::cut_faces)
    return area +
           " more overlap where rays meet the other surface more than 60 degrees off its normal, as along a "
           "rim: "
           "no depth is counted there\n";
  return area +
         " of it where rays meet the other surface more than 60 degrees off its normal, as along a rim: "
         "their "
         "length is no depth" +
         (surface.peak_is_oblique ? ", and the largest values are of such a triangle\n" : "\n");
}

std::string refined_force_text(const Vec3& force_n, const Vec3& refined_n) {
  const double force = force_n.norm(), refined = refined_n.norm();
  if (!(force > 0)) return "";
  return fmt::format(
      "    with 16 rays in each triangle {:.2f} N, {:+.1f} %: what the triangles' size leaves open\n",
      refined, 100 * (refined - force) / force + 0.0);
}

const contact::FaceContact* deepest_of(const contact::SurfaceContact& surface) {
  const auto deepest =
      std::max_element(surface.faces.begin(), surface.faces.end(),
                       [](const auto& a, const auto& b) { return a.max_depth_mm < b.max_depth_mm; });
  return deepest == surface.faces.end() ? nullptr : &*deepest;
}

void add_triangle_part(Json& json, const char* key, const Body& body, Index triangle) {
  if (const BodyPart* part = part_of_triangle(body, triangle))
    json[key] = {{"name", part->name}, {"triangle", triangle - part->first_triangle}};
}

std::string triangle_part_text(const Body& body, Index triangle) {
  const BodyPart* part = part_of_triangle(body, triangle);
  return part ? fmt::format(" ({} of {})", triangle - part->first_triangle, part->name) : "";
}

}  // namespace condyle::io
