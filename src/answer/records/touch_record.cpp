#include "answer/records/touch_record.hpp"

#include "core/ordered_sums.hpp"

namespace condyle {
namespace {

std::string_view name_of_role(BodyRole role) noexcept {
  return role == BodyRole::fixed ? "fixed" : "mobile";
}

FeatureRecord feature_of(const motion::Feature& feature) {
  FeatureRecord record{.kind = feature.kind, .id = {}, .vertices = {}, .part = {}};
  if (feature.kind == motion::FeatureKind::edge)
    record.vertices = {feature.id, feature.other_end};
  else
    record.id = feature.id;
  return record;
}

std::optional<FeaturesRecord> features_of(const std::optional<motion::ContactWitness>& contact) {
  if (!contact) return std::nullopt;
  return FeaturesRecord{feature_of(contact->fixed_feature), feature_of(contact->mobile_feature)};
}

std::optional<Vec3> point_of(const std::optional<motion::ContactWitness>& contact) {
  return contact ? std::optional(contact->fixed_point) : std::nullopt;
}

std::vector<NoteRecord> notes_in(const std::vector<JointNote>& notes) {
  std::vector<NoteRecord> records;
  for (const JointNote& note : notes) records.push_back({name_of(note.code), note.text});
  return records;
}

TurnEndRecord end_record(const motion::Limit& limit) {
  return {limit.turned.degrees(), limit.reason, limit.error_bound.degrees(), point_of(limit.contact),
          features_of(limit.contact)};
}

SlideEndRecord end_record(const motion::SlideEnd& end) {
  return {end.at_mm, end.error_bound_mm, point_of(end.contact), features_of(end.contact)};
}

}  // namespace

TouchRecord touch_record(const TouchAnswer& answer) {
  TouchRecord record{.in_contact = answer.in_contact, .intersecting_pairs = answer.pairs.size()};
  if (answer.inside) record.inside = name_of_role(*answer.inside);
  if (const auto& nearest = answer.nearest) {
    record.nearest_distance_mm = nearest->distance_mm;
    record.nearest_fixed_mm = nearest->on_fixed, record.nearest_mobile_mm = nearest->on_mobile;
  }
  if (const auto& deepest = answer.deepest)
    record.deepest = {
        name_of_role(deepest->of), deepest->depth_mm, deepest->error_mm, deepest->place, deepest->exit,
        deepest->normal,           deepest->triangle, deepest->other};
  record.depth_bound_mm = answer.depth_bound_mm, record.ray_depth_mm = answer.ray_depth_mm;
  if (const auto& overlap = answer.overlap) {
    record.volume_mm3 = overlap->volume_mm3;
    record.fixed_area_mm2 = overlap->fixed_area_mm2, record.mobile_area_mm2 = overlap->mobile_area_mm2;
    record.centroid_mm = overlap->centroid;
    if (overlap->volume_mm3) {
      record.volume_error_mm3 = overlap->volume_error_mm3;
      record.fixed_covered_again_mm3 = overlap->fixed_covered_again_mm3;
      record.mobile_covered_again_mm3 = overlap->mobile_covered_again_mm3;
    }
  }
  for (const FreeTranslation& each : answer.free)
    record.free.push_back({each.along, each.distance_mm, each.error_bound_mm});
  record.notes = notes_in(answer.notes);
  return record;
}

TurnRecord turn_record(const TurnAnswer& answer) {
  const motion::RotationLimits& from_start = answer.free.from_start;
  TurnRecord record{answer.request.axis, answer.request.centre, from_start.free_at_start(),
                    end_record(from_start.negative), end_record(from_start.positive)};
  for (const motion::FreeInterval& each : answer.free.intervals)
    record.free.push_back({each.low.degrees(), each.high.degrees(), each.at_low.error_bound.degrees(),
                           each.at_high.error_bound.degrees()});
  record.notes = notes_in(answer.notes);
  return record;
}

SlideRecord slide_record(const SlideAnswer& answer) {
  const motion::FreeSlides& free = answer.free;
  SlideRecord record{core::ordered_direction(answer.request.along), free.free_at_start,
                     end_record(free.negative), end_record(free.positive)};
  for (const motion::FreeSlide& each : free.intervals)
    record.free.push_back(
        {each.low.at_mm, each.high.at_mm, each.low.error_bound_mm, each.high.error_bound_mm});
  record.notes = notes_in(answer.notes);
  return record;
}

}  // namespace condyle
