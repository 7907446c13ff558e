#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "answer/records/limit_record.hpp"
#include "condyle/io/pose_text.hpp"
#include "core/trigonometry.hpp"
#include "io/file/format_version.hpp"
#include "io/record/json_of.hpp"
#include "io/result/json.hpp"
#include "io/result/map_result.hpp"
#include "io/result/map_summary.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/rom_parts.hpp"
#include "io/result/rom_result.hpp"
#include "io/result/scope_text.hpp"
#include "kinematics/ligament_path.hpp"

namespace condyle::io {
namespace {

using io::Json;

Json json_of(const motion::BandOptions& options, const Joint& joint) {
  Json sigma{{"centre_mm", options.sigma.centre_mm},
             {"axes_deg", options.sigma.axes.degrees()},
             {"surface_mm", options.sigma.surface_mm}};
  if (!options.sigma.surface_from.empty()) sigma["surface_from"] = options.sigma.surface_from;
  // Beside an origin's the grid's part is one of two, and has another name.
  if (options.sigma.is_by_voxels(joint.fixed) || options.sigma.is_by_voxels(joint.mobile))
    sigma[options.sigma.surface_from.empty() ? "surface_voxels" : "grid_voxels"] =
        options.sigma.surface_voxels;
  if (joint.posed)
    for (const PosedPart& part : joint.posed->parts)
      for (const PartParameter& parameter : part.parameters)
        if (parameter.sigma > 0) sigma["parameters"][part.name + "." + parameter.name] = parameter.sigma;
  for (const kinematics::LigamentSigma& of : kinematics::ligament_sigmas(joint))
    sigma["parameters"][of.name] = of.sigma_mm;
  return {{"samples", options.samples}, {"seed", options.seed}, {"sigma", std::move(sigma)}};
}

Json json_of(const ReasonCounts& counts) {
  Json json;
  for (const motion::LimitReason reason : {motion::LimitReason::contact, motion::LimitReason::end_of_range,
                                           motion::LimitReason::contact_at_start})
    json[name_of(reason)] = counts[reason];
  for (const motion::LimitReason reason :
       {motion::LimitReason::ligament, motion::LimitReason::strained_at_start})
    if (counts[reason] > 0) json[name_of(reason)] = counts[reason];
  return json;
}

/// "first_deg" or "first_mm".
std::string in_unit(std::string_view name, motion::MapCoordinate coordinate) {
  return fmt::format("{}_{}", name, coordinate.unit());
}

Json json_of(const motion::GridAxis& axis, Anatomy joint) {
  const motion::MapCoordinate& of = axis.coordinate;
  return {{of.is_angle() ? "angle" : "translation", name_of(of, joint)},
          {"opposite", movement_name(of, RotationSense::negative, joint)},
          {in_unit("first", of), axis.first},
          {in_unit("last", of), axis.last},
          {in_unit("step", of), axis.step},
          {"count", axis.count()}};
}

Json json_of(const MapIntervals& all, motion::MapCoordinate vary) {
  const auto names = [](const std::vector<motion::LimitReason>& reasons) {
    Json list = Json::array();
    for (const motion::LimitReason reason : reasons) list.push_back(name_of(reason));
    return list;
  };
  return {{"offset", all.offset},
          {in_unit("low", vary), all.low},
          {in_unit("high", vary), all.high},
          {"low_reason", names(all.low_reason)},
          {"high_reason", names(all.high_reason)}};
}

/// The coordinates that have one value all over a map.
Json held_json(const motion::MapGrid& grid, Anatomy joint) {
  Json held = Json::object();
  const auto add = [&](motion::MapCoordinate coordinate, double value) {
    if (coordinate != grid.row.coordinate && coordinate != grid.column.coordinate && coordinate != grid.vary)
      held[in_unit(name_of(coordinate, joint), coordinate)] = value;
  };
  for (const JointAngle angle : all_joint_angles) add(angle, angle_of(grid.held.angles, angle).degrees());
  for (int axis = 0; axis < 3; ++axis)
    add(motion::MapCoordinate::translation(axis), grid.held.translation_mm[axis]);
  return held;
}

Json json_of(const motion::MotionMap& map) {
  const MapSummary summary = map_summary_of(map);
  const motion::MapGrid& grid = map.grid;
  const bool turns = grid.vary.is_angle();
  Json json{
      {"vary", name_of(grid.vary, map.anatomy)},
      {"vary_opposite", movement_name(grid.vary, RotationSense::negative, map.anatomy)},
      {in_unit("start", grid.vary),
       turns ? grid.start.degrees() : grid.held.translation_mm[grid.vary.axis()]},
      {in_unit("range", grid.vary), turns ? Json{grid.range.negative.degrees(), grid.range.positive.degrees()}
                                          : Json{grid.slide_range.negative_mm, grid.slide_range.positive_mm}},
      {"columns", json_of(grid.column, map.anatomy)},
      {"rows", json_of(grid.row, map.anatomy)},
      {"points", grid.size()},
      {"negative_ends", json_of(summary.negative_ends)},
      {"positive_ends", json_of(summary.positive_ends)},
      {"free_elsewhere", summary.free_elsewhere},
      {"with_islands", summary.with_islands},
      {"intervals", json_of(all_intervals(map), grid.vary)}};
  if (grid.translates()) {
    json["held"] = held_json(grid, map.anatomy);
    return json;
  }
  json["free_volume_deg3"] = summary.volume.plain_deg3;
  json[map.anatomy == Anatomy::shoulder ? "free_volume_sine_weighted_deg3"
                                        : "free_volume_cosine_weighted_deg3"] = summary.volume.weighted_deg3;
  json["row_free_area_deg2"] = summary.volume.row_area_deg2;
  return json;
}

Json sphere_json(const Vec3& centre, double radius) {
  return {{"centre_mm", io::numbers(centre)}, {"radius_mm", radius}};
}

/// Meaning of contact for each of several meshes, by name.
Json contact_of_meshes(const Body& body) {
  Json json = Json::object();
  for (const BodyPart& part : body.parts) json[part.name] = name_of(part.contact);
  return json;
}

Json bearing_json(const RomResult& result) {
  Json json{{"rule", result.answer.bearing_rule == motion::BearingRule::count ? "count" : "leave_out"}};
  if (const Joint& joint = result.joint; !joint.fixed.parts.empty() || !joint.mobile.parts.empty())
    json["meshes"] = {{"fixed", contact_of_meshes(joint.fixed)}, {"mobile", contact_of_meshes(joint.mobile)}};
  const auto& surface = result.answer.bearing.surface;
  if (!surface) {
    json["why_none"] = result.answer.bearing.why_none;
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
  json["rim_gap_mm"] = io::nullable(surface->rim_gap_mm);
  if (surface->beside_gap_mm) json["beside_gap_mm"] = *surface->beside_gap_mm;
  json["triangles"] = surface->count();
  return json;
}

Json arcs_json(const RomResult& result) {
  Json list = Json::array();
  for (const OppositeLimits& pair : opposite_limits(result.answer.limits))
    list.push_back(
        {{"motions", {pair.one->motion.name, pair.other->motion.name}}, {"arc_deg", pair.arc().degrees()}});
  return list;
}

/// Closed forms of the joint's implant.
Json implant_json(const Joint& joint) {
  const plan::ClosedForm form = plan::closed_form(joint);
  Json json{{"fixed_part", joint.implant->fixed_mesh}, {"mobile_part", joint.implant->mobile_mesh}};
  json["half_angle_deg"] = form.pair ? Json(form.pair->half_angle.degrees()) : Json(nullptr);
  json["between_axes_deg"] =
      form.pair
          ? Json(core::arccosine(std::clamp(form.pair->fixed_axis.dot(form.pair->mobile_axis), -1.0, 1.0)) *
                 (180 / std::numbers::pi))
          : Json(nullptr);
  if (!form.pair) json["why_no_closed_form"] = form.why_none;
  return json;
}

}  // namespace

Json motion_json(const RomResult& result, std::size_t i) {
  return json_of(limit_record(result.answer, i), {frame_of(result), result.joint.anatomy});
}

Json rom_object(const RomResult& result) {
  Json json{
      {"condyle", io::format_version},
      {"joint", result.joint.name},
      {"fixed", result.joint.fixed.name},
      {"mobile", result.joint.mobile.name},
      {"anatomy", io::anatomy_json(result.joint)},
      {"side", name_of(result.joint.side)},
      {"bearing", bearing_json(result)},
      {"clock_plane", !result.joint.is_hip()                                 ? Json(nullptr)
                      : result.answer.clock_plane == motion::ClockPlane::rim ? Json("rim")
                                                                             : Json("sagittal")},
      {"zero", zero_json(result.joint)},
      {"normal_range_source", result.joint.is_hip() && result.joint.person.is_human()
                                  ? Json(normal_hip_range_source)
                                  : Json(nullptr)},
      {"held_translation_mm",
       result.answer.held_translation_mm ? io::numbers(*result.answer.held_translation_mm) : Json(nullptr)},
      {"exact", !result.answer.follows && result.answer.depths.empty()},
      {"caveats", result.answer.caveats},
      {"notes", io::notes_json(result.notes, result.answer.contact_notes, result.answer.notes)},
      {"band",
       result.answer.bands.empty() ? Json(nullptr) : json_of(result.answer.band_options, result.joint)}};
  if (result.joint.implant) json["implant"] = implant_json(result.joint);
  json["motions"] = Json::array();
  for (std::size_t i = 0; i < result.answer.limits.size(); ++i)
    json["motions"].push_back(motion_json(result, i));
  json["arcs"] = arcs_json(result);
  if (result.answer.map) json["map"] = json_of(*result.answer.map);
  if (result.box) json["written_limits"] = json_of(*result.box, {frame_of(result), result.joint.anatomy});
  json["scope"] = scope_text(result.joint);
  json["provenance"] = io::provenance_json(result.provenance);
  return json;
}

std::string rom_json(const RomResult& result) {
  return io::document(io::rom_object(result));
}

}  // namespace condyle::io
