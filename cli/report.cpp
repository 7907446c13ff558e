#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "choice.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/joint.hpp"
#include "contact_options.hpp"
#include "follow_options.hpp"
#include "io/report/answer_report.hpp"
#include "io/sweep/target_table.hpp"
#include "joint_command.hpp"
#include "range_options.hpp"
#include "resection_options.hpp"

namespace condyle::cli {
namespace {

enum class Content { joint, nothing };

struct ReportArguments {
  std::vector<std::string> parameters;
  Person person;
  Content content = Content::joint;
  std::string first, second, out, motion, sweep, targets;
  std::optional<std::string> title;
  io::ReportLabels labels;
  bool with_pressure = false, measures = false;
  std::size_t curve_points = ResectionRequest{}.curve_points;
  ResectionArguments cut;
  RangeArguments range;
  FollowArguments follow;
  Strictness strictness = Strictness::notes;

  bool has_plan() const noexcept { return !cut.targets.empty(); }
  /// Whether the joint of the page, the second of two, is compared with the first.
  bool compares() const noexcept { return !second.empty(); }
  const std::string& joint() const noexcept { return compares() ? second : first; }
};

/// The joint before, which is compared with that of the page.
struct JointBefore {
  /// Reads it; throws UsageError if it cannot be compared with the joint of the page.
  JointBefore(const ReportArguments& options, const Joint& of_page, std::vector<std::string> words)
      : whose(options.first + ": "),
        loaded(joint_at(io::read_joint(options.first), {}, options.person)),
        from(io::provenance_of(loaded, std::move(words))) {
    io::check_comparable(loaded.joint, options.first, of_page, options.second);
    notes = noted(loaded, options.strictness, whose);
  }

