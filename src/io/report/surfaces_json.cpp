#include "io/report/surfaces_json.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/joint/given_degrees.hpp"
#include "io/result/contact_terms.hpp"
#include "io/result/json_objects.hpp"

namespace condyle::io {
namespace {

/// The surface of a body that carries load: all of it, or one of its parts, and its layer where it has one.
Json layer_json(const Body& body, const std::string& part, const std::optional<contact::ElasticLayer>& layer,
                const std::string& role, BlockArrays& arrays) {
  BodyPart run{"", 0, body.mesh.vertices().size(), 0, body.mesh.triangles().size()};
  for (const BodyPart& known : body.parts)
    if (known.name == part) run = known;
  Json json{{"first_vertex", run.first_vertex},
            {"vertices", run.vertices},
            {"first_triangle", run.first_triangle},
            {"triangles", run.triangles}};
  if (!layer) return json;
  json["youngs_modulus_mpa"] = layer->youngs_modulus_mpa;
  json["poisson_ratio"] = layer->poisson_ratio;
  const double* const everywhere = std::get_if<double>(&layer->thickness_mm);
  json["thickness_mm"] =
      arrays.add(role + "_thickness", everywhere ? std::vector<double>(run.vertices, *everywhere)
                                                 : std::get<std::vector<double>>(layer->thickness_mm));
  return json;
}

Json lowered_json(const plan::CutBone& cut, const std::string& role, BlockArrays& arrays) {
  std::vector<std::uint32_t> lowered;
  std::vector<double> before, depth_mm;
  for (std::uint32_t v = 0; v < cut.depth_mm.size(); ++v) {
    if (cut.depth_mm[v] == 0) continue;
    lowered.push_back(v);
    depth_mm.push_back(cut.depth_mm[v]);
    const Vec3 p = cut.before.vertices[v];
    before.insert(before.end(), {p.x(), p.y(), p.z()});
  }
  return {{"lowered", arrays.add(role + "_lowered", lowered)},
          {"before", arrays.add(role + "_before", before)},
          {"depth_mm", arrays.add(role + "_depth", depth_mm)}};
}

}  // namespace

Json zones_json(const RomResult& rom, BlockArrays& arrays) {
  Json zones = Json::array();
  for (const std::optional<motion::ImpingementZone>& zone : rom.answer.zones) {
    if (!zone) continue;
    const std::string name = "zone_" + std::to_string(zones.size());
    zones.push_back({{"motion", zone->limit.motion.name},
                     {"past_deg", given_degrees(zone->past)},
                     {"fixed", arrays.add(name + "_fixed", zone->fixed.triangles)},
                     {"mobile", arrays.add(name + "_mobile", zone->mobile.triangles)}});
  }
  return zones;
}

Json layers_json(const ReportedLayers& layers, const Joint& joint, BlockArrays& arrays) {
  const auto& [contact, options] = layers;
  return {{"casting", name_of(options.casting)},
          {"law", name_of(options.law)},
          {"rule", name_of(options.rays.rule)},
          {"reach_mm", options.rays.reach_mm},
          {"fixed", layer_json(joint.fixed, contact.fixed_part, options.fixed, "fixed", arrays)},
          {"mobile", layer_json(joint.mobile, contact.mobile_part, options.mobile, "mobile", arrays)}};
}

Json plan_json(const ResectionResult& plan, BlockArrays& arrays) {
  Json json = resection_object(plan);
  // The page has these of the joint.
  for (const char* key : {"condyle", "joint", "fixed", "mobile", "side", "notes", "scope", "provenance"})
    json.erase(key);
  const plan::Resection& resection = plan.answer.resection;
  json["surfaces"] = {
      {"fixed", resection.fixed ? lowered_json(*resection.fixed, "fixed", arrays) : Json(nullptr)},
      {"mobile", resection.mobile ? lowered_json(*resection.mobile, "mobile", arrays) : Json(nullptr)}};
  return json;
}

}  // namespace condyle::io
