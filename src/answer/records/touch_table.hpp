#pragma once

#include <string>
#include <string_view>

#include "answer/records/limit_record.hpp"
#include "condyle/answer/depth.hpp"
#include "core/ordered_sums.hpp"

namespace condyle {

/// The member, if the penetration volume is known.
template <auto member>
std::optional<double> beside_volume(const TouchOverlap& overlap) {
  return overlap.volume_mm3 ? std::optional(overlap.*member) : std::nullopt;
}

template <>
inline constexpr auto table<JointNote> = record(
    "Note", "What an answer about two meshes must be read with.",
    field("code", [](const JointNote& note) { return name_of(note.code); }), field("text", &JointNote::text));
template <>
inline constexpr auto table<TouchDepth> = record(
    "TouchDepth", "The place of either surface that is deepest in the other body.",
    field("body", &TouchDepth::of, "whose surface it is on: `\"fixed\"` or `\"mobile\"`"),
    field("depth_mm", &TouchDepth::depth_mm,
          "its distance from the other body's surface, along that surface's normal where a face is nearest"),
    field("error_mm", &TouchDepth::error_mm, "no place of either surface is deeper by more"),
    field("place_mm", &TouchDepth::place, "the place"),
    field("exit_mm", &TouchDepth::exit, "the nearest point of the other surface"),
    field("normal", &TouchDepth::normal, "of length 1 from the place to the exit"),
    field("triangle", &TouchDepth::triangle, "of that body that has the place, counted from 0"),
    field("other_triangle", &TouchDepth::other, "of the other body that has the exit"));
template <>
inline constexpr auto table<FreeTranslation> = record(
    "FreeTranslation", "How far the mobile body moves along a direction until it is free.",
    field("along", &FreeTranslation::along, "the direction, of length 1"),
    field("distance_mm", &FreeTranslation::distance_mm, "just beyond it is free; 0 if it is free as it is"),
    field("error_bound_mm", &FreeTranslation::error_bound_mm, "so far before it is in contact for certain"));
template <>
inline constexpr auto table<TouchAnswer> = record(
    "TouchRecord", "Two meshes in one pose; points and directions are in the frame of the fixed one.",
    field("in_contact", &TouchAnswer::in_contact, "the surfaces meet, or one body is inside the other"),
    field(
        "intersecting_pairs", [](const TouchAnswer& answer) { return answer.pairs.size(); },
        "pairs of triangles that meet; touching counts"),
    field("inside", &TouchAnswer::inside,
          "the body that is wholly inside the other, without their surfaces meeting: `\"fixed\"`, "
          "`\"mobile\"` or null"),
    field_along(
        "nearest_distance_mm",
        "between the surfaces; null where they meet, and a distance too if one body is inside the other",
        &TouchAnswer::nearest, &contact::NearestPoints::distance_mm),
    field_along("nearest_fixed_mm", "where, on the fixed body", &TouchAnswer::nearest,
                &contact::NearestPoints::on_fixed),
    field_along("nearest_mobile_mm", "and on the mobile body", &TouchAnswer::nearest,
                &contact::NearestPoints::on_mobile),
    field("deepest", &TouchAnswer::deepest,
          "the deepest place, below; null without contact, if no point of a surface is inside the other body "
          "(they touch, or coincide), and if no body has an inside"),
    field(
        "depth_bound_mm", &TouchAnswer::depth_bound_mm,
        "no place of either surface is deeper than this; null without contact, and if no body has an inside"),
    field("ray_depth_mm", &TouchAnswer::ray_depth_mm,
          "along rays from `--centre`, as `condyle depth --method radial` has it: of the deepest vertex "
          "whose ray "
          "is a depth; null without a centre or contact, and if a body has no inside"),
    field_along(
        "volume_mm3",
        "of the space inside both; null without contact, without `--measures`, and if a body has no inside "
        "or is inside out there, as one that crosses itself may be",
        &TouchAnswer::overlap, &TouchOverlap::volume_mm3),
    field_along("volume_error_mm3", "it is off by no more", &TouchAnswer::overlap,
                beside_volume<&TouchOverlap::volume_error_mm3>),
    field_along("fixed_area_mm2", "of the fixed body's surface inside the mobile body", &TouchAnswer::overlap,
                &TouchOverlap::fixed_area_mm2),
    field_along("mobile_area_mm2", "of the mobile body's surface inside the fixed body",
                &TouchAnswer::overlap, &TouchOverlap::mobile_area_mm2),
    field_along("centroid_mm", "of both areas", &TouchAnswer::overlap, &TouchOverlap::centroid),
    field_along(
        "fixed_covered_again_mm3",
        "how much of that volume is counted again because the fixed body covers it more than once: it "
        "crosses itself or has triangles twice",
        &TouchAnswer::overlap, beside_volume<&TouchOverlap::fixed_covered_again_mm3>),
    field_along("mobile_covered_again_mm3", "likewise because of the mobile body", &TouchAnswer::overlap,
                beside_volume<&TouchOverlap::mobile_covered_again_mm3>),
    field("free", &TouchAnswer::free,
          "for each direction of `--along` how far the mobile body moves until it is free, below"),
    field("notes", &TouchAnswer::notes, "`code` and `text` of what the answer must be read with"));
template <>
inline constexpr auto table<motion::Limit> = record(
    "TurnEnd", "First contact of a turn in one sense.",
    field("turned_deg", &motion::Limit::turned, "from the start, at least 0; 360 if nothing meets"),
    field("reason", &motion::Limit::reason, "`\"contact\"`, `\"contact_at_start\"` or `\"end_of_range\"`"),
    field("error_bound_deg", &motion::Limit::error_bound, "contact is not before it, and past it by no more"),
    field_along("contact_point_mm", "where; null without contact, and if one body is inside the other",
                &motion::Limit::contact, &motion::ContactWitness::fixed_point),
    field_along("features", "which features meet, `fixed` and `mobile`", &motion::Limit::contact,
                features_of));
template <>
inline constexpr auto table<motion::FreeInterval> = record(
    "TurnInterval", "Angles between which nothing meets.", field("low_deg", &motion::FreeInterval::low),
    field("high_deg", &motion::FreeInterval::high),
    field_along("low_error_bound_deg", "", &motion::FreeInterval::at_low, &motion::Limit::error_bound),
    field_along("high_error_bound_deg", "", &motion::FreeInterval::at_high, &motion::Limit::error_bound));
template <>
inline constexpr auto table<TurnAnswer> = record(
    "TurnRecord", "A whole turn of the mobile mesh about an axis; points are in the frame of the fixed one.",
    field_along("axis", "its direction as it was given", &TurnAnswer::request, &TurnRequest::axis),
    field_along("centre_mm", "a point on it", &TurnAnswer::request, &TurnRequest::centre),
    field_along("free_at_start", "whether the bodies are apart where they are given", &TurnAnswer::free,
                &motion::FreeAngles::from_start, &motion::RotationLimits::free_at_start),
    field_along("negative", "first contact against the right hand about the axis", &TurnAnswer::free,
                &motion::FreeAngles::from_start, &motion::RotationLimits::negative),
    field_along("positive", "and with it", &TurnAnswer::free, &motion::FreeAngles::from_start,
                &motion::RotationLimits::positive),
    field_along(
        "free",
        "all free intervals, ascending: `low_deg` and `high_deg` from the start, with their error bounds: "
        "free between, and contact "
        "outside by no more. One that holds the start goes from below 0 to above, others lie between 0 and "
        "360",
        &TurnAnswer::free, &motion::FreeAngles::intervals),
    field("notes", &TurnAnswer::notes, "`code` and `text` of what the answer must be read with"));
template <>
inline constexpr auto table<motion::SlideEnd> =
    record("SlideEnd", "First contact of a slide in one sense.",
           field("moved_mm", &motion::SlideEnd::at_mm, "along the direction, signed; null if nothing meets"),
           field("error_bound_mm", &motion::SlideEnd::error_bound_mm,
                 "contact is not before it, and past it by no more"),
           field_along("contact_point_mm", "where", &motion::SlideEnd::contact,
                       &motion::ContactWitness::fixed_point),
           field_along("features", "which faces meet, `fixed` and `mobile`", &motion::SlideEnd::contact,
                       features_of));
template <>
inline constexpr auto table<motion::FreeSlide> = record(
    "SlideInterval", "Positions between which nothing meets.",
    field_along("low_mm", "", &motion::FreeSlide::low, &motion::SlideEnd::at_mm),
    field_along("high_mm", "", &motion::FreeSlide::high, &motion::SlideEnd::at_mm),
    field_along("low_error_bound_mm", "", &motion::FreeSlide::low, &motion::SlideEnd::error_bound_mm),
    field_along("high_error_bound_mm", "", &motion::FreeSlide::high, &motion::SlideEnd::error_bound_mm));
template <>
inline constexpr auto table<SlideAnswer> = record(
    "SlideRecord", "A slide of the mobile mesh along a direction; points are in the frame of the fixed one.",
    field_along("along", "the direction, of length 1", &SlideAnswer::request, &SlideRequest::along,
                core::ordered_direction),
    field_along("free_at_start", "whether the bodies are apart where they are given", &SlideAnswer::free,
                &motion::FreeSlides::free_at_start),
    field_along("negative", "first contact against the direction; 0 in contact at the start",
                &SlideAnswer::free, &motion::FreeSlides::negative),
    field_along("positive", "and along it", &SlideAnswer::free, &motion::FreeSlides::positive),
    field_along(
        "free",
        "all free intervals, ascending: `low_mm` and `high_mm` from the start, null for the ends of the "
        "line, with their error bounds",
        &SlideAnswer::free, &motion::FreeSlides::intervals),
    field("notes", &SlideAnswer::notes, "`code` and `text` of what the answer must be read with"));

}  // namespace condyle
