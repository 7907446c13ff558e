#include "answer/records/limit_record.hpp"

#include <algorithm>
#include <cmath>

#include "answer/limit_facts.hpp"
#include "core/formatted.hpp"

namespace condyle {
namespace {

std::optional<double> degrees_of(const std::optional<Angle>& angle) {
  return angle ? std::optional(angle->degrees()) : std::nullopt;
}

std::optional<std::string> part_name(const Body& body, const motion::Feature& feature) {
  const BodyPart* part = part_of(body, feature);
  return part ? std::optional(part->name) : std::nullopt;
}

template <class Value, class Read>
OfAngles<Value> of_angles(const Read& read) {
  OfAngles<Value> values;
  for (const JointAngle angle : all_joint_angles) values[static_cast<std::size_t>(angle)] = read(angle);
  return values;
}

/// The greatest of the finite depths; empty if the other body is open.
std::optional<double> deepest(const std::vector<double>& depths) {
  if (depths.empty()) return std::nullopt;
  double most = 0;
  for (const double depth : depths)
    if (std::isfinite(depth)) most = std::max(most, depth);
  return most;
}

template <class Point>
ZoneOfBodyRecord<Point> zone_of_body(const motion::BodyZone& zone) {
  return {.triangles = zone.triangles.size(),
          .area_mm2 = zone.area_mm2,
          .centroid_mm = zone.centroid_mm ? std::optional(Point{*zone.centroid_mm}) : std::nullopt,
          .max_radial_depth_mm = deepest(zone.radial_depth_mm),
          .max_tangential_depth_deg = deepest(zone.tangential_depth_deg),
          .max_tangential_depth_mm = deepest(zone.tangential_depth_mm)};
}

ZoneRecord zone_record(const motion::ImpingementZone& zone) {
  return {.past_deg = zone.past.degrees(),
          .contact_neck_angle_deg = degrees_of(zone.contact_neck_angle),
          .fixed = {zone_of_body<PointF>(zone.fixed), zone.zone_hour},
          .mobile = {zone_of_body<PointM>(zone.mobile), degrees_of(zone.zone_neck_angle)}};
}

BandRecord band_record(const motion::LimitBand& band, const motion::Motion& motion, const Joint& joint) {
  const auto& [centre, axes, surface, parameters] = band.width_from;
  return {
      .p5_deg = degrees_turned(band.p5, motion),
      .median_deg = degrees_turned(band.median, motion),
      .p95_deg = degrees_turned(band.p95, motion),
      .text = quoted_band(band, motion),
      .width_from = {centre.degrees(), axes.degrees(), surface.degrees(),
                     has_uncertain_parameters(joint) ? std::optional(parameters.degrees()) : std::nullopt},
      .share_without_contact = band.share_without_contact,
      .share_in_contact_at_start = band.share_in_contact_at_start};
}

}  // namespace

std::string text_of(const FeatureRecord& feature) {
  const std::string_view kind = name_of(feature.kind);
  return feature.vertices ? core::formatted("edge %u-%u", (*feature.vertices)[0], (*feature.vertices)[1])
                          : core::formatted("%s %u", kind.data(), *feature.id);
}

FeatureRecord feature_record(const motion::Feature& feature, const Body* body) {
  FeatureRecord record{.kind = feature.kind, .id = {}, .vertices = {}, .part = {}};
  if (body) record.part = part_name(*body, feature);
  if (feature.kind == motion::FeatureKind::edge)
    record.vertices = {feature.id, feature.other_end};
  else
    record.id = feature.id;
  return record;
}

FeaturesRecord features_of(const motion::ContactWitness& contact) {
  return {feature_record(contact.fixed_feature), feature_record(contact.mobile_feature)};
}

LimitRecord limit_record(const RangeAnswer& answer, std::size_t i) {
  const Joint& joint = answer.joint;
  const motion::MotionLimit& limit = answer.limits[i];
  const motion::Motion& motion = limit.motion;
  const motion::Limit& end = limit.end;
  const JointAngles start = motion.start, at_limit = limit.angles_at_limit();
  const auto given = [&](JointAngle angle) { return GivenDegrees{angle_of(start, angle)}; };
  LimitRecord record{
      .name = motion.name,
      .limit_deg = degrees_turned(end.turned, motion),
      .reason = end.reason,
      .error_bound_deg = end.error_bound.degrees(),
      .vary = motion.vary,
      .sense = motion.sense,
      .range_deg = {motion.range},
      .start_deg = of_angles<GivenDegrees>(given),
      .held_deg = of_angles<GivenDegrees>([&](JointAngle angle) {
        return angle == motion.vary ? std::nullopt : std::optional(given(angle));
      }),
      .zero_from = joint.zero_from,
      .at_limit_deg =
          of_angles<double>([&](JointAngle angle) { return angle_of(at_limit, angle).degrees(); }),
      .translation_mm = limit.translation_mm,
      .contact_side = motion::contact_side(joint, limit),
      .clock_hour = clock_hour(answer, limit),
      .guarantee = answer.depths.empty() ? guarantee_text(limit) : guarantee_text(answer.depths[i])};
  if (end.ligament) record.ligament = joint.ligaments[*end.ligament].name;
  if (ends_in_contact(limit)) record.contact_kind = end.kind();
  if (const auto& bearing = end.bearing_contact) {
    record.bearing_contact_deg = bearing->turned.degrees();
    if (bearing->contact) record.bearing_contact_point_mm = {bearing->contact->fixed_point};
  }
  if (const auto& soft = end.soft_contact) {
    record.soft_contact_deg = soft->turned.degrees();
    if (const auto& contact = soft->contact) {
      record.soft_contact_point_mm = {contact->fixed_point};
      record.soft_contact_parts = {part_name(joint.fixed, contact->fixed_feature),
                                   part_name(joint.mobile, contact->mobile_feature)};
    }
  }
  if (const auto& head = limit.head) {
    record.centre_distance_mm = head->centre_distance_mm;
    record.joint_space_mm = head->joint_space_mm;
  }
  if (const auto range = normal_range(joint, limit)) record.normal_range_deg = {*range};
  if (const auto bone = bone_reference(joint, limit))
    record.bone_reference = {{bone->healthy},   {bone->cam_without_complaints}, {bone->patients},
                             bone->people_each, is_short(*bone, limit),         bone->source};
  record.living = living_limit(answer, i);
  if (is_as_defined_here(motion)) record.definition = "as defined here; no angles are agreed on";
  if (answer.follows) record.translation_ends = limit.translation_ends;
  if (const auto& contact = end.contact) {
    record.contact_point_mm = {contact->fixed_point};
    record.contact_point_mobile_mm = {contact->mobile_point};
    record.features = {feature_record(contact->fixed_feature, &joint.fixed),
                       feature_record(contact->mobile_feature, &joint.mobile)};
  }
  record.caveats = motion_caveats(joint, motion);
  if (!answer.depths.empty()) record.depth = answer.depths[i];
  if (!answer.closed.empty()) record.closed_form = answer.closed[i];
  if (!answer.zones.empty()) {
    const auto& zone = answer.zones[i];
    record.zone = zone ? std::optional(zone_record(*zone)) : std::nullopt;
  }
  if (!answer.bands.empty()) record.band = band_record(answer.bands[i], motion, joint);
  return record;
}

}  // namespace condyle
