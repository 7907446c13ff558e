#include "io/study/study_answer.hpp"

#include <fmt/format.h>

#include <span>
#include <utility>

#include "answer/records/limit_record.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/failure.hpp"
#include "io/file/in_quotes.hpp"
#include "io/joint/name_joint_file.hpp"
#include "io/record/table_of.hpp"
#include "io/result/depth_parts.hpp"
#include "io/result/map_summary.hpp"
#include "io/result/rom_result.hpp"
#include "io/study/study_columns.hpp"
#include "io/study/study_follow.hpp"
#include "io/study/study_inputs.hpp"
#include "io/study/study_joint.hpp"
#include "io/study/study_load.hpp"
#include "io/study/study_measures.hpp"
#include "io/study/study_resection.hpp"

namespace condyle::io {
namespace {

using Cells = std::vector<std::string>;

template <class Value>
std::string text_of(const std::optional<Value>& value) {
  return value ? fmt::format("{}", *value) : std::string();
}

/// First fields of each line of this row.
Cells row_fields(const StudyTable& table, const StudyRow& row) {
  Cells fields = {csv_field(table.id(row)), fmt::format("{}", row.number)};
  for (std::string& field : table.carried_fields(row)) fields.push_back(std::move(field));
  return fields;
}

std::string line_of(Cells fields, const Cells& more) {
  fields.insert(fields.end(), more.begin(), more.end());
  return csv_line(fields);
}

void check_kind(const StudyTable& table, const StudyRow& row, const LoadedJoint& loaded,
                const StudyOptions& options) {
  const Joint& joint = loaded.joint;
  const std::string file = loaded.report.file.path.string();
  if (joint.anatomy != options.anatomy)
    throw FileError(fmt::format("{}: is of a {}, and this study of the {}", file, name_of(joint.anatomy),
                                name_of(options.anatomy)));
  if (joint.kind != JointKind::free) return;
  if (!follows(table, row, options))
    throw FileError(
        fmt::format("{}: is a free joint, and a study takes one with a translation to follow: a recorded "
                    "motion in a column follow, or a load",
                    file));
  if (options.depth_at || options.load)
    throw FileError(fmt::format(
        "{}: is a free joint, and poses of a study have no translation: neither depth nor load is answered",
        file));
  // A plan holds the translation, and would stand beside limits that do not.
  if (options.resection)
    throw FileError(fmt::format(
        "{}: is a free joint, and a study plans none, whose limits follow a translation: condyle resect does",
        file));
}

RangeRequest range_request_of(const Case& joint, const StudyOptions& options) {
  RangeRequest request{.motions = joint.motions(options.motions)};
  request.range.bearing = options.bearing;
  request.range.overlap.reference_contact = options.reference_contact;
  request.range.overlap.leave_out_reference_contacts = options.leave_out_reference_contacts;
  request.map = options.map;
  request.bands = options.bands;
  return request;
}

/// `more`: the fields behind those of each limit, none or as many as limits.
std::string limit_lines(const Cells& row, const RangeAnswer& answer, const LimitColumns& columns,
                        const std::vector<Cells>& more) {
  const RecordContext context{frame_of(rom_result_of(answer, {}, nullptr)), answer.joint.anatomy};
  std::string lines;
  for (std::size_t i = 0; i < answer.limits.size(); ++i) {
    Cells fields = row;
    append_cells(fields, limit_record(answer, i), context, columns);
    lines += more.empty() ? csv_line(fields) : line_of(std::move(fields), more[i]);
  }
  return lines;
}

void add_map(Cells& fields, const motion::MotionMap& map) {
  const MapSummary summary = map_summary_of(map);
  const auto add = [&](auto value) { fields.push_back(fmt::format("{}", value)); };
  add(map.grid.size());
  add(summary.volume.plain_deg3);
  add(summary.volume.weighted_deg3);
  for (const ReasonCounts* ends : {&summary.negative_ends, &summary.positive_ends})
    for (const motion::LimitReason reason :
         {motion::LimitReason::contact, motion::LimitReason::end_of_range,
          motion::LimitReason::contact_at_start, motion::LimitReason::ligament,
          motion::LimitReason::strained_at_start})
      add((*ends)[reason]);
  add(summary.free_elsewhere);
  add(summary.with_islands);
}

/// Empty if nothing is a depth.
std::string name_of_kind(contact::DepthKind kind, Anatomy joint) {
  if (const auto angle = angle_of(kind)) return std::string(name_of(*angle, joint));
  return kind == contact::DepthKind::radial ? "radial" : "";
}

/// The pose as `condyle depth` reads it for this joint, which refuses one that a hinge does not turn to.
PoseDegrees pose_of(const StudyTable& table, const StudyRow& row, const Joint& joint,
                    const PoseDegrees& asked) {
  try {
    return parse_pose(to_text(asked, joint.anatomy), joint.kind, joint.anatomy);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}: line {}: joint {}: {}", table.path.string(), row.line,
                                 in_quotes(table.id(row)), error.what()));
  }
}

