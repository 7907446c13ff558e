#include "answer/records/measure_record.hpp"

#include <algorithm>

namespace condyle {
namespace {

std::optional<std::string> if_said(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

/// "neck, shaft" as a list.
std::vector<std::string_view> names_in(std::string_view names) {
  std::vector<std::string_view> list;
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(", "), names.size());
    list.push_back(names.substr(0, end));
    names.remove_prefix(std::min(end + 2, names.size()));
  }
  return list;
}

/// The range of people with usual hips, or that of patients.
std::optional<NormalRangeRecord> range_of(const std::optional<measure::NormalRange>& range,
                                          bool of_patients) {
  if (!range || range->are_patients != of_patients) return std::nullopt;
  const auto& [low, high, people, count, are_patients, meaning, source] = *range;
  return NormalRangeRecord{low,     high,  people, count > 0 ? std::optional(count) : std::nullopt,
                           meaning, source};
}

}  // namespace

ShapeRecord shape_record(const MeasureAnswer& answer) {
  const measure::HipMeasures& measures = answer.measures;
  const std::string frame = measure::stated_frame(measures);
  ShapeRecord record{.pelvis_frame = frame,
                     .pelvic_tilt_deg = measures.pelvic_tilt.degrees(),
                     .left_out = measures.left_out,
                     .around_neck = measures.femur.around_neck,
                     .rim = measures.acetabulum.rim};
  const auto definitions = measure::measure_definitions();
  for (std::size_t i = 0; i < definitions.size(); ++i) {
    const measure::MeasureDefinition& each = definitions[i];
    const auto& [value, why_none, note] = each.of(measures);
    MeasureRecord of_one{each.key,
                         each.part,
                         each.unit,
                         value,
                         if_said(why_none),
                         if_said(note),
                         each.definition,
                         names_in(each.measured_by),
                         each.source,
                         each.in_pelvis_frame ? std::optional(frame) : std::nullopt,
                         range_of(each.normal, false),
                         range_of(each.normal, true),
                         {}};
    if (!answer.bands.empty()) of_one.band = answer.bands[i];
    record.measures.push_back(std::move(of_one));
  }
  return record;
}

}  // namespace condyle
