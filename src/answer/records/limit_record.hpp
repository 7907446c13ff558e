#pragma once

#include <string>
#include <string_view>

#include "answer/living_limit.hpp"
#include "answer/motion_caveats.hpp"
#include "answer/records/record.hpp"
#include "condyle/answer/range.hpp"

namespace condyle {

/// A vertex or a face by its number, or an edge by its two vertices, ascending: in numbers of the mesh, from 0.
struct FeatureRecord {
  motion::FeatureKind kind;
  std::optional<Index> id;
  std::optional<std::array<Index, 2>> vertices;
  std::optional<std::string> part;
};
/// "vertex 12", "edge 3-7", "face 40".
std::string text_of(const FeatureRecord& feature);
/// With the name of its mesh, if a body of several is given.
FeatureRecord feature_record(const motion::Feature& feature, const Body* body = nullptr);

struct FeaturesRecord {
  FeatureRecord fixed, mobile;
};
FeaturesRecord features_of(const motion::ContactWitness& contact);
struct PartsRecord {
  std::optional<std::string> fixed, mobile;
};
struct BandWidthRecord {
  double centre_deg, axes_deg, surface_deg;
  std::optional<double> parameters_deg;
};
struct BandRecord {
  double p5_deg, median_deg, p95_deg;
  std::string text;
  BandWidthRecord width_from;
  double share_without_contact, share_in_contact_at_start;
};
struct BoneReferenceRecord {
  GivenDegrees healthy_deg, cam_without_complaints_deg, patients_deg;
  int people_each;
  bool is_short;
  std::string_view source;
};

/// What a zone has on either body.
template <class Point>
struct ZoneOfBodyRecord {
  std::size_t triangles;
  double area_mm2;
  std::optional<Point> centroid_mm;
  std::optional<double> max_radial_depth_mm, max_tangential_depth_deg, max_tangential_depth_mm;
};
struct FixedZoneRecord : ZoneOfBodyRecord<PointF> {
  std::optional<double> clock_hour;
};
struct MobileZoneRecord : ZoneOfBodyRecord<PointM> {
  std::optional<double> neck_angle_deg;
};
struct ZoneRecord {
  double past_deg;
  std::optional<double> contact_neck_angle_deg;
  FixedZoneRecord fixed;
  MobileZoneRecord mobile;
};

/// Where one motion ends.
struct LimitRecord {
  std::string name;
  double limit_deg;
  motion::LimitReason reason;
  std::optional<std::string_view> ligament = {};
  std::optional<motion::ContactKind> contact_kind = {};
  std::optional<double> bearing_contact_deg = {};
  std::optional<PointF> bearing_contact_point_mm = {};
  std::optional<double> soft_contact_deg = {};
  std::optional<PointF> soft_contact_point_mm = {};
  std::optional<PartsRecord> soft_contact_parts = {};
  std::optional<double> centre_distance_mm = {}, joint_space_mm = {};
  double error_bound_deg;
  JointAngle vary;
  RotationSense sense;
  GivenDegrees range_deg;
  OfAngles<GivenDegrees> start_deg = {}, held_deg = {};
  ZeroFrom zero_from;
  std::optional<std::string_view> definition = {};
  OfAngles<double> at_limit_deg = {};
  std::optional<Vec3> translation_mm = {};
  std::optional<bool> translation_ends = {};
  std::optional<PointF> contact_point_mm = {};
  std::optional<PointM> contact_point_mobile_mm = {};
  std::optional<FeaturesRecord> features = {};
  std::optional<motion::ContactSide> contact_side = {};
  std::optional<double> clock_hour = {};
  std::optional<GivenDegrees> normal_range_deg = {};
  std::optional<BoneReferenceRecord> bone_reference = {};
  std::optional<LivingLimit> living = {};
  std::vector<MotionCaveat> caveats = {};
  std::string guarantee;
  std::optional<motion::DepthLimit> depth = {};
  std::optional<plan::ClosedLimit> closed_form = {};
  std::optional<std::optional<ZoneRecord>> zone =
      {};  ///< without zones empty, without one past this limit null
  std::optional<BandRecord> band = {};
};

/// The i-th limit of an answer.
LimitRecord limit_record(const RangeAnswer& answer, std::size_t i);

template <>
inline constexpr auto table<FeatureRecord> = record("FeatureRecord",
                                                    "A vertex or a face by its number, or an edge by its two "
                                                    "vertices, ascending: in numbers of the mesh, from 0.",
                                                    field("kind", &FeatureRecord::kind),
                                                    field_if_any("vertices", &FeatureRecord::vertices),
                                                    field_if_any("id", &FeatureRecord::id),
                                                    field_if_any("part", &FeatureRecord::part));
template <>
inline constexpr auto table<FeaturesRecord> = record("FeaturesRecord", "What is in contact of either body.",
                                                     CONDYLE_KEYS(FeaturesRecord, fixed, mobile));
template <>
inline constexpr auto table<PartsRecord> =
    record("PartsRecord", "Names of the meshes that touch, None of a body of one mesh.",
           CONDYLE_KEYS(PartsRecord, fixed, mobile));
template <>
inline constexpr auto table<motion::DepthLimit> = record(
    "AllowedDepthRecord", "Depths of a limit with a depth allowed.",
    field("at_start_mm", &motion::DepthLimit::start_depth_mm),
    field_along("at_limit_mm", "", &motion::DepthLimit::at_limit, &motion::DeepestPlace::depth_mm),
    field_along("ray_to_normal_deg", "", &motion::DepthLimit::at_limit, &motion::DeepestPlace::ray_to_normal),
    field("grows", &motion::DepthLimit::depth_grows));
template <>
inline constexpr auto table<plan::ClosedLimit> =
    record("ClosedForm", "Where liner and neck of an implant end a motion, as bodies of revolution.",
           field("limit_deg", &plan::ClosedLimit::turned), field("reason", &plan::ClosedLimit::reason),
           field("of_facets_deg", [](const plan::ClosedLimit& limit) {
             return std::array{limit.of_facets_low, limit.of_facets_high};
           }));
template <>
inline constexpr auto table<BandWidthRecord> =
    record("BandWidthRecord", "Width of a band if only one source was uncertain.",
           CONDYLE_KEYS(BandWidthRecord, centre_deg, axes_deg, surface_deg),
           field_if_any("parameters_deg", &BandWidthRecord::parameters_deg));
template <>
inline constexpr auto table<BandRecord> = record("BandRecord", "The limit over the joints of a band.",
                                                 CONDYLE_KEYS(BandRecord, p5_deg, median_deg, p95_deg, text,
                                                              width_from, share_without_contact,
                                                              share_in_contact_at_start));
template <>
inline constexpr auto table<BoneReferenceRecord> =
    record("BoneReference", "Means of simulations of bone in other people's hips; their spread is not given.",
           CONDYLE_KEYS(BoneReferenceRecord, healthy_deg, cam_without_complaints_deg, patients_deg,
                        people_each, is_short, source));
template <>
inline constexpr auto table<SoftTissueGap> = record(
    "SoftTissueGap", "How much earlier soft tissue ended the motion than bone, in hips of cadavers.",
    field("closeness", &SoftTissueGap::closeness),
    field_along("mean_deg", "", &SoftTissueGap::mean, as_given),
    field_along("sd_deg", "", &SoftTissueGap::sd, as_given), CONDYLE_KEYS(SoftTissueGap, hips, source));
template <>
inline constexpr auto table<PeopleRange> =
    record("PeopleRange", "How far other people's hips turn, soft tissue included; never of this joint.",
           field_along("low_deg", "", &PeopleRange::low, as_given),
           field_along("high_deg", "", &PeopleRange::high, as_given),
           CONDYLE_KEYS(PeopleRange, who, people, source));
template <>
inline constexpr auto table<LivingLimit> =
    record("LivingLimit", "What studies say of the living beside a limit of bone.",
           field("expected_deg", &LivingLimit::expected), field("expected_sd_deg", &LivingLimit::expected_sd),
           CONDYLE_KEYS(LivingLimit, gap, people),
           field("text", [](const LivingLimit& living) { return text_of(living); }));
template <>
inline constexpr auto table<MotionCaveat> =
    record("Caveat", "A caveat to read before a limit is compared with a living joint.",
           CONDYLE_KEYS(MotionCaveat, code, text), field("source", [](const MotionCaveat& caveat) {
             return caveat.source.empty() ? std::nullopt : std::optional(caveat.source);
           }));

template <class Record, class OwnField>
constexpr auto zone_table(const char* name, const char* meaning, OwnField of_this_body) {
  return record(name, meaning,
                CONDYLE_KEYS(Record, triangles, area_mm2, centroid_mm, max_radial_depth_mm,
                             max_tangential_depth_deg, max_tangential_depth_mm),
                of_this_body);
}
template <>
inline constexpr auto table<FixedZoneRecord> =
    zone_table<FixedZoneRecord>("FixedZoneRecord", "The overlap past a limit, on the fixed body.",
                                field("clock_hour", &FixedZoneRecord::clock_hour));
template <>
inline constexpr auto table<MobileZoneRecord> =
    zone_table<MobileZoneRecord>("MobileZoneRecord", "The overlap past a limit, on the mobile body.",
                                 field("neck_angle_deg", &MobileZoneRecord::neck_angle_deg));
template <>
inline constexpr auto table<ZoneRecord> = record("ZoneRecord", "The overlap past a limit.",
                                                 CONDYLE_KEYS(ZoneRecord, past_deg, contact_neck_angle_deg,
                                                              fixed, mobile));

template <>
inline constexpr auto table<LimitRecord> = record(
    "LimitRecord", "Where one motion ends, in the words of rom.json.",
    field("name", &LimitRecord::name, "of the motion", {"motion", "by its name", Tables::studies}),
    field("limit_deg", &LimitRecord::limit_deg, "how far it turned from its start; ≥ 0 whatever the sense",
          {"", "how far the joint turns from the motion's start", Tables::studies}),
    field("reason", &LimitRecord::reason,
          "`\"contact\"`, `\"end_of_range\"` (no contact), `\"contact_at_start\"` (`limit_deg` is 0), "
          "`\"ligament\"`, `\"strained_at_start\"` (likewise)",
          {"", "contact, end_of_range, contact_at_start, ligament or strained_at_start", Tables::studies}),
    field("ligament", &LimitRecord::ligament, "the ligament that ends the motion; null if none does",
          {"", "the ligament that ends the motion", Tables::studies}),
    field("contact_kind", &LimitRecord::contact_kind,
          "`\"impingement\"`, `\"bearing\"`, `\"cut\"` on a face that closes a bone where its image ends or "
          "it was cut off, or `\"unknown\"` if no bearing surface is known; null at the end of the range",
          {"", "impingement, bearing, cut or unknown; empty without contact", Tables::studies}),
    field("bearing_contact_deg", &LimitRecord::bearing_contact_deg,
          "where bearing surfaces touch first, if before the limit; else null. A flag, not a measure: centre "
          "and segmentation are rarely better than it needs",
          {"", "first bearing contact on the way; empty: none", Tables::studies}),
    field("bearing_contact_point_mm", &LimitRecord::bearing_contact_point_mm,
          "where, in the fixed body's joint frame"),
    field("soft_contact_deg", &LimitRecord::soft_contact_deg,
          "where a mesh called soft touches first, if before the limit; else null",
          {"", "first contact of a soft mesh on the way; empty: none", Tables::studies}),
    field("soft_contact_point_mm", &LimitRecord::soft_contact_point_mm,
          "where, in the fixed body's joint frame"),
    field("soft_contact_parts", &LimitRecord::soft_contact_parts,
          "`fixed` and `mobile`: names of the meshes that touch there, null of a body of one mesh"),
    column_of(FieldColumn{"soft_fixed_part",
                          "which mesh of the fixed body is touched there, if it has several",
                          Tables::studies},
              &LimitRecord::soft_contact_parts, &PartsRecord::fixed),
    column_of(FieldColumn{"soft_mobile_part",
                          "which mesh of the mobile body is touched there, if it has several",
                          Tables::studies},
              &LimitRecord::soft_contact_parts, &PartsRecord::mobile),
    field("centre_distance_mm", &LimitRecord::centre_distance_mm,
          "between the centres of head and socket at the limit; null without either",
          {"", "between head and socket at the limit", Tables::studies}),
    field("joint_space_mm", &LimitRecord::joint_space_mm,
          "the smallest distance between bearing surface and fixed body at the limit, 0 where they meet; "
          "null if bearing contact counts",
          {"", "smallest distance of the bearing surface there", Tables::studies}),
    field("error_bound_deg", &LimitRecord::error_bound_deg,
          "true contact is at the limit or past it by at most this, and never before",
          {"", "by which the limit may be short of the exact one", Tables::studies}),
    field("vary", &LimitRecord::vary, "the angle that varies", {"", "the angle that varies", Tables::rom}),
    field("sense", &LimitRecord::sense, "`\"positive\"` or `\"negative\"`",
          {"", "positive or negative", Tables::rom}),
    field("range_deg", &LimitRecord::range_deg, "how far it may change",
          {"", "how far it may change", Tables::rom}),
    field("start_deg", &LimitRecord::start_deg,
          "all three angles at the start, digit by digit as given (15 digits and fewer)",
          {"start", "at the start", Tables::rom}),
    field("held_deg", &LimitRecord::held_deg, "the two that were held"),
    field("zero_from", &LimitRecord::zero_from,
          "what zero angles are known by, as in `zero`: `\"as_given\"`, `\"stated\"`, `\"landmarks\"` or "
          "`\"anatomy\"`",
          {"", "what zero is known by: as_given, stated, landmarks or anatomy", Tables::studies}),
    field("definition", &LimitRecord::definition,
          "of `fadir` and `faber`: `\"as defined here; no angles are agreed on\"`, their angles are "
          "`start_deg` and `vary`; null for other motions"),
    field("at_limit_deg", &LimitRecord::at_limit_deg, "all three angles at the limit",
          {"limit", "at the limit", Tables::rom}),
    field("translation_mm", &LimitRecord::translation_mm,
          "x, y and z of the mobile body's origin at the limit, if its translation follows a recorded motion "
          "or a load; else null",
          {"translation", "at the limit, if it follows a recorded motion or a load",
           Tables::studies_that_follow}),
    field("translation_ends", &LimitRecord::translation_ends,
          "whether what the translation follows ends at the limit, before the motion does: there is no "
          "contact up to it, and nothing is known past it. With `translation_mm` null no contact carries the "
          "load at the start either, and `limit_deg` is 0; null if nothing is followed",
          {"", "true if what the translation follows ends there: no contact up to it, nothing known past it",
           Tables::studies_that_follow}),
    field("contact_point_mm", &LimitRecord::contact_point_mm,
          "where the bodies are in contact at the limit, in the fixed body's joint frame; null without "
          "contact, and if one body is inside the other and their surfaces do not meet",
          {"contact", "contact on the fixed body, joint frame", Tables::studies}),
    field("contact_point_mobile_mm", &LimitRecord::contact_point_mobile_mm,
          "the same point of the mobile body, in the mobile body's frame (the joint frame at zero angles)",
          {"contact_mobile", "contact on the mobile body, its own frame", Tables::rom}),
    field("features", &LimitRecord::features,
          "`fixed` and `mobile`, each `{\"kind\": \"vertex\", \"id\": n}`, `{\"kind\": \"face\", \"id\": n}` "
          "or `{\"kind\": \"edge\", \"vertices\": [a, b]}` with a < b, in numbers of the mesh, from 0, and "
          "`part` of a body of several meshes; null without a contact point"),
    column_of(FieldColumn{"fixed_feature",
                          "what is in contact: vertex 12, edge 3-7 or face 40 of the fixed mesh",
                          Tables::rom},
              &LimitRecord::features, &FeaturesRecord::fixed),
    column_of(FieldColumn{"mobile_feature", "the same of the mobile mesh", Tables::rom},
              &LimitRecord::features, &FeaturesRecord::mobile),
    column_of(FieldColumn{"fixed_part", "which mesh of the fixed body, if it has several", Tables::studies},
              &LimitRecord::features, &FeaturesRecord::fixed, &FeatureRecord::part),
    column_of(FieldColumn{"mobile_part", "which mesh of the mobile body, if it has several", Tables::studies},
              &LimitRecord::features, &FeaturesRecord::mobile, &FeatureRecord::part),
    field("contact_side", &LimitRecord::contact_side,
          "of a shoulder the side of the joint centre on which contact that is not bearing contact ended the "
          "motion: `\"superior\"`, where the acromion is, `\"anterior\"` (coracoid process), `\"inferior\"` "
          "(lower rim and neck of the scapula) or `\"posterior\"`; null for other joints, without contact, "
          "and within 30 degrees of the joint's Z",
          {"",
           "of a shoulder: side of the joint centre, superior at the acromion, anterior at the coracoid "
           "process",
           Tables::studies, TablesOf::shoulders}),
    field("clock_hour", &LimitRecord::clock_hour,
          "direction of the contact on the socket's clock face, in [0, 12): 0 superior, 3 anterior on either "
          "side of the body, in the plane that `clock_plane` says; null for joints other than hips, without "
          "contact, and for contacts farther than 1.6 head radii from the joint centre, which are not at the "
          "rim",
          {"", "of the contact on the socket, 12 superior, 3 anterior, sagittal plane", Tables::studies,
           TablesOf::hips}),
    column_of(FieldColumn{"band_p5_deg", "5 % of the limits of the varied joints are below",
                          Tables::studies_with_bands},
              &LimitRecord::band, &BandRecord::p5_deg),
    column_of(FieldColumn{"band_median_deg", "median of the limits of the varied joints",
                          Tables::studies_with_bands},
              &LimitRecord::band, &BandRecord::median_deg),
    column_of(FieldColumn{"band_p95_deg", "5 % of them are above", Tables::studies_with_bands},
              &LimitRecord::band, &BandRecord::p95_deg),
    column_of(FieldColumn{"band_from_centre_deg", "width of the band if only the centre was uncertain",
                          Tables::rom},
              &LimitRecord::band, &BandRecord::width_from, &BandWidthRecord::centre_deg),
    column_of(FieldColumn{"band_from_axes_deg", "width of the band if only the axes were uncertain",
                          Tables::rom},
              &LimitRecord::band, &BandRecord::width_from, &BandWidthRecord::axes_deg),
    column_of(FieldColumn{"band_from_surface_deg", "width of the band if only the surfaces were uncertain",
                          Tables::rom},
              &LimitRecord::band, &BandRecord::width_from, &BandWidthRecord::surface_deg),
    column_of(FieldColumn{"band_share_without_contact", "share that reaches the end of the range, 0 to 1",
                          Tables::studies_with_bands},
              &LimitRecord::band, &BandRecord::share_without_contact),
    field("normal_range_deg", &LimitRecord::normal_range_deg,
          "how far a healthy hip turns from neutral in this motion by the source, below; null if the source "
          "has no value, if zero angles are not known to be neutral (`zero`), and for other joints",
          {"", "how far a healthy hip turns by the source; empty if zero is not known to be neutral",
           Tables::rom}),
    field_if_any(
        "bone_reference", &LimitRecord::bone_reference,
        "only of internal rotation at 90° flexion of a hip without implant, with zero known to be neutral "
        "and no end but impingement: means of [simulations of "
        "bone](range-of-motion.md#ranges-of-bone), `healthy_deg`, `cam_without_complaints_deg`, "
        "`patients_deg`, `people_each`, `source`; `is_short` if the limit is not above that of hips "
        "with a cam"),
    column_of(FieldColumn{"bone_reference_deg",
                          "where bone ends the motion in healthy hips by simulation; empty without a source",
                          Tables::rom},
              &LimitRecord::bone_reference, &BoneReferenceRecord::healthy_deg),
    field_if_any(
        "living", &LimitRecord::living,
        "[what studies say of living hips](range-of-motion.md#living-hips), without an implant and with zero "
        "known to be neutral: `gap`, how much earlier soft tissue ended the motion than bone in cadavers "
        "(`closeness`: `\"close\"`, `\"moderate\"` or `\"weak\"`), or null; `expected_deg` and "
        "`expected_sd_deg` of the close ones that impingement ends, else null; `people`, how far others "
        "turn, or null; `text`, such as `\"some 131 (SD 5)\"`"),
    column_of(FieldColumn{"living_expected_deg",
                          "where a living hip with this bone is expected to end; empty where studies do not "
                          "say so",
                          Tables::studies},
              &LimitRecord::living, &LivingLimit::expected),
    column_of(FieldColumn{"living_expected_sd_deg", "its standard deviation, of the study and the band",
                          Tables::studies},
              &LimitRecord::living, &LivingLimit::expected_sd),
    field("caveats", &LimitRecord::caveats,
          "list of `code`, `text` and `source` each: [what usually ends such a "
          "motion](range-of-motion.md#caveats); "
          "empty for joints other than hips"),
    column_of(FieldColumn{"caveats", "codes of what usually ends such a motion, with blanks between",
                          Tables::studies},
              &LimitRecord::caveats),
    field("guarantee", &LimitRecord::guarantee, "what is guaranteed of the limit, in words"),
    field_if_any("depth", &LimitRecord::depth, "only with `--allow-depth`, below"),
    field_if_any("closed_form", &LimitRecord::closed_form,
                 "only of an implant whose liner and neck are bodies of revolution: where these two end the "
                 "motion, `limit_deg` and `reason`, and `of_facets_deg`, between which their meshes do"),
    field_if_any("zone", &LimitRecord::zone,
                 "only with `--past`, below; null for motions that did not end by contact"),
    field("band", &LimitRecord::band,
          "`p5_deg`, `median_deg`, `p95_deg` of the limit over the joints of the band; `text`, such as "
          "`\"88–>120\"` where 5 % of them end with the range; `width_from`: what "
          "the width, 5 to 95 %, would be if only the centre (`centre_deg`), the axes (`axes_deg`), the "
          "surfaces (`surface_deg`) or parameters of parts (`parameters_deg`, if they have standard "
          "deviations) were uncertain; `share_without_contact`, `share_in_contact_at_start` of the joints, 0 "
          "to 1. Null without `--band`"));

}  // namespace condyle