void add_depth(Cells& fields, const Joint& joint, const PoseDegrees& at) {
  const auto limits = limits_of_poses(joint);
  const DepthAnswer answer = answer_depth(
      joint,
      {.X_FM = pose_at(joint.coordinates(), at.angles()), .pose = at.angles(), .limits = limits.get()});
  const contact::ContactMeasures& measures = answer.measures;
  const auto deepest = deepest_of(std::get<RayDepths>(answer.depths).reliable);
  fields.push_back(answer.in_contact() ? "1" : "0");
  fields.push_back(deepest ? fmt::format("{}", deepest->vertex.depth_mm) : "");
  fields.push_back(deepest ? name_of_kind(deepest->vertex.kind, joint.anatomy) : "");
  fields.push_back(text_of(measures.volume_mm3));
  fields.push_back(measures.volume_mm3 ? fmt::format("{}", measures.volume_error_mm3) : "");
  fields.push_back(measures.volume_mm3 ? fmt::format("{}", measures.mobile_covered_again_mm3 +
                                                               measures.fixed_covered_again_mm3)
                                       : "");
  fields.push_back(fmt::format("{}", measures.nearest.distance_mm));
  const auto& standing = answer.standing;
  fields.push_back(standing ? std::string(name_of(standing->state)) : "");
  fields.push_back(standing && standing->nearest ? fmt::format("{}", standing->to_limit_deg()) : "");
}

Cells hip_fields(const LoadedJoint& loaded, const motion::BearingFinding& bearing, std::string_view notes,
                 std::string_view inputs) {
  const auto& surface = bearing.surface;
  return {std::string(name_of(loaded.joint.side)), surface ? fmt::format("{}", surface->head.radius) : "",
          surface ? fmt::format("{}", surface->margin_mm) : "", std::string(notes), std::string(inputs)};
}

/// Codes of what looks wrong with a joint that was read, as a sample hip is as it was made, and with its load or motion. Throws MeshError if that is to end
/// the run.
std::string notes_on(const StudyTable& table, const StudyRow& row, const LoadedJoint& loaded,
                     std::span<const motion::ContactNote> of_contact, BadJoint bad_joint) {
  std::string codes, texts;
  const auto take = [&](const auto& note) {
    codes += (codes.empty() ? "" : " ") + std::string(name_of(note.code));
    texts += fmt::format("{}{}: {}", texts.empty() ? "" : "; ", name_of(note.code), note.text);
  };
  if (!is_sample(table, row))
    for (const JointNote& note : check_joint(loaded.joint, loaded.report.placement)) take(note);
  for (const motion::ContactNote& note : of_contact) take(note);
  if (bad_joint == BadJoint::ends_run && !codes.empty())
    throw MeshError(fmt::format("{}: line {}: joint {}: {}", table.path.string(), row.line,
                                in_quotes(table.id(row)), texts));
  return codes;
}

}  // namespace

std::optional<StudyAnswer> answer_of(const StudyTable& table, const StudyRow& row, const Study& study,
                                     const InputRecorder& read, std::stop_token stop) {
  const StudyOptions& options = study.options;
  const StudyJoint of_joint = load_joint(table, row);
  const LoadedJoint& loaded = of_joint.loaded;
  check_kind(table, row, loaded, options);
  const Joint& joint = loaded.joint;
  const std::string place = place_of(table, row);
  std::optional<PoseDegrees> depth_at;
  if (options.depth_at) depth_at = pose_of(table, row, joint, *options.depth_at);
  LoadFields load;
  if (options.load) {
    StudyLoad posed = *options.load;
    posed.at = pose_of(table, row, joint, posed.at);
    load = name_joint_file(place, [&] { return load_fields(loaded, posed); });
  }
  RangeRequest request = range_request_of(loaded, options);
  const StudyFollow followed =
      name_joint_file(place, [&] { return StudyFollow(table, row, loaded, options, request); });
  motion::add_new(load.notes, range_request_notes(request));
  std::string notes = notes_on(table, row, loaded, load.notes, study.bad_joint);
  std::optional<Cells> measures;
  if (options.measures) {
    measures =
        name_joint_file(place, [&] { return measure_fields(table, row, loaded, request.bands, stop); });
    if (!measures) return std::nullopt;
  }
  const auto answer = name_joint_file(place, [&] { return answer_range(loaded, request, {.stop = stop}); });
  if (!answer) return std::nullopt;
  std::optional<ResectionFields> resection;
  if (options.resection) {
    resection =
        name_joint_file(place, [&] { return resection_fields(loaded, *options.resection, request, stop); });
    if (!resection) return std::nullopt;
  }
  const auto add_code = [&](const auto& note) {
    notes += (notes.empty() ? "" : " ") + std::string(name_of(note.code));
  };
  for (const std::string& code : of_joint.codes) notes += (notes.empty() ? "" : " ") + code;
  for (const RangeNote& note : answer->notes) add_code(note);
  const Cells of_row = row_fields(table, row);
  std::vector<Input> inputs = read.inputs();
  Cells of_hip = hip_fields(loaded, answer->bearing, notes, inputs_sha256(row, inputs));
  if (may_follow(table, options)) of_hip.emplace_back(answer->follows ? "0" : "1");
  if (answer->map) add_map(of_hip, *answer->map);
  if (depth_at) name_joint_file(place, [&] { add_depth(of_hip, joint, *depth_at); });
  for (std::string& field : load.fields) of_hip.push_back(std::move(field));
  if (measures) of_hip.insert(of_hip.end(), measures->begin(), measures->end());
  if (resection) of_hip.insert(of_hip.end(), resection->of_hip.begin(), resection->of_hip.end());
  return StudyAnswer{limit_lines(of_row, *answer, limit_columns_of(table, options),
                                 resection ? std::move(resection->of_limits) : std::vector<Cells>()),
                     line_of(of_row, of_hip),
                     {},
                     std::move(inputs)};
}

StudyAnswer failure_of(const StudyTable& table, const StudyRow& row, const InputRecorder& read) {
  const Failure failure = failure_of_current_exception();
  std::vector<Input> inputs = read.inputs();
  const Cells why = {fmt::format("{}", static_cast<int>(failure.exit_code)), csv_field(failure.message),
                     inputs_sha256(row, inputs)};
  return {{}, {}, line_of(row_fields(table, row), why), std::move(inputs)};
}

}  // namespace condyle::io