  std::string whose;
  io::LoadedJoint loaded;
  io::Provenance from;
  std::vector<JointNote> notes;
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
  if (!options.follow.record.empty() || options.follow.load)
    throw UsageError(fmt::format("{}: for one joint file, not for two, whose centres are held",
                                 options.follow.load ? "--follow-load" : "--follow"));
}

/// As `condyle resect` asks; nothing without --resect.
std::optional<ResectionRequest> planned(const ReportArguments& options, const RangeRequest& range) {
  if (!options.has_plan()) return std::nullopt;
  ResectionRequest request{.resection = resection_request_of(options.cut),
                           .confidence = confidence_of(options.cut, BandRequest{}),
                           .curve_points = options.curve_points};
  request.resection.targets = reach_targets(range.motions, options.cut.targets);
  if (range.bands) request.bands = range.bands;
  return request;
}

/// As `condyle sweep` asks; nothing without --sweep.
std::optional<SweepRequest> swept(const ReportArguments& options, const io::LoadedJoint& loaded,
                                  const RangeRequest& range) {
  if (options.sweep.empty()) return std::nullopt;
  if (options.has_plan())
    throw UsageError("--sweep: not with --resect, whose bone is cut where its parts are");
  if (options.with_pressure)
    throw UsageError("--sweep: not with --load, whose layers lie on the joint as it is");
  SweepRequest request{.parameters = plan::parse_sweep(options.sweep),
                       .targets = io::read_targets(options.targets, Case(loaded).motions(), loaded.joint.kind,
                                                   loaded.joint.anatomy),
                       .range = range.range};
  io::check_shown_sweep(request.parameters, request.targets.size());
  io::name_joint_file(options.joint(), [&] { check_sweep(loaded, request); });
  return request;
}

/// What is said beside the answers; notes on contact have been said.
void note_answers(const ReportArguments& options, const std::optional<JointBefore>& before,
                  const io::ReportRequest& request, const io::ReportAnswer& answer) {
  if (answer.plan) note_all(answer.plan->notes);
  const auto of_limits = [](const io::RangeOrReason& range, std::string_view whose) {
    if (range.answer) return note_all(range.answer->notes, whose);
    note(fmt::format("{}no limits: {}", whose, range.why_none));
  };
  of_limits(answer.range, before ? options.joint() + ": " : "");
  if (before) of_limits(answer.before, before->whose);
  if (answer.sweep) note_all(answer.sweep->notes);
  if (request.sweep && !answer.sweep)
    note("no safe zone: without limits the page shows none, and --sweep is not computed");
}

void report_command(const ReportArguments& options, const CLI::App& command) {
  if (options.content == Content::nothing) return write_empty(options, command);
  if (options.joint().empty()) throw UsageError("report: JOINT is required, or --empty");
  const io::InputRecorder read;
  const io::LoadedJoint loaded =
      joint_at(io::read_joint(options.joint()), options.parameters, options.person);
  check_plan(options, loaded.joint);
  check_comparison(options);
  std::optional<JointBefore> before;
  if (options.compares()) before.emplace(options, loaded.joint, words_of(command));
  io::ReportRequest request{.with_pressure = options.with_pressure, .with_measures = options.measures};
  if (!options.motion.empty()) request.motion = io::read_motion_table(options.motion);
  request.range = range_request_of(options.range, loaded, Case(loaded).motions());
  std::optional<Followed> follows;
  io::name_joint_file(options.joint(), [&] {
    follows.emplace(options.follow, loaded, io::MotionsAre::all, request.range);
    check_range_request(loaded, request.range);
  });
  request.plan = planned(options, request.range);
  request.sweep = swept(options, loaded, request.range);
  if (before) request.before = &before->loaded;
  std::vector<motion::ContactNote> said;
  request.look_at_notes = [&](const std::vector<std::string>& processing,
                              const std::vector<motion::ContactNote>& contact) {
    for (const std::string& remark : processing) note(remark);
    const auto before_these = static_cast<std::ptrdiff_t>(said.size());
    motion::add_new(said, contact);
    note_contact({said.begin() + before_these, said.end()}, loaded, options.strictness);
  };
  const std::vector<JointNote> notes =
      noted(loaded, options.strictness, before ? options.joint() + ": " : "");
  io::Provenance from = io::provenance_of(loaded, words_of(command));
  for (const std::string& file : {options.motion, options.follow.record, options.targets})
    if (!file.empty()) from.read.emplace_back(file);
  if (before) from.read.insert(from.read.end(), before->from.read.begin(), before->from.read.end());
  // Where the file cannot be written is reported before the work, not after it.
  io::check_report_file(options.out, &from);

  const io::ReportAnswer answer =
      with_progress([&](const Control& control) { return io::answer_report(loaded, request, control); });
  note_answers(options, before, request, answer);
  io::add_other_files(from, read);
  io::ReportWords words{.title = options.title, .labels = options.labels, .notes = notes, .from = &from};
  if (before) words.notes_before = before->notes, words.from_before = &before->from;
  io::write_report(options.out, loaded, request, answer, words);
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
  add_set(*command, options->parameters);
  add_person(*command, options->person);
  command->add_option("JOINT", options->first, "The joint file, .toml; with AFTER, that of the joint before");
  command->add_option("AFTER", options->second,
                      "Show this joint file, and compare it with JOINT. --set is for this one only");
  add_flag(
      *command, "--empty", options->content, Content::nothing,
      "Write a page without a joint, which takes files that are dropped on it and has a sample hip to try");
  add_value(*command, "--out", options->out, "FILE", "Write the page to this file, .html")->required();
  add_value(*command, "--title", options->title, "TEXT (the joint's name)", "Put this heading on the page");
  add_value(*command, "--case", options->labels.case_name, "TEXT",
            "Begin the heading with this: a number or a pseudonym");
  add_value(*command, "--note", options->labels.note, "TEXT", "Put this under the result");
  add_value(*command, "--date", options->labels.date, "TEXT",
            "Put this date into the heading; none is taken from the clock");
  command->add_flag("--paths", options->labels.whole_paths,
                    "Name files by their paths as given, not only by their names");
  add_value(*command, "--motion", options->motion, "FILE",
            "Show the frames of this recorded motion, .mot, .sto or .csv, and their curves");
  add_flag(
      *command, "--load", options->with_pressure, true,
      "Show pressure too, with the layers of the joint file: as a colour in any pose, and with --motion in "
      "its curves");
  CLI::Option* sweep =
      add_value(*command, "--sweep", options->sweep, "PART.PARAMETER=FIRST:LAST:STEP ...",
                "Show which values of one or two parameters of parts leave all targets free, as "
                "condyle sweep --vary does: \"cup.inclination=30:60:5 cup.anteversion=0:40:5\"");
  CLI::Option* targets = add_value(*command, "--targets", options->targets, "FILE",
                                   "With --sweep: a CSV file with a row for each motion that must be "
                                   "free, as condyle sweep takes it")
                             ->needs(sweep);
  sweep->needs(targets);
  command->add_flag("--measures", options->measures,
                    "Show the shape of a hip too, as condyle measure does, with bands if --band says so");
  CLI::Option* resect =
      add_value(*command, "--resect", options->cut.targets, "MOTION=DEG ...",
                "Show the joint without the bone that must go for these motions to reach this far, as "
                "condyle resect --reach does: \"flexion=115 fadir=+10\"");
  add_cut(*command, options->cut, resect);
  add_confidence(*command, options->cut)->excludes(command->get_option("--margin"))->needs(resect);
  add_curve(*command, options->curve_points)->needs(resect);
  auto* map = add_map(*command, options->range);
  auto* translation = add_translation(*command, options->range);
  auto* past = add_past(*command, options->range);
  add_bearing(*command, options->range);
  auto* accept = add_accept(*command, options->range);
  auto* band = add_band(*command, options->range);
  add_follow(*command, options->follow, {map, translation, past, accept, band});
  add_strict(*command, options->strictness, or_contact);
  HelpGroup of_cut = resection_group();
  of_cut.options.insert(of_cut.options.end(), {"--confidence", "--curve"});
  group_help(
      *command,
      {{"Most used", {"--out", "--band", "--map", "--motion", "--load"}},
       {"Question",
        {"--set", "--age", "--sex", "--species", "--vary", "--past", "--translation", "--measures",
         "--resect", "--sweep", "--targets"}},
       of_cut,
       uncertainty_group(),
       {"Centre not held", follow_names()},
       {"Contact", {"--bearing", "--accept-reference-contact"}},
       {"Output", {"--empty", "--title", "--case", "--note", "--date", "--paths", "--strict", "--help"}}});
  command->callback([options, command] { report_command(*options, *command); });
}

}  // namespace condyle::cli
