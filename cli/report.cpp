#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "answered_motion.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/joint.hpp"
#include "follow_options.hpp"
#include "followed.hpp"
#include "help_formatter.hpp"
#include "io/file/input_recorder.hpp"
#include "io/joint/known_motions.hpp"
#include "io/joint/measure_request.hpp"
#include "io/joint/name_joint_file.hpp"
#include "io/report/report.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/sweep/sweep_result.hpp"
#include "io/sweep/target_table.hpp"
#include "notes.hpp"
#include "range.hpp"
#include "range_options.hpp"
#include "resection_options.hpp"
#include "set_option.hpp"
#include "whole_number.hpp"

namespace condyle::cli {
namespace {

enum class Content { joint, nothing };

struct ReportArguments {
  ParameterArguments parameters;
  Content content = Content::joint;
  std::string first, second, out, motion, sweep, targets;
  std::optional<std::string> title;
  io::ReportLabels labels;
  bool with_pressure = false, measures = false;
  std::size_t curve_points = ResectionQuery{}.curve_points;
  std::shared_ptr<ResectionArguments> cut = std::make_shared<ResectionArguments>();
  std::shared_ptr<RangeArguments> range = std::make_shared<RangeArguments>();
  std::shared_ptr<FollowArguments> follow = std::make_shared<FollowArguments>();
  Strictness strictness = Strictness::notes;

  bool has_plan() const noexcept { return !cut->targets.empty(); }
  /// Whether the joint of the page, the second of two, is compared with the first.
  bool compares() const noexcept { return !second.empty(); }
  const std::string& joint() const noexcept { return compares() ? second : first; }
};

/// The limits, or in one line why there are none: the page shows the joint all the same.
struct RangeOrError {
  std::optional<RangeAnswer> answer;
  std::string error;
};

RangeOrError range_of(const io::LoadedJoint& loaded, const RangeRequest& request, std::string_view whose) {
  try {
    return {answered_range(loaded, request, whose), {}};
  } catch (const MeshError& error) {
    note(fmt::format("{}no limits: {}", whose, error.what()));
    return {{}, error.what()};
  }
}

/// The joint before, and its answer to what the joint of the page is asked. What a report takes of it refers to its members.
class JointBefore {
 public:
  /// Reads it; throws UsageError if it cannot be compared with the joint of the page.
  JointBefore(const ReportArguments& options, const Joint& of_page, std::vector<std::string> words)
      : whose_(options.first + ": "),
        loaded_(io::read_joint(options.first)),
        from_(io::provenance_of(loaded_, std::move(words))) {
    io::check_comparable(loaded_.joint, options.first, of_page, options.second);
    notes_ = noted(loaded_, options.strictness, whose_);
  }
  JointBefore(const JointBefore&) = delete;
  JointBefore& operator=(const JointBefore&) = delete;

  const std::vector<std::filesystem::path>& files() const noexcept { return from_.read; }

  /// Its limits for the same motions, with bands of the same seed and standard deviations.
  io::ReportedBefore answered(RangeRequest request) {
    request.map.reset();
    request.zones_past.reset();
    found_ = range_of(loaded_, request, whose_);
    if (found_.answer) rom_.emplace(io::rom_result_of(*found_.answer, notes_, &from_));
    return {.joint = loaded_.joint,
            .file = loaded_.report.file.path,
            .rom = rom_ ? &*rom_ : nullptr,
            .rom_error = found_.error};
  }

 private:
  std::string whose_;
  io::LoadedJoint loaded_;
  io::Provenance from_;
  std::vector<JointNote> notes_;
  RangeOrError found_;
  std::optional<io::RomResult> rom_;
};

/// The frames of a recorded motion. What it consists of refers to the parts before it.
struct Recorded {
  Recorded(const ReportArguments& options, const io::LoadedJoint& loaded, const io::MotionTable& table)
      : motion(io::motion_of(loaded, table)),
        contact(motion_contact_of({}, loaded.report.file, options.with_pressure)),
        surfaces(io::surfaces_of(contact, loaded.joint)),
        question{loaded, motion, surfaces, contact, options.with_pressure} {
    for (const std::string& remark : motion.processing) note(remark);
  }
  Recorded(const Recorded&) = delete;
  Recorded& operator=(const Recorded&) = delete;

