#include "io/study/study_resection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "answer/limit_facts.hpp"
#include "condyle/error.hpp"
#include "io/file/csv_fields.hpp"

namespace condyle::io {
namespace {

using Cells = std::vector<std::string>;

std::string number(double value) {
  return fmt::format("{}", value);
}

/// Largest depth and sums over the bones that were cut.
struct Removed {
  double volume_mm3 = 0, least_volume_mm3 = 0, area_mm2 = 0, deepest_mm = 0;

  explicit Removed(const plan::Resection& resection) {
    for (const auto* cut : {&resection.mobile, &resection.fixed}) {
      if (!*cut) continue;
      volume_mm3 += (*cut)->volume_mm3;
      least_volume_mm3 += (*cut)->least_volume_mm3;
      area_mm2 += (*cut)->area_mm2;
      deepest_mm = std::max(deepest_mm, (*cut)->deepest_mm);
    }
  }
};

std::string codes_of(const std::vector<ResectionNote>& notes) {
  std::string codes;
  for (const ResectionNote& note : notes)
    codes += (codes.empty() ? "" : " ") + std::string(name_of(note.code));
  return codes;
}

Cells fields_of(const ResectionAnswer& answer) {
  const Removed removed(answer.resection);
  Cells fields = {number(removed.volume_mm3), number(removed.least_volume_mm3), number(removed.area_mm2),
                  number(removed.deepest_mm)};
  for (const plan::ReachOutcome& outcome : answer.resection.targets) {
    fields.push_back(number(plan::asked_degrees(outcome.planned)));
    fields.push_back(number(degrees_turned(outcome.after.end.turned, outcome.target.motion)));
    fields.emplace_back(outcome.blocked ? name_of(outcome.blocked->by) : "");
  }
  fields.push_back(codes_of(answer.notes));
  fields.emplace_back();
  return fields;
}

/// Every field is empty but the last one.
Cells no_plan(const StudyResection& resection, std::string_view why) {
  Cells fields(resection_columns(resection).size());
  fields.back() = csv_field(why);
  return fields;
}

}  // namespace

std::vector<ResultColumn> resection_columns(const StudyResection& resection) {
  std::vector<ResultColumn> columns = {
      {"resect_volume_mm3", "mm^3", number_column, "of the bone that goes, of both bodies"},
      {"resect_least_volume_mm3", "mm^3", number_column, "of it, what the other bone sweeps over"},
      {"resect_area_mm2", "mm^2", number_column, "of the surface that is cut"},
      {"resect_deepest_mm", "mm", number_column, "largest depth of the cut"}};
  for (const auto& [motion, reach, is_gain] : resection.targets) {
    const std::string name = std::string(resection_prefix) + motion;
    columns.push_back(
        {name + "_planned_deg", "deg", number_column,
         fmt::format("the target of {} degrees{}, or as far as bone that stays lets the motion go",
                     plan::asked_degrees(reach), is_gain ? " more" : "")});
    columns.push_back(
        {name + "_after_deg", "deg", number_column, "how far the motion goes without the bone"});
    columns.push_back(
        {name + "_blocked_by", "", text_column,
         "why bone that stops it short of its target stays: bearing, depth or zone; empty where none does"});
  }
  columns.push_back({"resect_notes", "", text_column, "codes of the notes on the plan, with blanks between"});
  columns.push_back({"resect_none", "", text_column, "why there is no plan"});
  return columns;
}

std::vector<ResultColumn> resected_limit_columns() {
  return {
      {"resected_limit_deg", "deg", number_column, "how far the motion goes without the bone that must go"},
      {"resected_reason", "", text_column, "why it ends there"}};
}

std::optional<ResectionFields> resection_fields(const LoadedJoint& loaded, const StudyResection& resection,
                                                const RangeRequest& range, std::stop_token stop) {
  const Case joint = loaded;
  ResectionRequest request{
      .resection = resection.cut, .motions = range.motions, .bands = {}, .curve_points = 0};
  request.resection.targets = reach_targets(joint.motions(), resection.targets);
  request.resection.range = range.range;
  ResectionFields fields;
  try {
    const auto answer = answer_resection(joint, request, {.stop = stop});
    if (!answer) return std::nullopt;
    fields.of_hip = fields_of(*answer);
    for (const motion::MotionLimit& limit : answer->after)
      fields.of_limits.push_back(
          {number(degrees_turned(limit.end.turned, limit.motion)), std::string(name_of(limit.end.reason))});
  } catch (const MeshError& error) {
    fields.of_hip = no_plan(resection, error.what());
    fields.of_limits.assign(range.motions.size(), Cells(resected_limit_columns().size()));
  }
  return fields;
}

}  // namespace condyle::io
