#include <algorithm>
#include <cmath>

#include "condyle/io/caveats.hpp"
#include "condyle/io/map_result.hpp"
#include "condyle/io/normal_range.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/rom_result.hpp"
#include "io/file/format_version.hpp"
#include "io/joint/given_degrees.hpp"
#include "io/result/clock_hour.hpp"
#include "io/result/json.hpp"
#include "io/result/map_summary.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/rom_parts.hpp"

namespace condyle {
namespace {

using io::Json;

Json angles_json(const JointAngles& angles, Anatomy joint) {
  Json json;
  for (const JointAngle angle : all_joint_angles)
    json[name_of(angle, joint)] = angle_of(angles, angle).degrees();
  return json;
}

Json start_json(const JointAngles& angles, Anatomy joint) {
  Json json;
  for (const JointAngle angle : all_joint_angles)
    json[name_of(angle, joint)] = io::given_degrees(angle_of(angles, angle));
  return json;
}

Json held_json(const Motion& motion, Anatomy joint) {
  Json json;
  for (const JointAngle angle : all_joint_angles)
    if (angle != motion.vary) json[name_of(angle, joint)] = io::given_degrees(angle_of(motion.start, angle));
  return json;
}

/// A feature of a body, and of which part where it has several.
Json json_of(const Feature& feature, const Body& body) {
  Json json{{"kind", io::name_of(feature.kind)}};
  if (feature.kind == FeatureKind::edge)
    json["vertices"] = {feature.id, feature.other_end};
  else
    json["id"] = feature.id;
  if (const BodyPart* part = io::part_of(body, feature)) json["part"] = part->name;
  return json;
}

Json nullable(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}
Json nullable_degrees(const std::optional<Angle>& angle) {
  return angle ? Json(angle->degrees()) : Json(nullptr);
}

Json json_of(const BodyZone& zone, const std::optional<Vec3>& centroid) {
  const auto deepest = [](const std::vector<double>& depths) -> Json {
    double most = 0;
    for (const double depth : depths)
      if (std::isfinite(depth)) most = std::max(most, depth);
    return depths.empty() ? Json(nullptr) : Json(most);
  };
  return {{"triangles", zone.triangles.size()},
          {"area_mm2", zone.area_mm2},
          {"centroid_mm", centroid ? io::numbers(*centroid) : Json(nullptr)},
          {"max_radial_depth_mm", deepest(zone.radial_depth_mm)},
          {"max_tangential_depth_deg", deepest(zone.tangential_depth_deg)},
          {"max_tangential_depth_mm", deepest(zone.tangential_depth_mm)}};
}

Json json_of(const std::optional<ImpingementZone>& zone, const AnswerFrame& frame) {
  if (!zone) return nullptr;
  const auto &of_fixed = zone->fixed.centroid_mm, &of_mobile = zone->mobile.centroid_mm;
  Json fixed = json_of(zone->fixed, of_fixed ? std::optional(frame.fixed_point(*of_fixed)) : std::nullopt);
  Json mobile =
      json_of(zone->mobile, of_mobile ? std::optional(frame.mobile_point(*of_mobile)) : std::nullopt);
  fixed["clock_hour"] = nullable(zone->zone_hour);
  mobile["neck_angle_deg"] = nullable_degrees(zone->zone_neck_angle);
  return {{"past_deg", zone->past.degrees()},
          {"contact_neck_angle_deg", nullable_degrees(zone->contact_neck_angle)},
          {"fixed", std::move(fixed)},
          {"mobile", std::move(mobile)}};
}

Json json_of(const DepthLimit& depth) {
  Json json{{"at_start_mm", depth.start_depth_mm},
            {"at_limit_mm", depth.at_limit.depth_mm},
            {"ray_to_normal_deg", depth.at_limit.ray_to_normal.degrees()},
            {"grows", depth.depth_grows}};
  return json;
}

Json json_of(const LimitBand& band) {
  return {{"p5_deg", band.p5.degrees()},
          {"median_deg", band.median.degrees()},
          {"p95_deg", band.p95.degrees()},
          {"width_from",
           {{"centre_deg", band.width_from.centre.degrees()},
            {"axes_deg", band.width_from.axes.degrees()},
            {"surface_deg", band.width_from.surface.degrees()}}},
          {"share_without_contact", band.share_without_contact},
          {"share_in_contact_at_start", band.share_in_contact_at_start}};
}

/// Of the i-th motion.
Json motion_json(const RomResult& result, std::size_t i) {
  const MotionLimit& limit = result.limits[i];
  const auto& contact = limit.end.contact;
  const auto& bearing = limit.end.bearing_contact;
  const auto normal = io::normal_range(result, limit);
  const AnswerFrame frame = frame_of(result);
  const Anatomy joint = result.joint.anatomy;
  Json json{
      {"name", limit.motion.name},
      {"limit_deg", limit.end.turned.degrees()},
      {"reason", name_of(limit.end.reason)},
      {"contact_kind", io::ends_in_contact(limit) ? Json(name_of(limit.end.kind())) : Json(nullptr)},
      {"bearing_contact_deg", bearing ? Json(bearing->turned.degrees()) : Json(nullptr)},
      {"bearing_contact_point_mm", bearing && bearing->contact
                                       ? io::numbers(frame.fixed_point(bearing->contact->fixed_point))
                                       : Json(nullptr)},
      {"centre_distance_mm", limit.head ? nullable(limit.head->centre_distance_mm) : Json(nullptr)},
      {"joint_space_mm", limit.head ? nullable(limit.head->joint_space_mm) : Json(nullptr)},
      {"contact_point_mm", contact ? io::numbers(frame.fixed_point(contact->fixed_point)) : Json(nullptr)},
      {"contact_point_mobile_mm",
       contact ? io::numbers(frame.mobile_point(contact->mobile_point)) : Json(nullptr)},
      {"clock_hour", nullable(io::clock_hour(result, limit))},
      {"features", contact ? Json{{"fixed", json_of(contact->fixed_feature, result.joint.fixed)},
                                  {"mobile", json_of(contact->mobile_feature, result.joint.mobile)}}
                           : Json(nullptr)},
      {"error_bound_deg", limit.end.error_bound.degrees()},
      {"vary", name_of(limit.motion.vary, joint)},
      {"sense", limit.motion.sense == RotationSense::positive ? "positive" : "negative"},
      {"range_deg", io::given_degrees(limit.motion.range)},
      {"start_deg", start_json(limit.motion.start, joint)},
      {"held_deg", held_json(limit.motion, joint)},
      {"definition", io::is_as_defined_here(limit.motion) ? Json("as defined here; no angles are agreed on")
                                                          : Json(nullptr)},
      {"normal_range_deg", normal ? Json(io::given_degrees(*normal)) : Json(nullptr)},
      {"at_limit_deg", angles_json(limit.angles_at_limit(), joint)},
      {"caveats", io::caveats_json(motion_caveats(result.joint, limit.motion))},
      {"guarantee", result.depths.empty() ? guarantee_text(limit) : guarantee_text(result.depths[i])}};
  if (!result.depths.empty()) json["depth"] = json_of(result.depths[i]);
  if (!result.zones.empty()) json["zone"] = json_of(result.zones[i], frame_of(result));
  json["band"] = result.bands.empty() ? Json(nullptr) : json_of(result.bands[i]);
  return json;
}

Json json_of(const BandOptions& options) {
  return {{"samples", options.samples},
          {"seed", options.seed},
          {"sigma",
           {{"centre_mm", options.sigma.centre_mm},
            {"axes_deg", options.sigma.axes.degrees()},
            {"surface_mm", options.sigma.surface_mm}}}};
}

Json json_of(const ReasonCounts& counts) {
  Json json;
  for (const LimitReason reason :
       {LimitReason::contact, LimitReason::end_of_range, LimitReason::contact_at_start})
    json[name_of(reason)] = counts[reason];
  return json;
}

Json json_of(const GridAxis& axis, Anatomy joint) {
  return {{"angle", name_of(axis.angle, joint)},
          {"opposite", movement_name(axis.angle, RotationSense::negative, joint)},
          {"first_deg", axis.first_deg},
          {"last_deg", axis.last_deg},
          {"step_deg", axis.step_deg},
          {"count", axis.count()}};
}

Json json_of(const MapIntervals& all) {
  const auto names = [](const std::vector<LimitReason>& reasons) {
    Json list = Json::array();
    for (const LimitReason reason : reasons) list.push_back(name_of(reason));
    return list;
  };
  return {{"offset", all.offset},
          {"low_deg", all.low_deg},
          {"high_deg", all.high_deg},
          {"low_reason", names(all.low_reason)},
          {"high_reason", names(all.high_reason)}};
}

Json json_of(const MotionMap& map) {
  const MapSummary summary = summarise(map);
  return {{"vary", name_of(map.grid.vary, map.anatomy)},
          {"vary_opposite", movement_name(map.grid.vary, RotationSense::negative, map.anatomy)},
          {"start_deg", map.grid.start.degrees()},
          {"range_deg", {map.grid.range.negative.degrees(), map.grid.range.positive.degrees()}},
          {"columns", json_of(map.grid.column, map.anatomy)},
          {"rows", json_of(map.grid.row, map.anatomy)},
          {"points", map.points.size()},
          {"negative_ends", json_of(summary.negative_ends)},
          {"positive_ends", json_of(summary.positive_ends)},
          {"free_elsewhere", summary.free_elsewhere},
          {"with_islands", summary.with_islands},
          {"intervals", json_of(all_intervals(map))},
          {"free_volume_deg3", summary.volume.plain_deg3},
          {map.anatomy == Anatomy::shoulder ? "free_volume_sine_weighted_deg3"
                                            : "free_volume_cosine_weighted_deg3",
           summary.volume.weighted_deg3},
          {"row_free_area_deg2", summary.volume.row_area_deg2}};
}

Json sphere_json(const Vec3& centre, double radius) {
  return {{"centre_mm", io::numbers(centre)}, {"radius_mm", radius}};
}

Json bearing_json(const RomResult& result) {
  Json json{{"rule", result.bearing_rule == BearingRule::count ? "count" : "leave_out"}};
  const auto& surface = result.bearing.surface;
  if (!surface) {
    json["why_none"] = result.bearing.why_none;
    return json;
  }
  const AnswerFrame frame = frame_of(result);
  json["head"] = sphere_json(frame.mobile_point(surface->head.centre), surface->head.radius);
  json["head_coverage"] = surface->head_coverage;
  json["socket"] = surface->socket
                       ? sphere_json(frame.fixed_point(surface->socket->centre), surface->socket->radius)
                       : Json(nullptr);
  json["parts"] = surface->parts;
  json["margin_mm"] = surface->margin_mm;
  json["rim_gap_mm"] = nullable(surface->rim_gap_mm);
  json["triangles"] = surface->count();
  return json;
}

}  // namespace

std::string rom_json(const RomResult& result) {
  Json json{{"condyle", io::format_version},
            {"joint", result.joint.name},
            {"fixed", result.joint.fixed.name},
            {"mobile", result.joint.mobile.name},
            {"anatomy", io::anatomy_json(result.joint)},
            {"side", name_of(result.joint.side)},
            {"bearing", bearing_json(result)},
            {"clock_plane", !result.joint.is_hip()                  ? Json(nullptr)
                            : result.clock_plane == ClockPlane::rim ? Json("rim")
                                                                    : Json("sagittal")},
            {"normal_range_source", result.joint.is_hip() ? Json(normal_hip_range_source) : Json(nullptr)},
            {"held_translation_mm",
             result.held_translation_mm ? io::numbers(*result.held_translation_mm) : Json(nullptr)},
            {"terms", result.terms},
            {"notes", io::notes_json(result.notes, result.contact_notes, result.range_notes)},
            {"band", result.bands.empty() ? Json(nullptr) : json_of(result.band_options)}};
  json["motions"] = Json::array();
  for (std::size_t i = 0; i < result.limits.size(); ++i) json["motions"].push_back(motion_json(result, i));
  if (result.map) json["map"] = json_of(*result.map);
  json["scope"] = scope_text(result.joint);
  json["provenance"] = io::provenance_json(result.provenance);
  return io::document(json);
}

}  // namespace condyle
