#pragma once

#include <string>
#include <string_view>

#include "answer/records/limit_record.hpp"
#include "condyle/answer/depth.hpp"

namespace condyle {

struct NoteRecord {
  std::string_view code;
  std::string text;
};
struct TouchDepthRecord {
  std::string_view body;
  double depth_mm, error_mm;
  Vec3 place_mm, exit_mm, normal;
  Index triangle, other_triangle;
};
struct FreeTranslationRecord {
  Vec3 along;
  double distance_mm, error_bound_mm;
};

/// Two meshes in one pose. Points and directions are in the frame of the fixed one.
struct TouchRecord {
  bool in_contact;
  std::size_t intersecting_pairs;
  std::optional<std::string_view> inside = {};
  std::optional<double> nearest_distance_mm = {};
  std::optional<Vec3> nearest_fixed_mm = {}, nearest_mobile_mm = {};
  std::optional<TouchDepthRecord> deepest = {};
  std::optional<double> depth_bound_mm = {}, ray_depth_mm = {};
  std::optional<double> volume_mm3 = {}, volume_error_mm3 = {};
  std::optional<double> fixed_area_mm2 = {}, mobile_area_mm2 = {};
  std::optional<Vec3> centroid_mm = {};
  std::optional<double> fixed_covered_again_mm3 = {}, mobile_covered_again_mm3 = {};
  std::vector<FreeTranslationRecord> free = {};
  std::vector<NoteRecord> notes = {};
};
TouchRecord touch_record(const TouchAnswer& answer);

struct TurnEndRecord {
  double turned_deg;
  motion::LimitReason reason;
  double error_bound_deg;
  std::optional<Vec3> contact_point_mm;
  std::optional<FeaturesRecord> features;
};
struct TurnIntervalRecord {
  double low_deg, high_deg, low_error_bound_deg, high_error_bound_deg;
};
struct TurnRecord {
  Vec3 axis, centre_mm;
  bool free_at_start;
  TurnEndRecord negative, positive;
  std::vector<TurnIntervalRecord> free = {};
  std::vector<NoteRecord> notes = {};
};
TurnRecord turn_record(const TurnAnswer& answer);

struct SlideEndRecord {
  std::optional<double> moved_mm;
  double error_bound_mm;
  std::optional<Vec3> contact_point_mm;
  std::optional<FeaturesRecord> features;
};
struct SlideIntervalRecord {
  std::optional<double> low_mm, high_mm;
  double low_error_bound_mm, high_error_bound_mm;
};
struct SlideRecord {
  Vec3 along;
  bool free_at_start;
  SlideEndRecord negative, positive;
  std::vector<SlideIntervalRecord> free = {};
  std::vector<NoteRecord> notes = {};
};
SlideRecord slide_record(const SlideAnswer& answer);

template <>
inline constexpr auto table<NoteRecord> = record("Note", "What an answer about two meshes must be read with.",
                                                 CONDYLE_KEYS(NoteRecord, code, text));
template <>
inline constexpr auto table<TouchDepthRecord> = record(
    "TouchDepth", "The place of either surface that is deepest in the other body.",
    field("body", &TouchDepthRecord::body, "whose surface it is on: `\"fixed\"` or `\"mobile\"`"),
    field("depth_mm", &TouchDepthRecord::depth_mm,
          "its distance from the other body's surface, along that surface's normal where a face is nearest"),
    field("error_mm", &TouchDepthRecord::error_mm, "no place of either surface is deeper by more"),
    field("place_mm", &TouchDepthRecord::place_mm, "the place"),
    field("exit_mm", &TouchDepthRecord::exit_mm, "the nearest point of the other surface"),
    field("normal", &TouchDepthRecord::normal, "of length 1 from the place to the exit"),
    field("triangle", &TouchDepthRecord::triangle, "of that body that has the place, counted from 0"),
    field("other_triangle", &TouchDepthRecord::other_triangle, "of the other body that has the exit"));
template <>
inline constexpr auto table<FreeTranslationRecord> =
    record("FreeTranslation", "How far the mobile body moves along a direction until it is free.",
           field("along", &FreeTranslationRecord::along, "the direction, of length 1"),
           field("distance_mm", &FreeTranslationRecord::distance_mm,
                 "just beyond it is free; 0 if it is free as it is"),
           field("error_bound_mm", &FreeTranslationRecord::error_bound_mm,
                 "so far before it is in contact for certain"));
template <>
inline constexpr auto table<TouchRecord> = record(
    "TouchRecord", "Two meshes in one pose; points and directions are in the frame of the fixed one.",
    field("in_contact", &TouchRecord::in_contact, "the surfaces meet, or one body is inside the other"),
    field("intersecting_pairs", &TouchRecord::intersecting_pairs,
          "pairs of triangles that meet; touching counts"),
    field("inside", &TouchRecord::inside,
          "the body that is wholly inside the other, without their surfaces meeting: `\"fixed\"`, "
          "`\"mobile\"` or null"),
    field("nearest_distance_mm", &TouchRecord::nearest_distance_mm,
          "between the surfaces; null where they meet, and a distance too if one body is inside the other"),
    field("nearest_fixed_mm", &TouchRecord::nearest_fixed_mm, "where, on the fixed body"),
    field("nearest_mobile_mm", &TouchRecord::nearest_mobile_mm, "and on the mobile body"),
    field("deepest", &TouchRecord::deepest,
          "the deepest place, below; null without contact, if no point of a surface is inside the other body "
          "(they touch, or coincide), and if no body has an inside"),
    field(
        "depth_bound_mm", &TouchRecord::depth_bound_mm,
        "no place of either surface is deeper than this; null without contact, and if no body has an inside"),
    field("ray_depth_mm", &TouchRecord::ray_depth_mm,
          "along rays from `--centre`, as `condyle depth --method radial` has it: of the deepest vertex "
          "whose ray "
          "is a depth; null without a centre or contact, and if a body has no inside"),
    field("volume_mm3", &TouchRecord::volume_mm3,
          "of the space inside both; null without contact, without `--measures`, and if a body has no inside "
          "or is inside out there, as one that crosses itself may be"),
    field("volume_error_mm3", &TouchRecord::volume_error_mm3, "it is off by no more"),
    field("fixed_area_mm2", &TouchRecord::fixed_area_mm2,
          "of the fixed body's surface inside the mobile body"),
    field("mobile_area_mm2", &TouchRecord::mobile_area_mm2,
          "of the mobile body's surface inside the fixed body"),
    field("centroid_mm", &TouchRecord::centroid_mm, "of both areas"),
    field("fixed_covered_again_mm3", &TouchRecord::fixed_covered_again_mm3,
          "how much of that volume is counted again because the fixed body covers it more than once: it "
          "crosses itself or has triangles twice"),
    field("mobile_covered_again_mm3", &TouchRecord::mobile_covered_again_mm3,
          "likewise because of the mobile body"),
    field("free", &TouchRecord::free,
          "for each direction of `--along` how far the mobile body moves until it is free, below"),
    field("notes", &TouchRecord::notes, "`code` and `text` of what the answer must be read with"));
template <>
inline constexpr auto table<TurnEndRecord> = record(
    "TurnEnd", "First contact of a turn in one sense.",
    field("turned_deg", &TurnEndRecord::turned_deg, "from the start, at least 0; 360 if nothing meets"),
    field("reason", &TurnEndRecord::reason, "`\"contact\"`, `\"contact_at_start\"` or `\"end_of_range\"`"),
    field("error_bound_deg", &TurnEndRecord::error_bound_deg,
          "contact is not before it, and past it by no more"),
    field("contact_point_mm", &TurnEndRecord::contact_point_mm,
          "where; null without contact, and if one body is inside the other"),
    field("features", &TurnEndRecord::features, "which features meet, `fixed` and `mobile`"));
template <>
inline constexpr auto table<TurnIntervalRecord> =
    record("TurnInterval", "Angles between which nothing meets.",
           CONDYLE_KEYS(TurnIntervalRecord, low_deg, high_deg, low_error_bound_deg, high_error_bound_deg));
template <>
inline constexpr auto table<TurnRecord> = record(
    "TurnRecord", "A whole turn of the mobile mesh about an axis; points are in the frame of the fixed one.",
    field("axis", &TurnRecord::axis, "its direction as it was given"),
    field("centre_mm", &TurnRecord::centre_mm, "a point on it"),
    field("free_at_start", &TurnRecord::free_at_start, "whether the bodies are apart where they are given"),
    field("negative", &TurnRecord::negative, "first contact against the right hand about the axis"),
    field("positive", &TurnRecord::positive, "and with it"),
    field("free", &TurnRecord::free,
          "all free intervals, ascending: `low_deg` and `high_deg` from the start, with their error bounds: "
          "free between, and contact "
          "outside by no more. One that holds the start goes from below 0 to above, others lie between 0 and "
          "360"),
    field("notes", &TurnRecord::notes, "`code` and `text` of what the answer must be read with"));
template <>
inline constexpr auto table<SlideEndRecord> =
    record("SlideEnd", "First contact of a slide in one sense.",
           field("moved_mm", &SlideEndRecord::moved_mm, "along the direction, signed; null if nothing meets"),
           field("error_bound_mm", &SlideEndRecord::error_bound_mm,
                 "contact is not before it, and past it by no more"),
           field("contact_point_mm", &SlideEndRecord::contact_point_mm, "where"),
           field("features", &SlideEndRecord::features, "which faces meet, `fixed` and `mobile`"));
template <>
inline constexpr auto table<SlideIntervalRecord> =
    record("SlideInterval", "Positions between which nothing meets.",
           CONDYLE_KEYS(SlideIntervalRecord, low_mm, high_mm, low_error_bound_mm, high_error_bound_mm));
template <>
inline constexpr auto table<SlideRecord> = record(
    "SlideRecord", "A slide of the mobile mesh along a direction; points are in the frame of the fixed one.",
    field("along", &SlideRecord::along, "the direction, of length 1"),
    field("free_at_start", &SlideRecord::free_at_start, "whether the bodies are apart where they are given"),
    field("negative", &SlideRecord::negative,
          "first contact against the direction; 0 in contact at the start"),
    field("positive", &SlideRecord::positive, "and along it"),
    field("free", &SlideRecord::free,
          "all free intervals, ascending: `low_mm` and `high_mm` from the start, null for the ends of the "
          "line, with their error bounds"),
    field("notes", &SlideRecord::notes, "`code` and `text` of what the answer must be read with"));

}  // namespace condyle
