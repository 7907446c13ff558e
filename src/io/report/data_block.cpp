#include "io/report/data_block.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/report/before_json.hpp"
#include "io/report/block_arrays.hpp"
#include "io/report/joint_object.hpp"
#include "io/report/recorded_frames.hpp"
#include "io/report/shown_end.hpp"
#include "io/report/surfaces_json.hpp"
#include "io/report/sweep_block.hpp"
#include "io/result/json.hpp"
#include "io/result/json_objects.hpp"
#include "io/result/map_result.hpp"

namespace condyle::io {
namespace {

/// So many to a millimetre, in gaps of 16 bits: 0.01 mm is below what a colour shows, and 327 mm above any gap
/// that matters.
constexpr double gap_units_per_mm = 100;
constexpr std::int16_t no_gap = std::numeric_limits<std::int16_t>::max();

Json axis_json(const motion::GridAxis& axis, Anatomy joint) {
  Json values = Json::array();
  for (std::size_t i = 0; i < axis.count(); ++i) values.push_back(axis.value(i));
  const bool turns = axis.coordinate.is_angle();
  return {{turns ? "angle" : "translation", name_of(axis.coordinate, joint)},
          {"opposite", movement_name(axis.coordinate, RotationSense::negative, joint)},
          {turns ? "values_deg" : "values_mm", std::move(values)}};
}

Json map_json(const motion::MotionMap& map) {
  const motion::MapGrid& grid = map.grid;
  Json points = Json::array();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    Json intervals = Json::array();
    for (const motion::MapInterval& free : map.point(i).intervals)
      intervals.push_back({free.low.value, free.high.value, shown_end(free.low), shown_end(free.high)});
    points.push_back(std::move(intervals));
  }
  Json json{{"columns", axis_json(grid.column, map.anatomy)},
            {"rows", axis_json(grid.row, map.anatomy)},
            {"vary", name_of(grid.vary, map.anatomy)},
            {"vary_opposite", movement_name(grid.vary, RotationSense::negative, map.anatomy)},
            {"intervals", std::move(points)}};
  const Vec3& held = grid.held.translation_mm;
  if (grid.vary.is_angle()) {
    json["start_deg"] = grid.start.degrees();
    json["range_deg"] = {grid.range.negative.degrees(), grid.range.positive.degrees()};
  } else {
    json["start_mm"] = held[grid.vary.axis()];
    json["range_mm"] = {grid.slide_range.negative_mm, grid.slide_range.positive_mm};
  }
  if (!grid.translates()) return json;
  for (const JointAngle angle : all_joint_angles)
    json["held_deg"].push_back(angle_of(grid.held.angles, angle).degrees());
  json["held_mm"] = numbers(held);
  return json;
}

std::vector<std::int16_t> rounded_gaps(const std::vector<double>& gaps_mm) {
  constexpr double least = std::numeric_limits<std::int16_t>::min(), most = no_gap - 1;
  std::vector<std::int16_t> rounded;
  rounded.reserve(gaps_mm.size());
  for (const double gap : gaps_mm)
    rounded.push_back(std::isfinite(gap) ? static_cast<std::int16_t>(
                                               std::clamp(std::round(gap_units_per_mm * gap), least, most))
                                         : no_gap);
  return rounded;
}

/// Poses that the page shows where it cannot compute.
class StoredPoses {
 public:
  StoredPoses(const Joint& joint, BlockArrays& arrays) : joint_(joint), contact_(joint), arrays_(arrays) {}

  /// Nothing where there are no gaps: a mesh is open, or the centre lies on a surface.
  void add(const std::string& name, const JointCoordinates& at, const std::optional<Vec3>& contact_point_F) {
    const Pose X_FM = pose_at(joint_.coordinates(), at, joint_.translation_frame);
    const contact::RadialContact contact = gaps_at(X_FM);
    if (!contact.fixed_in_mobile || !contact.mobile_in_fixed) return;
    Json coordinates = Json::array();
    for (const JointAngle angle : all_joint_angles)
      coordinates.push_back(angle_of(at.angles, angle).degrees());
    const std::string number = "pose_" + std::to_string(poses_.size());
    const auto add_gaps = [&](const char* role, const radial::RadialResults& results) {
      return arrays_.add(number + role, rounded_gaps(results.radial_gap_mm));
    };
    poses_.push_back({{"name", name},
                      {"coordinates_deg", std::move(coordinates)},
                      {"pose", io::rows_of(X_FM)},
                      {"in_contact", contact.in_contact},
                      {"contact_point_mm", contact_point_F ? numbers(*contact_point_F) : Json(nullptr)},
                      {"fixed_gaps", add_gaps("_fixed_gaps", *contact.fixed_in_mobile)},
                      {"mobile_gaps", add_gaps("_mobile_gaps", *contact.mobile_in_fixed)}});
  }

