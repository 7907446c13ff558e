#include "io/result/limit_fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "condyle/io/pose_text.hpp"
#include "condyle/joint_checks.hpp"
#include "io/file/csv_fields.hpp"
#include "io/joint/given_degrees.hpp"
#include "io/result/caveats.hpp"
#include "io/result/clock_hour.hpp"
#include "io/result/rom_parts.hpp"
#include "io/result/zone_json.hpp"

namespace condyle::io {
namespace {

/// One value for each angle of the joint, under its name.
Json of_angles(const Joint& joint, const auto& of_angle) {
  Json json;
  for (const JointAngle angle : all_joint_angles) json[name_of(angle, joint.anatomy)] = of_angle(angle);
  return json;
}

Json name(const LimitOf& of) {
  return of.limit().motion.name;
}
Json limit_deg(const LimitOf& of) {
  return of.limit().end.turned.degrees();
}
Json reason(const LimitOf& of) {
  return name_of(of.limit().end.reason);
}
Json contact_kind(const LimitOf& of) {
  return ends_in_contact(of.limit()) ? Json(name_of(of.limit().end.kind())) : Json(nullptr);
}
Json bearing_contact_deg(const LimitOf& of) {
  const auto& bearing = of.limit().end.bearing_contact;
  return bearing ? Json(bearing->turned.degrees()) : Json(nullptr);
}
Json bearing_contact_point_mm(const LimitOf& of) {
  const auto& bearing = of.limit().end.bearing_contact;
  return bearing && bearing->contact ? numbers(frame_of(of.result).fixed_point(bearing->contact->fixed_point))
                                     : Json(nullptr);
}
Json soft_contact_deg(const LimitOf& of) {
  const auto& soft = of.limit().end.soft_contact;
  return soft ? Json(soft->turned.degrees()) : Json(nullptr);
}
Json soft_contact_point_mm(const LimitOf& of) {
  const auto& soft = of.limit().end.soft_contact;
  return soft && soft->contact ? numbers(frame_of(of.result).fixed_point(soft->contact->fixed_point))
                               : Json(nullptr);
}
/// The mesh of a body of several that a contact is on.
Json part_name(const Body& body, const motion::Feature& feature) {
  const BodyPart* part = part_of(body, feature);
  return part ? Json(part->name) : Json(nullptr);
}
Json soft_contact_parts(const LimitOf& of) {
  const auto& soft = of.limit().end.soft_contact;
  if (!soft || !soft->contact) return nullptr;
  return {{"fixed", part_name(of.joint().fixed, soft->contact->fixed_feature)},
          {"mobile", part_name(of.joint().mobile, soft->contact->mobile_feature)}};
}
Json soft_part(const LimitOf& of, const Body& body, motion::Feature motion::ContactWitness::*feature) {
  const auto& soft = of.limit().end.soft_contact;
  return soft && soft->contact ? part_name(body, (*soft->contact).*feature) : Json(nullptr);
}
Json soft_fixed_part(const LimitOf& of) {
  return soft_part(of, of.joint().fixed, &motion::ContactWitness::fixed_feature);
}
Json soft_mobile_part(const LimitOf& of) {
  return soft_part(of, of.joint().mobile, &motion::ContactWitness::mobile_feature);
}
Json centre_distance_mm(const LimitOf& of) {
  return of.limit().head ? nullable(of.limit().head->centre_distance_mm) : Json(nullptr);
}
Json joint_space_mm(const LimitOf& of) {
  return of.limit().head ? nullable(of.limit().head->joint_space_mm) : Json(nullptr);
}
Json error_bound_deg(const LimitOf& of) {
  return of.limit().end.error_bound.degrees();
}

Json vary(const LimitOf& of) {
  return name_of(of.limit().motion.vary, of.joint().anatomy);
}
Json sense(const LimitOf& of) {
  return of.limit().motion.sense == RotationSense::positive ? "positive" : "negative";
}
Json range_deg(const LimitOf& of) {
  return given_degrees(of.limit().motion.range);
}
Json start_deg(const LimitOf& of) {
  return of_angles(of.joint(),
                   [&](JointAngle angle) { return given_degrees(angle_of(of.limit().motion.start, angle)); });
}
Json held_deg(const LimitOf& of) {
  const motion::Motion& motion = of.limit().motion;
  Json json;
  for (const JointAngle angle : all_joint_angles)
    if (angle != motion.vary)
      json[name_of(angle, of.joint().anatomy)] = given_degrees(angle_of(motion.start, angle));
  return json;
}
Json definition(const LimitOf& of) {
  return is_as_defined_here(of.limit().motion) ? Json("as defined here; no angles are agreed on")
                                               : Json(nullptr);
}
Json at_limit_deg(const LimitOf& of) {
  return of_angles(of.joint(),
                   [&](JointAngle angle) { return angle_of(of.limit().angles_at_limit(), angle).degrees(); });
}

Json translation_mm(const LimitOf& of) {
  const auto& translation = of.limit().translation_mm;
  return translation ? numbers(*translation) : Json(nullptr);
}

Json translation_ends(const LimitOf& of) {
  return of.result.answer.follows ? Json(of.limit().translation_ends) : Json(nullptr);
}
Json translation_ends_word(const LimitOf& of) {
  return of.result.answer.follows ? Json(of.limit().translation_ends ? "true" : "false") : Json(nullptr);
}

Json contact_point_mm(const LimitOf& of) {
  const auto& contact = of.limit().end.contact;
  return contact ? numbers(frame_of(of.result).fixed_point(contact->fixed_point)) : Json(nullptr);
}
Json contact_point_mobile_mm(const LimitOf& of) {
  const auto& contact = of.limit().end.contact;
  return contact ? numbers(frame_of(of.result).mobile_point(contact->mobile_point)) : Json(nullptr);
}
Json feature_json(const motion::Feature& feature, const Body& body) {
  Json json{{"kind", name_of(feature.kind)}};
  if (feature.kind == motion::FeatureKind::edge)
    json["vertices"] = {feature.id, feature.other_end};
  else
    json["id"] = feature.id;
  if (const BodyPart* part = part_of(body, feature)) json["part"] = part->name;
  return json;
}
Json features(const LimitOf& of) {
  const auto& contact = of.limit().end.contact;
  if (!contact) return nullptr;
  return {{"fixed", feature_json(contact->fixed_feature, of.joint().fixed)},
          {"mobile", feature_json(contact->mobile_feature, of.joint().mobile)}};
}
Json fixed_feature(const LimitOf& of) {
  const auto& contact = of.limit().end.contact;
  return contact ? Json(io::text_of(contact->fixed_feature)) : Json(nullptr);
}
Json mobile_feature(const LimitOf& of) {
  const auto& contact = of.limit().end.contact;
  return contact ? Json(io::text_of(contact->mobile_feature)) : Json(nullptr);
}
Json fixed_part(const LimitOf& of) {
  const auto& contact = of.limit().end.contact;
  return contact ? part_name(of.joint().fixed, contact->fixed_feature) : Json(nullptr);
}
Json mobile_part(const LimitOf& of) {
  const auto& contact = of.limit().end.contact;
  return contact ? part_name(of.joint().mobile, contact->mobile_feature) : Json(nullptr);
}
Json side(const LimitOf& of) {
  const auto found = motion::contact_side(of.joint(), of.limit());
  return found ? Json(name_of(*found)) : Json(nullptr);
}
Json hour(const LimitOf& of) {
  return nullable(clock_hour(of.result, of.limit()));
}

/// A number of the band, null without bands.
Json of_band(const LimitOf& of, const auto& read) {
  const auto& bands = of.result.answer.bands;
  return bands.empty() ? Json(nullptr) : Json(read(bands[of.index]));
}
Json band(const LimitOf& of) {
  const bool has_parameters = has_uncertain_parameters(of.joint());
  return of_band(of, [&](const motion::LimitBand& band) {
    Json json{{"p5_deg", band.p5.degrees()},
              {"median_deg", band.median.degrees()},
              {"p95_deg", band.p95.degrees()},
              {"width_from",
               {{"centre_deg", band.width_from.centre.degrees()},
                {"axes_deg", band.width_from.axes.degrees()},
                {"surface_deg", band.width_from.surface.degrees()}}},
              {"share_without_contact", band.share_without_contact},
              {"share_in_contact_at_start", band.share_in_contact_at_start}};
    if (has_parameters) json["width_from"]["parameters_deg"] = band.width_from.parameters.degrees();
    return json;
  });
}
Json band_p5(const LimitOf& of) {
  return of_band(of, [](const motion::LimitBand& band) { return band.p5.degrees(); });
}
Json band_median(const LimitOf& of) {
  return of_band(of, [](const motion::LimitBand& band) { return band.median.degrees(); });
}
Json band_p95(const LimitOf& of) {
  return of_band(of, [](const motion::LimitBand& band) { return band.p95.degrees(); });
}
Json band_from_centre(const LimitOf& of) {
  return of_band(of, [](const motion::LimitBand& band) { return band.width_from.centre.degrees(); });
}
Json band_from_axes(const LimitOf& of) {
  return of_band(of, [](const motion::LimitBand& band) { return band.width_from.axes.degrees(); });
}
Json band_from_surface(const LimitOf& of) {
  return of_band(of, [](const motion::LimitBand& band) { return band.width_from.surface.degrees(); });
}
Json band_without_contact(const LimitOf& of) {
  return of_band(of, [](const motion::LimitBand& band) { return band.share_without_contact; });
}

Json normal_range_deg(const LimitOf& of) {
  const auto angle = normal_range(of.joint(), of.limit());
  return angle ? Json(given_degrees(*angle)) : Json(nullptr);
}
Json zero_from(const LimitOf& of) {
  return name_of(of.joint().zero_from);
}
Json caveats(const LimitOf& of) {
  return caveats_json(motion_caveats(of.joint(), of.limit().motion));
}
Json caveat_codes(const LimitOf& of) {
  std::string codes;
  for (const MotionCaveat& caveat : motion_caveats(of.joint(), of.limit().motion))
    codes += fmt::format("{}{}", codes.empty() ? "" : " ", name_of(caveat.code));
  return codes;
}
Json guarantee(const LimitOf& of) {
  const auto& depths = of.result.answer.depths;
  return depths.empty() ? guarantee_text(of.limit()) : guarantee_text(depths[of.index]);
}
Json depth(const LimitOf& of) {
  if (of.result.answer.depths.empty()) return left_out();
  const motion::DepthLimit& depth = of.result.answer.depths[of.index];
  return {{"at_start_mm", depth.start_depth_mm},
          {"at_limit_mm", depth.at_limit.depth_mm},
          {"ray_to_normal_deg", depth.at_limit.ray_to_normal.degrees()},
          {"grows", depth.depth_grows}};
}
Json closed_form(const LimitOf& of) {
  if (of.result.answer.closed.empty()) return left_out();
  const plan::ClosedLimit& closed = of.result.answer.closed[of.index];
  return {{"limit_deg", closed.turned.degrees()},
          {"reason", name_of(closed.reason)},
          {"of_facets_deg", {closed.of_facets_low.degrees(), closed.of_facets_high.degrees()}}};
}
Json zone(const LimitOf& of) {
  if (of.result.answer.zones.empty()) return left_out();
  return zone_json(of.result.answer.zones[of.index], frame_of(of.result));
}

constexpr auto one = LimitColumns::one, point = LimitColumns::point, angles = LimitColumns::angles;
constexpr auto rom = LimitTables::rom, studies = LimitTables::studies,
               with_bands = LimitTables::studies_with_bands;

/// Value, and in tables: columns, their name, unit, kind, meaning, and whose they are.
constexpr LimitField every_field[] = {
    {"name", "of the motion", &name, one, "motion", "", text_column, "by its name", studies},
    {"limit_deg", "how far it turned from its start; ≥ 0 whatever the sense", &limit_deg, one, "limit_deg",
     "deg", number_column, "how far the joint turns from the motion's start", studies},
    {"reason", "`\"contact\"`, `\"end_of_range\"` (no contact), `\"contact_at_start\"` (`limit_deg` is 0)",
     &reason, one, "reason", "", text_column, "contact, end_of_range or contact_at_start", studies},
    {"contact_kind",
     "`\"impingement\"`, `\"bearing\"`, `\"cut\"` on a face that closes a bone where its image ends or it "
     "was cut "
     "off, or `\"unknown\"` if no bearing surface is known; null "
     "at the end of the range",
     &contact_kind, one, "contact_kind", "", text_column,
     "impingement, bearing, cut or unknown; empty without contact", studies},
    {"bearing_contact_deg",
     "where bearing surfaces touch first, if before the limit; else null. A flag, not a "
     "measure: centre and segmentation are rarely better than it needs",
     &bearing_contact_deg, one, "bearing_contact_deg", "deg", number_column,
     "first bearing contact on the way; empty: none", studies},
    {"bearing_contact_point_mm", "where, in the fixed body's joint frame", &bearing_contact_point_mm},
    {"soft_contact_deg", "where a mesh called soft touches first, if before the limit; else null",
     &soft_contact_deg, one, "soft_contact_deg", "deg", number_column,
     "first contact of a soft mesh on the way; empty: none", studies},
    {"soft_contact_point_mm", "where, in the fixed body's joint frame", &soft_contact_point_mm},
    {"soft_contact_parts",
     "`fixed` and `mobile`: names of the meshes that touch there, null of a body of one mesh",
     &soft_contact_parts},
    {"", "", &soft_fixed_part, one, "soft_fixed_part", "", text_column,
     "which mesh of the fixed body is touched there, if it has several", studies},
    {"", "", &soft_mobile_part, one, "soft_mobile_part", "", text_column,
     "which mesh of the mobile body is touched there, if it has several", studies},
    {"centre_distance_mm", "between the centres of head and socket at the limit; null without either",
     &centre_distance_mm, one, "centre_distance_mm", "mm", number_column,
     "between head and socket at the limit", studies},
    {"joint_space_mm",
     "the smallest distance between bearing surface and fixed body at the limit, 0 where they "
     "meet; null if bearing contact counts",
     &joint_space_mm, one, "joint_space_mm", "mm", number_column,
     "smallest distance of the bearing surface there", studies},
    {"error_bound_deg", "true contact is at the limit or past it by at most this, and never before",
     &error_bound_deg, one, "error_bound_deg", "deg", number_column,
     "by which the limit may be short of the exact one", studies},
    {"vary", "the angle that varies", &vary, one, "vary", "", text_column, "the angle that varies", rom},
    {"sense", "`\"positive\"` or `\"negative\"`", &sense, one, "sense", "", text_column,
     "positive or negative", rom},
    {"range_deg", "how far it may change", &range_deg, one, "range_deg", "deg", number_column,
     "how far it may change", rom},
    {"start_deg", "all three angles at the start, digit by digit as given (15 digits and fewer)", &start_deg,
     angles, "start", "deg", number_column, "at the start", rom},
    {"held_deg", "the two that were held", &held_deg},
    {"zero_from",
     "what zero angles are known by, as in `zero`: `\"as_given\"`, `\"stated\"`, `\"landmarks\"` or "
     "`\"anatomy\"`",
     &zero_from, one, "zero_from", "", text_column,
     "what zero is known by: as_given, stated, landmarks or anatomy", studies},
    {"definition",
     "of `fadir` and `faber`: `\"as defined here; no angles are agreed on\"`, their angles are "
     "`start_deg` and `vary`; null for other motions",
     &definition},
    {"at_limit_deg", "all three angles at the limit", &at_limit_deg, angles, "limit", "deg", number_column,
     "at the limit", rom},
    {"translation_mm",
     "x, y and z of the mobile body's origin at the limit, if its translation follows a recorded motion or a "
     "load; else null",
     &translation_mm, point, "translation", "mm", number_column,
     "at the limit, if it follows a recorded motion or a load", LimitTables::studies_that_follow},
    {"translation_ends",
     "whether what the translation follows ends at the limit, before the motion does: there is no contact up "
     "to it, and nothing is "
     "known past it. With `translation_mm` null no contact carries the load at the start either, and "
     "`limit_deg` is 0; null if "
     "nothing is followed",
     &translation_ends},
    {"", "", &translation_ends_word, one, "translation_ends", "", text_column,
     "true if what the translation follows ends there: no contact up to it, nothing known past it",
     LimitTables::studies_that_follow},
    {"contact_point_mm",
     "where the bodies are in contact at the limit, in the fixed body's joint frame; null "
     "without contact, and if one body is inside the other and their surfaces do not meet",
     &contact_point_mm, point, "contact", "mm", number_column, "contact on the fixed body, joint frame",
     studies},
    {"contact_point_mobile_mm",
     "the same point of the mobile body, in the mobile body's frame (the joint frame at zero angles)",
     &contact_point_mobile_mm, point, "contact_mobile", "mm", number_column,
     "contact on the mobile body, its own frame", rom},
    {"features",
     "`fixed` and `mobile`, each `{\"kind\": \"vertex\", \"id\": n}`, `{\"kind\": \"face\", "
     "\"id\": n}` or `{\"kind\": \"edge\", \"vertices\": [a, b]}` with a < b, in numbers of "
     "the mesh, from 0, and `part` of a body of several meshes; null without a contact point",
     &features},
    {"", "", &fixed_feature, one, "fixed_feature", "", text_column,
     "what is in contact: vertex 12, edge 3-7 or face 40 of the fixed mesh", rom},
    {"", "", &mobile_feature, one, "mobile_feature", "", text_column, "the same of the mobile mesh", rom},
    {"", "", &fixed_part, one, "fixed_part", "", text_column,
     "which mesh of the fixed body, if it has several", studies},
    {"", "", &mobile_part, one, "mobile_part", "", text_column,
     "which mesh of the mobile body, if it has several", studies},
    {"contact_side",
     "of a shoulder the side of the joint centre on which contact that is not bearing contact ended the "
     "motion: `\"superior\"`, where "
     "the acromion is, `\"anterior\"` (coracoid process), `\"inferior\"` (lower rim and neck of the scapula) "
     "or `\"posterior\"`; null for "
     "other joints, without contact, and within 30 degrees of the joint's Z",
     &side, one, "contact_side", "", text_column,
     "of a shoulder: side of the joint centre, superior at the acromion, anterior at the coracoid process",
     studies, LimitJoints::shoulders},
    {"clock_hour",
     "direction of the contact on the socket's clock face, in [0, 12): 0 superior, 3 anterior "
     "on either side of the body, in the plane that `clock_plane` says; null for joints other "
     "than hips, without contact, and for contacts farther than 1.6 head radii from the joint "
     "centre, which are not at the rim",
     &hour, one, "clock_hour", "h", number_column,
     "of the contact on the socket, 12 superior, 3 anterior, sagittal plane", studies, LimitJoints::hips},
    {"", "", &band_p5, one, "band_p5_deg", "deg", number_column,
     "5 % of the limits of the displaced joints are below", with_bands},
    {"", "", &band_median, one, "band_median_deg", "deg", number_column,
     "median of the limits of the displaced joints", with_bands},
    {"", "", &band_p95, one, "band_p95_deg", "deg", number_column, "5 % of them are above", with_bands},
    {"", "", &band_from_centre, one, "band_from_centre_deg", "deg", number_column,
     "width of the band if only the centre was uncertain", rom},
    {"", "", &band_from_axes, one, "band_from_axes_deg", "deg", number_column,
     "width of the band if only the axes were uncertain", rom},
    {"", "", &band_from_surface, one, "band_from_surface_deg", "deg", number_column,
     "width of the band if only the surfaces were uncertain", rom},
    {"", "", &band_without_contact, one, "band_share_without_contact", "", number_column,
     "share that reaches the end of the range, 0 to 1", with_bands},
    {"normal_range_deg",
     "how far a healthy hip turns from neutral in this motion by the source, below; null if the source has "
     "no "
     "value, if zero angles are not known to be neutral (`zero`), and for other joints",
     &normal_range_deg, one, "normal_range_deg", "deg", number_column,
     "how far a healthy hip turns by the source; empty if zero is not known to be neutral", rom},
    {"caveats",
     "list of `code`, `text` and `source` each: [what usually ends such a motion](caveats.md#caveats); "
     "empty for joints other than hips",
     &caveats},
    {"", "", &caveat_codes, one, "caveats", "", text_column,
     "codes of what usually ends such a motion, with blanks between", studies},
    {"guarantee", "what is guaranteed of the limit, in words", &guarantee},
    {"depth", "only with `--allow-depth`, below", &depth},
    {"closed_form",
     "only of an implant whose liner and neck are bodies of revolution: where these two end the motion, "
     "`limit_deg` and `reason`, and `of_facets_deg`, between which their meshes do",
     &closed_form},
    {"zone", "only with `--past`, below; null for motions that did not end by contact", &zone},
    {"band",
     "`p5_deg`, `median_deg`, `p95_deg` of the limit over the joints of the band; "
     "`width_from`: what the width, 5 to 95 %, would be if only the centre (`centre_deg`), the "
     "axes (`axes_deg`), the surfaces (`surface_deg`) or parameters of parts (`parameters_deg`, if they have "
     "standard deviations) were uncertain; "
     "`share_without_contact`, `share_in_contact_at_start` of the joints, 0 to 1. Null without "
     "`--band`",
     &band},
};

/// Directions of a point's coordinates in the joint frame.
constexpr std::array<const char*, 3> directions = {"anterior", "superior", "to the subject's right"};

void append(std::vector<std::string>& texts, const Json& json) {
  if (json.is_structured()) {
    for (const Json& item : json) append(texts, item);
  } else if (json.is_string()) {
    texts.push_back(csv_field(json.get_ref<const std::string&>()));
  } else {
    texts.push_back(json.is_null() ? std::string() : fmt::format("{}", json.get<double>()));
  }
}

}  // namespace

std::span<const LimitField> limit_fields() noexcept {
  return every_field;
}

Json left_out() {
  return Json::value_t::discarded;
}

std::vector<ResultColumn> columns_of(const LimitField& field, Anatomy joint) {
  std::vector<ResultColumn> columns;
  switch (field.columns) {
    case LimitColumns::none:
      break;
    case LimitColumns::one:
      columns.push_back({field.column, field.unit, field.kind, field.column_meaning});
      break;
    case LimitColumns::point:
      for (std::size_t axis = 0; axis < 3; ++axis)
        columns.push_back({fmt::format("{}_{}_mm", field.column, "xyz"[axis]), field.unit, field.kind,
                           fmt::format("{}, {}", field.column_meaning, directions[axis])});
      break;
    case LimitColumns::angles:
      for (const JointAngle angle : all_joint_angles)
        columns.push_back({fmt::format("{}_{}_deg", field.column, name_of(angle, joint)), field.unit,
                           field.kind, field.column_meaning});
      break;
  }
  return columns;
}

void append_texts(std::vector<std::string>& texts, const LimitField& field, const LimitOf& of) {
  if (field.columns == LimitColumns::none) return;
  const Json json = field.json(of);
  if (json.is_null())
    texts.resize(texts.size() + (field.columns == LimitColumns::one ? 1 : 3));
  else
    append(texts, json);
}

std::string csv_line(const std::vector<std::string>& fields) {
  return fmt::format("{}\n", fmt::join(fields, ","));
}

}  // namespace condyle::io
