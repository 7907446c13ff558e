#include "condyle/io/rom_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/io/map_result.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/file/format_version.hpp"
#include "io/joint/given_degrees.hpp"
#include "io/result/clock_contacts.hpp"
#include "io/result/csv_field.hpp"
#include "io/result/json.hpp"
#include "io/result/map_summary.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/quoted_limit.hpp"

namespace condyle {
namespace {

using io::Json;

constexpr std::array all_angles{JointAngle::flexion, JointAngle::adduction, JointAngle::internal_rotation};

Json angles_json(const JointAngles& angles) {
  Json json;
  for (const JointAngle angle : all_angles) json[name_of(angle)] = angle_of(angles, angle).degrees();
  return json;
}

Json start_json(const JointAngles& angles) {
  Json json;
  for (const JointAngle angle : all_angles) json[name_of(angle)] = io::given_degrees(angle_of(angles, angle));
  return json;
}

Json held_json(const Motion& motion) {
  Json json;
  for (const JointAngle angle : all_angles)
    if (angle != motion.vary) json[name_of(angle)] = io::given_degrees(angle_of(motion.start, angle));
  return json;
}

std::string_view name_of_kind(FeatureKind kind) noexcept {
  switch (kind) {
    case FeatureKind::vertex:
      return "vertex";
    case FeatureKind::edge:
      return "edge";
    case FeatureKind::face:
      return "face";
  }
  return "vertex";
}

/// "vertex 12", "edge 3-7", "face 40".
std::string text_of(const Feature& feature) {
  return feature.kind == FeatureKind::edge ? fmt::format("edge {}-{}", feature.id, feature.other_end)
                                           : fmt::format("{} {}", name_of_kind(feature.kind), feature.id);
}

Json json_of(const Feature& feature) {
  Json json{{"kind", name_of_kind(feature.kind)}};
  if (feature.kind == FeatureKind::edge)
    json["vertices"] = {feature.id, feature.other_end};
  else
    json["id"] = feature.id;
  return json;
}

Json json_of(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

bool ends_in_contact(const MotionLimit& limit) noexcept {
  return limit.end.reason != LimitReason::end_of_range;
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
          {"centroid_mm", centroid ? json_of(*centroid) : Json(nullptr)},
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
  const AnswerFrame frame = frame_of(result);
  Json json{{"name", limit.motion.name},
            {"limit_deg", limit.end.turned.degrees()},
            {"reason", name_of(limit.end.reason)},
            {"contact_kind", ends_in_contact(limit) ? Json(name_of(limit.end.kind())) : Json(nullptr)},
            {"bearing_contact_deg", bearing ? Json(bearing->turned.degrees()) : Json(nullptr)},
            {"bearing_contact_point_mm", bearing && bearing->contact
                                             ? json_of(frame.fixed_point(bearing->contact->fixed_point))
                                             : Json(nullptr)},
            {"centre_distance_mm", limit.head ? nullable(limit.head->centre_distance_mm) : Json(nullptr)},
            {"joint_space_mm", limit.head ? nullable(limit.head->joint_space_mm) : Json(nullptr)},
            {"contact_point_mm", contact ? json_of(frame.fixed_point(contact->fixed_point)) : Json(nullptr)},
            {"contact_point_mobile_mm",
             contact ? json_of(frame.mobile_point(contact->mobile_point)) : Json(nullptr)},
            {"clock_hour", nullable(io::clock_hour(result, limit))},
            {"features", contact ? Json{{"fixed", json_of(contact->fixed_feature)},
                                        {"mobile", json_of(contact->mobile_feature)}}
                                 : Json(nullptr)},
            {"error_bound_deg", limit.end.error_bound.degrees()},
            {"vary", name_of(limit.motion.vary)},
            {"sense", limit.motion.sense == RotationSense::positive ? "positive" : "negative"},
            {"range_deg", io::given_degrees(limit.motion.range)},
            {"start_deg", start_json(limit.motion.start)},
            {"held_deg", held_json(limit.motion)},
            {"at_limit_deg", angles_json(limit.angles_at_limit())},
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

Json json_of(const GridAxis& axis) {
  return {{"angle", name_of(axis.angle)},
          {"first_deg", axis.first_deg},
          {"last_deg", axis.last_deg},
          {"step_deg", axis.step_deg},
          {"count", axis.count()}};
}

/// Of the points whose free angles are not the one interval about the start: all of them.
Json other_intervals_json(const MotionMap& map) {
  const std::size_t columns = map.grid.column.count();
  Json points = Json::array();
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const auto& intervals = map.points[i].intervals;
    if (intervals.empty() || (intervals.size() == 1 && intervals.front().holds_start())) continue;
    Json of_point = Json::array();
    for (const FreeInterval& free : intervals)
      of_point.push_back({{"low_deg", (map.grid.start + free.low).degrees()},
                          {"high_deg", (map.grid.start + free.high).degrees()},
                          {"low_reason", name_of(free.at_low.reason)},
                          {"high_reason", name_of(free.at_high.reason)}});
    points.push_back({{"column_deg", map.grid.column.value_deg(i % columns)},
                      {"row_deg", map.grid.row.value_deg(i / columns)},
                      {"intervals", std::move(of_point)}});
  }
  return points;
}

Json json_of(const MotionMap& map) {
  const MapSummary summary = summarise(map);
  return {{"vary", name_of(map.grid.vary)},
          {"start_deg", map.grid.start.degrees()},
          {"range_deg", {map.grid.range.negative.degrees(), map.grid.range.positive.degrees()}},
          {"columns", json_of(map.grid.column)},
          {"rows", json_of(map.grid.row)},
          {"points", map.points.size()},
          {"negative_ends", json_of(summary.negative_ends)},
          {"positive_ends", json_of(summary.positive_ends)},
          {"free_elsewhere", summary.free_elsewhere},
          {"with_islands", summary.with_islands},
          {"other_intervals", other_intervals_json(map)},
          {"free_volume_deg3", summary.volume.plain_deg3},
          {"free_volume_cosine_weighted_deg3", summary.volume.cosine_weighted_deg3},
          {"row_free_area_deg2", summary.volume.row_area_deg2}};
}

Json sphere_json(const Vec3& centre, double radius) {
  return {{"centre_mm", json_of(centre)}, {"radius_mm", radius}};
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
  json["margin_mm"] = surface->margin_mm;
  json["rim_gap_mm"] = nullable(surface->rim_gap_mm);
  json["triangles"] = surface->count();
  return json;
}

/// One line or two: what does not count and by which numbers.
std::string bearing_text(const RomResult& result) {
  const auto& surface = result.bearing.surface;
  if (!surface) return fmt::format("  every contact counts: {}\n", result.bearing.why_none);
  const std::string rim =
      surface->rim_gap_mm ? fmt::format(", rim {:.2f} mm from it", *surface->rim_gap_mm) : std::string();
  return fmt::format(
      "  bearing surface: {} of {} triangles of {}, within {:.2f} mm of the head's sphere\n"
      "    (radius {:.2f} mm{}); contact on it {}\n",
      surface->count(), surface->triangles.size(), result.joint.mobile.name, surface->margin_mm,
      surface->head.radius, rim,
      result.bearing_rule == BearingRule::count ? "counts" : "does not end a motion");
}

std::string_view words_of(const MotionLimit& limit) noexcept {
  switch (limit.end.reason) {
    case LimitReason::contact:
      switch (limit.end.kind()) {
        case ContactKind::bearing:
          return "bearing contact";
        case ContactKind::impingement:
          return "impingement";
        case ContactKind::unknown:
          return "contact";
      }
      return "";
    case LimitReason::end_of_range:
      return "no contact in range";
    case LimitReason::contact_at_start:
      return "in contact at start";
  }
  return "";
}

/// Characters of well-formed UTF-8: what a terminal shows, for the usual scripts.
std::size_t shown_width(std::string_view text) noexcept {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; }));
}

enum class Align { left, right };

struct Column {
  Align align;
  std::vector<std::string> cells;  ///< its heading first
};

std::string table_text(std::span<const Column> columns) {
  std::string text;
  for (std::size_t row = 0; row < columns.front().cells.size(); ++row) {
    std::string line = " ";
    for (const Column& column : columns) {
      std::size_t widest = 0;
      for (const std::string& cell : column.cells) widest = std::max(widest, shown_width(cell));
      const std::string& cell = column.cells[row];
      const std::string blanks(widest - shown_width(cell), ' ');
      line += fmt::format(" {} ", column.align == Align::left ? cell + blanks : blanks + cell);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

/// The bands and where they come from; without bands a line that says how to get them.
std::string band_text(const RomResult& result) {
  if (result.bands.empty())
    return result.depths.empty()
               ? "  band unknown: --band tells how far these limits move with what is uncertain\n"
               : "";
  const BandOptions& options = result.band_options;
  std::string text = fmt::format(
      "  band: 5 to 95 % of {} joints with the centre moved by {:g} mm, the axes by {:g} deg and the "
      "surfaces by {:g} mm\n"
      "    (standard deviations, seed {}); its width where only one of them is moved:\n",
      options.samples, options.sigma.centre_mm, options.sigma.axes.degrees(), options.sigma.surface_mm,
      options.seed);
  Column name{Align::left, {"motion"}}, median{Align::right, {"median"}}, low{Align::right, {"5 %"}},
      high{Align::right, {"95 %"}}, centre{Align::right, {"centre"}}, axes{Align::right, {"axes"}},
      surface{Align::right, {"surface"}}, free{Align::right, {"no contact"}};
  for (std::size_t i = 0; i < result.bands.size(); ++i) {
    const LimitBand& band = result.bands[i];
    name.cells.push_back(result.limits[i].motion.name);
    const auto add = [](Column& column, Angle angle) {
      column.cells.push_back(fmt::format("{:.1f}", angle.degrees()));
    };
    add(median, band.median), add(low, band.p5), add(high, band.p95);
    add(centre, band.width_from.centre), add(axes, band.width_from.axes),
        add(surface, band.width_from.surface);
    free.cells.push_back(fmt::format("{:.0f} %", 100 * band.share_without_contact));
  }
  return text + table_text(std::array{name, median, low, high, centre, axes, surface, free});
}

}  // namespace

std::string_view name_of(LimitReason reason) noexcept {
  switch (reason) {
    case LimitReason::contact:
      return "contact";
    case LimitReason::end_of_range:
      return "end_of_range";
    case LimitReason::contact_at_start:
      return "contact_at_start";
  }
  return "contact";
}

std::string_view name_of(ContactKind kind) noexcept {
  switch (kind) {
    case ContactKind::unknown:
      return "unknown";
    case ContactKind::bearing:
      return "bearing";
    case ContactKind::impingement:
      return "impingement";
  }
  return "unknown";
}

std::string guarantee_text(const MotionLimit& limit) {
  switch (limit.end.reason) {
    case LimitReason::contact:
      return fmt::format("free before the limit; in contact at it or past it by at most {:.2g} deg",
                         limit.end.error_bound.degrees());
    case LimitReason::end_of_range:
      return fmt::format("free over the whole range of {:g} deg", limit.motion.range.degrees());
    case LimitReason::contact_at_start:
      return "in contact before any rotation";
  }
  return "";
}

std::string guarantee_text(const DepthLimit& depth) {
  switch (depth.limit.end.reason) {
    case LimitReason::contact:
      return fmt::format(
          "searched, not exact: no deeper than allowed at the poses tried before the limit, deeper within "
          "{:.2g} deg past it{}",
          depth.limit.end.error_bound.degrees(),
          depth.depth_grows ? "" : "; depth does not grow evenly here, a little further on may be as good");
    case LimitReason::end_of_range:
      return fmt::format(
          "searched, not exact: no deeper than allowed at the poses tried over the range of {:g} deg",
          depth.limit.motion.range.degrees());
    case LimitReason::contact_at_start:
      return "deeper than allowed before any rotation";
  }
  return "";
}

AnswerFrame frame_of(const RomResult& result) {
  return result.provenance ? result.provenance->frame : AnswerFrame{};
}

std::string rom_json(const RomResult& result) {
  Json json{{"condyle", io::format_version},
            {"joint", result.joint.name},
            {"fixed", result.joint.fixed.name},
            {"mobile", result.joint.mobile.name},
            {"side", name_of(result.joint.side)},
            {"bearing", bearing_json(result)},
            {"clock_plane", result.clock_plane == ClockPlane::rim ? "rim" : "sagittal"},
            {"terms", result.terms},
            {"notes", io::notes_json(result.notes)},
            {"band", result.bands.empty() ? Json(nullptr) : json_of(result.band_options)}};
  json["motions"] = Json::array();
  for (std::size_t i = 0; i < result.limits.size(); ++i) json["motions"].push_back(motion_json(result, i));
  if (result.map) json["map"] = json_of(*result.map);
  json["scope"] = io::scope_note;
  json["provenance"] = io::provenance_json(result.provenance);
  return io::document(json);
}

std::string rom_text(const RomResult& result) {
  const auto point_text = [](const Vec3& p) {
    return fmt::format("({:.2f}, {:.2f}, {:.2f})", p.x(), p.y(), p.z());
  };
  const auto limit_text = [&](std::size_t i) {
    const Angle turned = result.limits[i].end.turned;
    return result.bands.empty() ? fmt::format("{:.2f}", turned.degrees())
                                : io::quoted_limit(turned, result.bands[i]);
  };
  Column name{Align::left, {"motion"}}, turned{Align::right, {"limit (deg)"}},
      reason{Align::left, {"ended by"}}, point{Align::left, {"contact point (mm)"}},
      clock{Align::right, {result.clock_plane == ClockPlane::rim ? "rim clock" : "sagittal clock"}},
      bearing{Align::right, {"bearing (deg)"}}, centres{Align::right, {"centres (mm)"}},
      space{Align::right, {"space (mm)"}};
  for (std::size_t i = 0; i < result.limits.size(); ++i) {
    const MotionLimit& limit = result.limits[i];
    name.cells.push_back(limit.motion.name);
    turned.cells.push_back(limit_text(i));
    reason.cells.emplace_back(words_of(limit));
    point.cells.push_back(
        limit.end.contact ? point_text(frame_of(result).fixed_point(limit.end.contact->fixed_point)) : "-");
    const auto& sliding = limit.end.bearing_contact;
    bearing.cells.push_back(sliding ? fmt::format("{:.2f}", sliding->turned.degrees()) : "-");
    const bool distance = limit.head && limit.head->centre_distance_mm;
    centres.cells.push_back(distance ? fmt::format("{:.2f}", *limit.head->centre_distance_mm) : "-");
    const bool spaced = limit.head && limit.head->joint_space_mm;
    space.cells.push_back(spaced ? fmt::format("{:.2f}", *limit.head->joint_space_mm) : "-");
    const auto hour = io::clock_hour(result, limit);
    clock.cells.push_back(hour ? io::clock_text(*hour) : "-");
  }
  const Joint& joint = result.joint;
  std::string text = fmt::format("{}: {} in {}, {} side\n", joint.name, joint.mobile.name, joint.fixed.name,
                                 name_of(joint.side));
  text += bearing_text(result);
  for (const std::string& term : result.terms) text += fmt::format("  {}\n", term);
  text += result.bearing.surface
              ? table_text(std::array{name, turned, reason, clock, point, bearing, centres, space})
          : joint.kind == JointKind::ball ? table_text(std::array{name, turned, reason, clock, point})
                                          : table_text(std::array{name, turned, reason, point});
  text += band_text(result);
  if (std::any_of(result.limits.begin(), result.limits.end(), [](const MotionLimit& limit) {
        return limit.motion.name == "fadir" || limit.motion.name == "faber";
      }))
    text += "  fadir and faber: as defined here (--list-motions); no angles are agreed on\n";
  if (result.map) text += map_text(*result.map);
  return text + fmt::format("  {}\n", io::scope_note);
}

std::string rom_csv(const RomResult& result) {
  const AnswerFrame frame = frame_of(result);
  std::string text =
      io::provenance_comments(result.provenance) +
      "motion,limit_deg,reason,contact_kind,bearing_contact_deg,centre_distance_mm,joint_space_mm,"
      "error_bound_deg,vary,sense,range_deg,"
      "start_flexion_deg,start_adduction_deg,start_internal_rotation_deg,"
      "limit_flexion_deg,limit_adduction_deg,limit_internal_rotation_deg,"
      "contact_x_mm,contact_y_mm,contact_z_mm,"
      "contact_mobile_x_mm,contact_mobile_y_mm,contact_mobile_z_mm,fixed_feature,mobile_feature,clock_hour,"
      "band_p5_deg,band_median_deg,band_p95_deg,band_from_centre_deg,band_from_axes_deg,band_from_surface_"
      "deg,"
      "band_share_without_contact\n";
  const auto point = [](const Vec3& p) { return fmt::format("{},{},{}", p.x(), p.y(), p.z()); };
  const auto start = [](const JointAngles& a) {
    return fmt::format("{},{},{}", io::given_degrees(a.flexion), io::given_degrees(a.adduction),
                       io::given_degrees(a.internal_rotation));
  };
  const auto angles = [](const JointAngles& a) {
    return fmt::format("{},{},{}", a.flexion.degrees(), a.adduction.degrees(), a.internal_rotation.degrees());
  };
  for (std::size_t i = 0; i < result.limits.size(); ++i) {
    const MotionLimit& limit = result.limits[i];
    const auto& [motion, end, head] = limit;
    const auto field = [](const std::optional<double>& value) {
      return value ? fmt::format("{}", *value) : "";
    };
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},", io::csv_field(motion.name), end.turned.degrees(),
        name_of(end.reason), ends_in_contact(limit) ? name_of(end.kind()) : "",
        end.bearing_contact ? fmt::format("{}", end.bearing_contact->turned.degrees()) : "",
        head ? field(head->centre_distance_mm) : "", head ? field(head->joint_space_mm) : "",
        end.error_bound.degrees(), name_of(motion.vary),
        motion.sense == RotationSense::positive ? "positive" : "negative", io::given_degrees(motion.range),
        start(motion.start), angles(limit.angles_at_limit()));
    const auto hour = io::clock_hour(result, limit);
    const auto& contact = end.contact;
    text += contact ? fmt::format("{},{},{},{}", point(frame.fixed_point(contact->fixed_point)),
                                  point(frame.mobile_point(contact->mobile_point)),
                                  text_of(contact->fixed_feature), text_of(contact->mobile_feature))
                    : std::string(",,,,,,,");
    text += hour ? fmt::format(",{}", *hour) : ",";
    if (result.bands.empty()) {
      text += ",,,,,,,\n";
      continue;
    }
    const LimitBand& band = result.bands[i];
    for (const Angle angle : {band.p5, band.median, band.p95, band.width_from.centre, band.width_from.axes,
                              band.width_from.surface})
      text += fmt::format(",{}", angle.degrees());
    text += fmt::format(",{}\n", band.share_without_contact);
  }
  return text;
}

}  // namespace condyle