  io::JointMotion motion;
  io::ContactEntry contact;
  io::ContactSurfaces surfaces;
  io::MotionQuestion question;
  MotionAnswer answer;
};

/// The page without a joint; every option but --out is for one with a joint.
void write_empty(const ReportArguments& options, const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && option->get_name() != "--out" && option->get_name() != "--empty")
      throw UsageError(option->get_name() + ": is for a report of a joint, not for --empty");
  io::write_empty_report(options.out);
  say_written({options.out});
}

void check_plan(const ReportArguments& options, const Joint& joint) {
  if (!options.has_plan()) return;
  if (options.with_pressure)
    throw UsageError("--resect: not with --load, whose layers are of the joint with the bone");
  if (joint.kind == JointKind::free)
    throw UsageError(
        "--resect: a page shows the plan of a ball joint or a hinge; of a free joint it shows resected.toml, "
        "which condyle resect --out writes");
}

/// Throws UsageError for what a comparison does not show.
void check_comparison(const ReportArguments& options) {
  if (!options.compares()) return;
  if (options.has_plan())
    throw UsageError("--resect: a plan has its own before and after: for one joint file, not for two");
  if (!options.follow->record.empty() || options.follow->load)
    throw UsageError(fmt::format("{}: for one joint file, not for two, whose centres are held",
                                 options.follow->load ? "--follow-load" : "--follow"));
}

/// As `condyle resect` answers.
ResectionAnswer planned(const ReportArguments& options, const io::LoadedJoint& loaded,
                        const RangeRequest& range) {
  ResectionQuery query{.resection = resection_request_of(*options.cut), .motions = range.motions};
  query.resection.targets = reach_targets(range.motions, options.cut->targets);
  query.resection.range = range.range;
  query.curve_points = options.curve_points;
  query.measures = io::measure_request_of(loaded);
  return io::name_joint_file(options.joint(), [&] {
    return followed_by_stage([&](const AnswerControl& control) {
      return answer_resection(loaded.joint, loaded.report.placement, query, control);
    });
  });
}

MeasureAnswer measured(const ReportArguments& options, const io::LoadedJoint& loaded,
                       const RangeRequest& range) {
  const MeasureQuery query{io::measure_request_of(loaded), range.bands};
  return io::name_joint_file(options.joint(), [&] {
    return followed_by_stage(
        [&](const AnswerControl& control) { return answer_measures(loaded.joint, query, control); });
  });
}

/// As `condyle sweep` asks; nothing without --sweep.
std::optional<SweepQuery> swept(const ReportArguments& options, const io::LoadedJoint& loaded,
                                const RangeRequest& range) {
  if (options.sweep.empty()) return std::nullopt;
  if (options.has_plan())
    throw UsageError("--sweep: not with --resect, whose bone is cut where its parts are");
  if (options.with_pressure)
    throw UsageError("--sweep: not with --load, whose layers lie on the joint as it is");
  SweepQuery query{.parameters = plan::parse_sweep(options.sweep),
                   .targets = io::read_targets(options.targets, io::known_motions(loaded), loaded.joint.kind,
                                               loaded.joint.anatomy),
                   .range = range.range};
  io::check_shown_sweep(query.parameters, query.targets.size());
  io::name_joint_file(options.joint(), [&] { check_sweep(loaded.joint, query); });
  return query;
}

io::SweepResult answered_sweep(const io::LoadedJoint& loaded, const SweepQuery& query) {
  SweepAnswer answer = followed_by_stage([&](const AnswerControl& control) {
    return answer_sweep(loaded.joint, loaded.report.placement, query, control);
  });
  for (const SweepNote& each : answer.notes) note(fmt::format("{}: {}", name_of(each.code), each.text));
  return io::sweep_result_of(loaded, std::move(answer), query, {}, nullptr);
}

void report_command(const ReportArguments& options, const CLI::App& command) {
  if (options.content == Content::nothing) return write_empty(options, command);
  if (options.joint().empty()) throw UsageError("report: JOINT is required, or --empty");
  const io::InputRecorder read;
  const io::LoadedJoint loaded = joint_at(io::read_joint(options.joint()), options.parameters);
  check_plan(options, loaded.joint);
  check_comparison(options);
  std::optional<JointBefore> before;
  if (options.compares()) before.emplace(options, loaded.joint, words_of(command));
  std::optional<io::MotionTable> table;
  if (!options.motion.empty()) table = io::read_motion_table(options.motion);
  RangeRequest request = range_request_of(*options.range, loaded, io::known_motions(loaded));
  std::optional<Followed> follows;
  io::name_joint_file(options.joint(),
                      [&] { follows.emplace(*options.follow, loaded, io::MotionsAre::all, request); });
  const std::optional<SweepQuery> sweep_query = swept(options, loaded, request);
  const std::string whose = before ? options.joint() + ": " : "";
  const std::vector<JointNote> notes = noted(loaded, options.strictness, whose);
  io::Provenance from = io::provenance_of(loaded, words_of(command));
  for (const std::string& file : {options.motion, options.follow->record, options.targets})
    if (!file.empty()) from.read.emplace_back(file);
  if (before) from.read.insert(from.read.end(), before->files().begin(), before->files().end());
  // Where the file cannot be written is reported before the work, not after it.
  io::check_report_file(options.out, &from);

  std::optional<ResectionAnswer> plan;
  std::optional<io::LoadedJoint> without_bone;
  if (options.has_plan()) {
    plan = planned(options, loaded, request);
    without_bone.emplace(io::LoadedJoint{plan->resection.joint, loaded.report});
    for (const ResectionNote& each : plan->notes) note(fmt::format("{}: {}", name_of(each.code), each.text));
  }
  const io::LoadedJoint& shown = without_bone ? *without_bone : loaded;
  std::optional<Recorded> recorded;
  std::vector<motion::ContactNote> contact_notes = range_request_notes(request);
  if (table) {
    recorded.emplace(options, shown, *table);
    recorded->answer =
        answered_motion(recorded->question, {.X_FM = recorded->motion.X_FM, .between = BetweenFrames::never},
                        options.strictness);
    motion::add_new(contact_notes, recorded->answer.notes);
  }
  io::ContactEntry contact;
  std::optional<io::ReportedLayers> layers;
  if (options.with_pressure) {
    contact = contact_of({}, loaded.report.file, true);
    const io::ContactSurfaces surfaces = io::surfaces_of(contact, loaded.joint);
    layers.emplace(io::ReportedLayers{contact, io::elastic_options(contact, surfaces, loaded)});
    motion::add_new(contact_notes,
                    motion::check_layers(surfaces.fixed.mesh, surfaces.mobile.mesh, layers->options,
                                         {surfaces.fixed.name, surfaces.mobile.name}));
  }
  note_contact(contact_notes, loaded, options.strictness);
  const auto [answer, error] = range_of(shown, request, whose);
  std::optional<io::RomResult> rom;
  if (answer) {
    rom.emplace(io::rom_result_of(*answer, notes, &from));
    rom->contact_notes = contact_notes;
  }
  io::Report report{.title = options.title.value_or(loaded.joint.name),
                    .joint = shown.joint,
                    .reference_pose = loaded.report.placement.reference_pose,
                    .rom = rom ? &*rom : nullptr,
                    .rom_error = error,
                    .bearing_margin_mm = request.range.bearing.margin_mm,
                    .labels = options.labels};
  if (loaded.report.file.recorded_motion) report.recorded_motion = &*loaded.report.file.recorded_motion;
  if (before) report.before.emplace(before->answered(request));
  std::optional<io::SweepResult> sweep;
  if (sweep_query && answer) report.sweep = &sweep.emplace(answered_sweep(loaded, *sweep_query));
  if (sweep_query && !answer)
    note("no safe zone: without limits the page shows none, and --sweep is not computed");
  if (layers) report.layers.emplace(std::move(*layers));
  if (recorded)
    report.recorded.emplace(io::ReportedMotion{std::filesystem::path(options.motion).filename().string(),
                                               recorded->question, recorded->answer});
  std::optional<MeasureAnswer> measures;
  if (options.measures) measures = measured(options, shown, request);
  std::optional<io::MeasureResult> shape;
  if (measures) report.measures = &shape.emplace(io::MeasureResult{shown.joint, *measures, notes, &from});
  std::optional<io::ResectionResult> cut;
  if (plan)
    report.plan = &cut.emplace(io::ResectionResult{loaded.joint, *plan, notes, &from, &loaded.report.file});
  io::add_other_files(from, read);
  io::write_report(options.out, report);
  say_written({options.out});
}

}  // namespace

