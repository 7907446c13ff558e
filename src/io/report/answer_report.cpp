#include "io/report/answer_report.hpp"

#include <fmt/format.h>

#include <utility>

#include "condyle/error.hpp"
#include "io/joint/name_joint_file.hpp"
#include "io/motion/motion_of_joint.hpp"

namespace condyle::io {
namespace {

/// As the joint file describes it.
ContactEntry entry_of(const LoadedJoint& loaded) {
  return loaded.report.file.contact.value_or(ContactEntry{});
}

void require_layers(const LoadedJoint& loaded) {
  const ContactEntry entry = entry_of(loaded);
  if (entry.fixed || entry.mobile) return;
  const std::string file = loaded.report.file.path.string();
  throw UsageError(
      fmt::format("{}load: no layers: [contact.fixed] and [contact.mobile] of the joint file have them",
                  file.empty() ? "" : file + ": "));
}

/// False if it was stopped.
bool answer_limits(RangeOrReason& range, const Case& joint, const RangeRequest& request,
                   const Control& control) {
  if (range.answer) return true;
  try {
    range.answer = answer_range(joint, request, control);
    return range.answer.has_value();
  } catch (const MeshError& error) {
    range.why_none = error.what();
    return true;
  }
}

MotionQuestion question_of(const LoadedJoint& shown, const RecordedAnswer& recorded, bool with_pressure) {
  return {shown, recorded.motion, recorded.surfaces, recorded.contact, with_pressure};
}

/// Empty if it was stopped.
std::optional<RecordedAnswer> recorded_of(const LoadedJoint& shown, const ReportRequest& request,
                                          const Control& control) {
  RecordedAnswer recorded{.motion = motion_of(shown, *request.motion),
                          .contact = motion_contact(entry_of(shown), request.with_pressure),
                          .surfaces = surfaces_of(entry_of(shown), shown.joint),
                          .answer = {}};
  const MotionQuestion question = question_of(shown, recorded, request.with_pressure);
  const MotionOfJoint of_joint(question, {.X_FM = recorded.motion.X_FM, .between = BetweenFrames::never});
  if (request.look_at_notes) request.look_at_notes(recorded.motion.processing, of_joint.notes());
  auto answer = of_joint.answer(control);
  if (!answer) return std::nullopt;
  recorded.answer = std::move(*answer);
  return recorded;
}

ReportedLayers layers_of(const LoadedJoint& shown, std::vector<motion::ContactNote>& notes) {
  const ContactEntry entry = entry_of(shown);
  const ContactSurfaces surfaces = surfaces_of(entry, shown.joint);
  ReportedLayers layers{entry, elastic_options(entry, surfaces, shown)};
  motion::add_new(notes, motion::check_layers(surfaces.fixed.mesh, surfaces.mobile.mesh, layers.options,
                                              {surfaces.fixed.name, surfaces.mobile.name}));
  return layers;
}

/// The joint of the page: without the bone of a plan.
LoadedJoint shown_joint(const LoadedJoint& loaded, const ReportAnswer& answer) {
  return answer.plan ? LoadedJoint{answer.plan->resection.joint, loaded.report} : loaded;
}

}  // namespace

std::optional<ReportAnswer> answer_report(const LoadedJoint& loaded, const ReportRequest& request,
                                          const Control& control, ReportAnswer known) {
  if (request.with_pressure) require_layers(loaded);
  ReportAnswer answer = std::move(known);
  const auto named = [&](const auto& question) {
    const std::string file = loaded.report.file.path.string();
    return file.empty() ? question() : name_joint_file(file, question);
  };
  if (request.plan && !answer.plan) {
    ResectionRequest plan = *request.plan;
    plan.motions = request.range.motions;
    plan.resection.range = request.range.range;
    answer.plan = named([&] { return answer_resection(loaded, plan, control); });
    if (!answer.plan) return std::nullopt;
  }
  const LoadedJoint shown = shown_joint(loaded, answer);
  std::vector<motion::ContactNote>& notes = answer.contact_notes =
      answer.range.answer ? answer.range.answer->contact_notes : range_request_notes(request.range);
  if (request.motion) {
    answer.recorded = recorded_of(shown, request, control);
    if (!answer.recorded) return std::nullopt;
    motion::add_new(notes, answer.recorded->answer.notes);
  }
  if (request.with_pressure) answer.layers.emplace(layers_of(shown, notes));
  if (request.look_at_notes) request.look_at_notes({}, notes);
  if (!answer_limits(answer.range, shown, request.range, control)) return std::nullopt;
  if (answer.range.answer) answer.range.answer->contact_notes = notes;
  if (request.before) {
    RangeRequest range = request.range;
    range.map.reset();
    range.zones_past.reset();
    // Bands that are compared are displaced alike.
    Case before = *request.before;
    before.uncertainty = loaded.report.file.uncertainty;
    before.band_seed = loaded.report.file.band_seed;
    if (!answer_limits(answer.before, before, range, control)) return std::nullopt;
  }
  if (request.sweep && !answer.sweep && answer.range.answer) {
    answer.sweep = answer_sweep(loaded, *request.sweep, control);
    if (!answer.sweep) return std::nullopt;
  }
  if (request.with_measures) {
    answer.measures = named([&] { return answer_measures(shown, {.bands = request.range.bands}, control); });
    if (!answer.measures) return std::nullopt;
  }
  return answer;
}

void write_report(const std::filesystem::path& path, const LoadedJoint& loaded, const ReportRequest& request,
                  const ReportAnswer& answer, const ReportWords& words) {
  const LoadedJoint shown = shown_joint(loaded, answer);
  std::optional<RomResult> rom, rom_before;
  if (answer.range.answer) rom.emplace(rom_result_of(*answer.range.answer, words.notes, words.from));
  Report report = report_of(shown, rom ? &*rom : nullptr, answer.range.why_none);
  if (words.title) report.title = *words.title;
  report.labels = words.labels;
  report.bearing_margin_mm = request.range.range.bearing.margin_mm;
  if (request.before) {
    if (answer.before.answer)
      rom_before.emplace(rom_result_of(*answer.before.answer, words.notes_before, words.from_before));
    report.before.emplace(ReportedBefore{.joint = request.before->joint,
                                         .file = request.before->report.file.path,
                                         .rom = rom_before ? &*rom_before : nullptr,
                                         .rom_error = answer.before.why_none});
  }
  std::optional<SweepResult> sweep;
  if (answer.sweep) report.sweep = &sweep.emplace(sweep_result_of(loaded, *answer.sweep, {}, nullptr));
  if (answer.layers) report.layers.emplace(*answer.layers);
  std::optional<MotionQuestion> question;
  if (answer.recorded) {
    question.emplace(question_of(shown, *answer.recorded, request.with_pressure));
    report.recorded.emplace(
        ReportedMotion{answer.recorded->motion.path.filename().string(), *question, answer.recorded->answer});
  }
  std::optional<MeasureResult> shape;
  if (answer.measures)
    report.measures = &shape.emplace(MeasureResult{shown.joint, *answer.measures, words.notes, words.from});
  std::optional<ResectionResult> plan;
  if (answer.plan)
    report.plan = &plan.emplace(
        ResectionResult{loaded.joint, *answer.plan, words.notes, words.from, &loaded.report.file});
  write_report(path, report);
}

}  // namespace condyle::io