  Json json() && { return std::move(poses_); }

 private:
  contact::RadialContact gaps_at(const Pose& X_FM) const {
    try {
      return contact_.radial(X_FM);
    } catch (const MeshError&) {
      return {};
    }
  }

  const Joint& joint_;
  contact::JointContact contact_;
  BlockArrays& arrays_;
  Json poses_ = Json::array();
};

Json poses_json(const Report& report, BlockArrays& arrays) {
  StoredPoses poses(report.joint, arrays);
  poses.add("reference", report.reference_pose, std::nullopt);
  if (!report.rom) return std::move(poses).json();
  const AnswerFrame frame = frame_of(*report.rom);
  for (const motion::MotionLimit& limit : report.rom->answer.limits) {
    std::optional<Vec3> point;
    if (limit.end.contact) point = frame.fixed_point(limit.end.contact->fixed_point);
    const Vec3 held = report.rom->answer.held_translation_mm.value_or(Vec3::Zero());
    poses.add(limit.motion.name, {limit.angles_at_limit(), limit.translation_mm.value_or(held)}, point);
  }
  return std::move(poses).json();
}

/// Unit of a curve's numbers, by the end of its name.
std::string_view unit_of(std::string_view name) {
  static constexpr std::pair<std::string_view, std::string_view> units[] = {
      {"_mm2", "mm²"}, {"_nmm", "N mm"}, {"_mpa", "MPa"},  {"_mm", "mm"},
      {"_deg", "°"},   {"_n", "N"},      {"_percent", "%"}};
  for (const auto& [ending, unit] : units)
    if (name.ends_with(ending)) return unit;
  return "";
}

Json recorded_json(const ReportedMotion& recorded, const Joint& joint, BlockArrays& arrays) {
  const RecordedFrames frames = recorded_frames(joint, recorded.question.motion.X_FM);
  Curves curves = curves_of(recorded.question, recorded.answer);
  const Curves regions = region_curves_of(recorded.question, recorded.answer);
  for (std::size_t i = 0; i < regions.names.size(); ++i)
    if (regions.names[i].ends_with("_share_percent")) {
      curves.names.push_back(regions.names[i]);
      curves.values.push_back(regions.values[i]);
    }
  Json json{{"name", recorded.name},
            {"axis", curves.axis},
            {"times_s", arrays.add("recorded_times", curves.at)},
            {"coordinates_deg", arrays.add("recorded_degrees", frames.coordinates_deg)},
            {"coordinates_mm", arrays.add("recorded_millimetres", frames.coordinates_mm)},
            {"poses", arrays.add("recorded_poses", frames.poses)}};
  json["curves"] = Json::array();
  for (std::size_t i = 0; i < curves.names.size(); ++i)
    json["curves"].push_back({{"name", curves.names[i]},
                              {"unit", unit_of(curves.names[i])},
                              {"values", arrays.add("curve_" + std::to_string(i), curves.values[i])}});
  return json;
}

/// As measures.json has it, but for what the page has of the joint.
Json measures_of(const MeasureResult* measures) {
  if (!measures) return nullptr;
  Json json = measure_object(*measures);
  for (const char* key : {"condyle", "joint", "fixed", "mobile", "side", "notes", "scope", "provenance"})
    json.erase(key);
  return json;
}

}  // namespace

std::string data_block(const Report& report) {
  const Joint& joint = report.joint;
  BlockArrays arrays;
  Json json = joint_object(report, arrays);
  if (report.rom) {
    if (report.rom->answer.map) json["map"] = map_json(*report.rom->answer.map);
    json["zones"] = zones_json(*report.rom, arrays);
  }
  if (report.layers) json["layers"] = layers_json(*report.layers, joint, arrays);
  json["poses"] = poses_json(report, arrays);
  if (report.recorded) json["recorded"] = recorded_json(*report.recorded, joint, arrays);
  json["measures"] = measures_of(report.measures);
  if (report.plan) json["plan"] = plan_json(*report.plan, arrays);
  if (report.before) json["before"] = before_json(report, arrays);
  if (report.sweep) json["sweep"] = sweep_block(*report.sweep, arrays);
  return block_of(std::move(json), arrays);
}

}  // namespace condyle::io