void add_report(CLI::App& app) {
  auto* command = app.add_subcommand(
      "report", "Write one HTML file that shows the joint and computes with it in any browser");
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle report sample/hip.toml --out report.html\n"
      "         condyle report sample/hip.toml --band --map flexion=0:120:10 adduction=-30:20:10 --out "
      "report.html\n"
      "         condyle report sample/hip.toml --measures --resect \"fadir=50\" --out plan.html\n"
      "         condyle sample hip --alpha-angle 70 --out cam\n"
      "         condyle report cam/hip.toml sample/hip.toml --band --out compared.html\n"
      "         condyle report --empty --out drop_a_hip.html\n"
      "The file needs no server and no network, and sends nothing. If limits cannot be computed it says "
      "why and shows the joint.");
  auto options = std::make_shared<ReportArguments>();
  options->parameters = add_set(*command);
  command->add_option("JOINT", options->first, "The joint file, .toml; with AFTER, that of the joint before");
  command->add_option("AFTER", options->second,
                      "Show this joint file, and compare it with JOINT. --set is for this one only");
  command->add_flag_callback(
      "--empty", [options] { options->content = Content::nothing; },
      "Write a page without a joint, which takes the meshes of a hip that are dropped on it");
  command->add_option("--out", options->out, "Write the page to this file, .html")
      ->required()
      ->option_text("FILE");
  command->add_option("--title", options->title, "Put this heading on the page")
      ->option_text("TEXT (the joint's name)");
  command
      ->add_option("--case", options->labels.case_name,
                   "Begin the heading with this: a number or a pseudonym")
      ->option_text("TEXT");
  command->add_option("--note", options->labels.note, "Put this under the result")->option_text("TEXT");
  command
      ->add_option("--date", options->labels.date,
                   "Put this date into the heading; none is taken from the clock")
      ->option_text("TEXT");
  command->add_flag("--paths", options->labels.whole_paths,
                    "Name files by their paths as given, not only by their names");
  command
      ->add_option("--motion", options->motion,
                   "Show the frames of this recorded motion, .mot, .sto or .csv, and their curves")
      ->option_text("FILE");
  command->add_flag_callback(
      "--load", [options] { options->with_pressure = true; },
      "Show pressure too, with the layers of the joint file: as a colour in any pose, and with --motion in "
      "its curves");
  CLI::Option* sweep =
      command
          ->add_option("--sweep", options->sweep,
                       "Show which values of one or two parameters of parts leave all targets free, as "
                       "condyle sweep --vary does: \"cup.inclination=30:60:5 cup.anteversion=0:40:5\"")
          ->option_text("PART.PARAMETER=FIRST:LAST:STEP ...");
  CLI::Option* targets = command
                             ->add_option("--targets", options->targets,
                                          "With --sweep: a CSV file with a row for each motion that must be "
                                          "free, as condyle sweep takes it")
                             ->option_text("FILE")
                             ->needs(sweep);
  sweep->needs(targets);
  command->add_flag("--measures", options->measures,
                    "Show the shape of a hip too, as condyle measure does, with bands if --band says so");
  CLI::Option* resect =
      command
          ->add_option("--resect", options->cut->targets,
                       "Show the joint without the bone that must go for these motions to reach this far, as "
                       "condyle resect --reach does: \"flexion=115 fadir=30\"")
          ->option_text("MOTION=DEG ...");
  add_cut(*command, options->cut, resect);
  command
      ->add_option("--curve", options->curve_points,
                   "Points on the curve of degrees against mm3 for each target; 0 for none, each costs a cut")
      ->option_text("N (10)")
      ->check(whole_number(0, 1000))
      ->needs(resect);
  auto* map = add_map(*command, options->range);
  auto* translation = add_translation(*command, options->range);
  auto* past = add_past(*command, options->range);
  add_bearing(*command, options->range);
  auto* accept = add_accept(*command, options->range);
  auto* band = add_band(*command, options->range);
  add_follow(*command, options->follow, {map, translation, past, accept, band});
  add_strict(*command, options->strictness);
  HelpGroup of_cut = resection_group();
  of_cut.options.emplace_back("--curve");
  group_help(
      *command,
      {{"Most used", {"--out", "--band", "--map", "--motion", "--load"}},
       {"Question",
        {"--set", "--vary", "--past", "--translation", "--measures", "--resect", "--sweep", "--targets"}},
       of_cut,
       uncertainty_group(),
       {"Centre not held", follow_names()},
       {"Contact", {"--bearing", "--accept-reference-contact"}},
       {"Output", {"--empty", "--title", "--case", "--note", "--date", "--paths", "--strict", "--help"}}});
  command->callback([options, command] { report_command(*options, *command); });
}

}  // namespace condyle::cli
