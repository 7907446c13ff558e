#pragma once

#include <string>
#include <string_view>

#include "answer/records/record.hpp"
#include "condyle/answer/measures.hpp"

namespace condyle {

struct NormalRangeRecord {
  double low, high;
  std::string_view people;
  std::optional<int> count;
  std::string_view meaning, source;
};
struct MeasureRecord {
  std::string_view key;
  measure::MeasuredPart part;
  std::string_view unit;
  std::optional<double> value;
  std::optional<std::string> why_none, note;
  std::string_view definition;
  std::vector<std::string_view> measured_by;
  std::string_view source;
  std::optional<std::string> frame;
  std::optional<NormalRangeRecord> normal, patients;
  std::optional<measure::MeasureBand> band;
};

/// The shape of a hip. Points are in the joint frame, whatever the frame of the answer.
struct ShapeRecord {
  std::string pelvis_frame;
  double pelvic_tilt_deg;
  std::vector<std::string> left_out = {};
  std::vector<MeasureRecord> measures = {};
  std::vector<measure::NeckHour> around_neck = {};
  std::vector<measure::RimHour> rim = {};
};

ShapeRecord shape_record(const MeasureAnswer& answer);

/// The member, if the rim has a point there.
template <auto member>
std::optional<double> if_there(const measure::RimHour& rim) {
  return rim.point ? std::optional(rim.*member) : std::nullopt;
}

template <>
inline constexpr auto table<NormalRangeRecord> =
    record("NormalRange", "Between these values lie the measures of other people.",
           CONDYLE_KEYS(NormalRangeRecord, low, high),
           field("people", &NormalRangeRecord::people, "whose measures they are"),
           field("count", &NormalRangeRecord::count, "of these; null if the source does not say"),
           field("meaning", &NormalRangeRecord::meaning, "which measures lie between"),
           field("source", &NormalRangeRecord::source, "where they are from"));
template <>
inline constexpr auto table<measure::MeasureBand> =
    record("MeasureBand", "A measure over varied joints.",
           field("p5", &measure::MeasureBand::p5, "5 % of them are below; null if none shows the measure"),
           CONDYLE_KEYS(measure::MeasureBand, median, p95),
           field("samples_without_value", &measure::MeasureBand::samples_without_value,
                 "joints that do not show it"));
template <>
inline constexpr auto table<MeasureRecord> = record(
    "MeasureRecord", "One measure of a hip.", field("key", &MeasureRecord::key, "its name"),
    field("part", &MeasureRecord::part, "`\"femur\"`, `\"acetabulum\"` or `\"both\"`"),
    field("unit", &MeasureRecord::unit, "`\"mm\"`, `\"deg\"`, `\"h\"` or `\"1\"`"),
    field("value", &MeasureRecord::value, "null if it cannot be computed"),
    field("why_none", &MeasureRecord::why_none, "the reason then, else null"),
    field("note", &MeasureRecord::note, "its caveat, usually null"),
    field("definition", &MeasureRecord::definition, "in a line"),
    field("measured_by", &MeasureRecord::measured_by,
          "the planes, axes and points that it is measured by: names in `geometry`, or of a list here"),
    field("source", &MeasureRecord::source, "where the definition is from"),
    field("frame", &MeasureRecord::frame, "the pelvis frame of an angle that turns with it, else null"),
    field("normal", &MeasureRecord::normal,
          "a range of people with usual hips: `low`, `high`, `people`, `count`, `meaning` and `source`; null "
          "if none is known"),
    field("patients", &MeasureRecord::patients, "likewise of patients, which is not called normal"),
    field("band", &MeasureRecord::band,
          "`p5`, `median`, `p95` over the varied joints, and `samples_without_value`; null without "
          "`--band`"));
template <>
inline constexpr auto table<measure::NeckHour> =
    record("NeckHour", "What is measured in one direction around the neck, 12 superior and 3 anterior.",
           CONDYLE_KEYS(measure::NeckHour, hour, alpha_deg, alpha_at_1mm_deg, is_doubtful),
           field("alpha_point_mm", &measure::NeckHour::alpha_point),
           field("offset_mm", &measure::NeckHour::offset_mm),
           field("offset_point_mm", &measure::NeckHour::offset_point));
template <>
inline constexpr auto table<measure::RimHour> =
    record("RimHour", "The rim in one direction around the socket, 12 superior and 3 anterior.",
           field("hour", &measure::RimHour::hour), field("point_mm", &measure::RimHour::point),
           field("cover_deg", if_there<&measure::RimHour::cover_deg>),
           field("centre_edge_deg", if_there<&measure::RimHour::centre_edge_deg>),
           field("is_in_plane", &measure::RimHour::is_in_plane));
template <>
inline constexpr auto table<ShapeRecord> = record(
    "ShapeRecord", "The shape of a hip, in the words of measures.json.",
    field("pelvis_frame", &ShapeRecord::pelvis_frame,
          "the frame of acetabular angles, with the tilt that was given"),
    field("pelvic_tilt_deg", &ShapeRecord::pelvic_tilt_deg, "that tilt"),
    field("left_out", &ShapeRecord::left_out,
          "sentences on pieces of a mesh near the head that are not measured, such as the wall of its marrow "
          "or another bone"),
    field("measures", &ShapeRecord::measures, "list of measures in the order of the text, below"),
    field("around_neck", &ShapeRecord::around_neck,
          "list of `hour`, `alpha_deg`, `alpha_at_1mm_deg`, `is_doubtful`, `alpha_point_mm`, `offset_mm`, "
          "`offset_point_mm`; points in the mobile body's frame"),
    field("rim", &ShapeRecord::rim,
          "list of `hour`, `point_mm` in the fixed body's frame, `cover_deg`, `centre_edge_deg`, "
          "`is_in_plane`"));

}  // namespace condyle
