#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "answered_motion.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/joint.hpp"
#include "help_formatter.hpp"
#include "io/report/report.hpp"
#include "notes.hpp"
#include "range.hpp"
#include "range_options.hpp"

namespace condyle::cli {
namespace {

enum class Content { joint, nothing };

struct Options {
  Content content = Content::joint;
  std::string joint, out, motion;
  std::optional<std::string> title;
  bool with_pressure = false;
  std::shared_ptr<RangeGiven> range = std::make_shared<RangeGiven>();
  Strictness strictness = Strictness::notes;
};

/// The limits, or in one line why there are none: the page shows the joint all the same.
struct RangeOrError {
  std::optional<RangeAnswer> answer;
  std::string error;
};

RangeOrError range_of(const LoadedJoint& loaded, const RangeRequest& request) {
  try {
    return {answered_range(loaded, request), {}};
  } catch (const MeshError& error) {
    note(fmt::format("no limits: {}", error.what()));
    return {{}, error.what()};
  }
}

/// The frames of a recorded motion. What it consists of refers to the parts before it.
struct Recorded {
  Recorded(const Options& options, const LoadedJoint& loaded)
      : motion(motion_of(loaded, read_motion_table(options.motion))),
        contact(motion_contact_of({}, loaded.report.file, options.with_pressure)),
        surfaces(surfaces_of(contact, loaded.joint)),
        question{loaded, motion, surfaces, contact, options.with_pressure} {
    for (const std::string& remark : motion.processing) note(remark);
  }
  Recorded(const Recorded&) = delete;
  Recorded& operator=(const Recorded&) = delete;

  JointMotion motion;
  ContactEntry contact;
  ContactSurfaces surfaces;
  MotionQuestion question;
  MotionAnswer answer;
};

/// The page without a joint; every option but --out is for one with a joint.
void write_empty(const Options& options, const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && option->get_name() != "--out" && option->get_name() != "--empty")
      throw UsageError(option->get_name() + ": is for a report of a joint, not for --empty");
  write_empty_report(options.out);
  say_written({options.out});
}

void run(const Options& options, const CLI::App& command) {
  if (options.content == Content::nothing) return write_empty(options, command);
  if (options.joint.empty()) throw UsageError("report: JOINT is required, or --empty");
  const LoadedJoint loaded = read_joint(options.joint);
  std::optional<Recorded> recorded;
  if (!options.motion.empty()) recorded.emplace(options, loaded);
  const RangeRequest request = range_request_of(*options.range, loaded, motions_of(loaded));
  const std::vector<JointNote> notes = noted(loaded, options.strictness);
  Provenance from = provenance_of(loaded, words_of(command));
  if (recorded) from.read.emplace_back(options.motion);
  // Where the file cannot be written is reported before the work, not after it.
  check_report_file(options.out, &from);

  std::vector<ContactNote> contact_notes;
  if (recorded) {
    recorded->answer =
        answered_motion(recorded->question, {.X_FM = recorded->motion.X_FM, .between = BetweenFrames::never},
                        options.strictness);
    contact_notes = recorded->answer.notes;
  }
  ContactEntry contact;
  std::optional<ReportedLayers> layers;
  if (options.with_pressure) {
    contact = contact_of({}, loaded.report.file, true);
    const ContactSurfaces surfaces = surfaces_of(contact, loaded.joint);
    layers.emplace(ReportedLayers{contact, elastic_options(contact, surfaces, loaded)});
    add_new(contact_notes, check_layers(surfaces.fixed.mesh, surfaces.mobile.mesh, layers->options,
                                        {surfaces.fixed.name, surfaces.mobile.name}));
  }
  note_contact(contact_notes, loaded, options.strictness);
  const auto [answer, error] = range_of(loaded, request);
  std::optional<RomResult> rom;
  if (answer) {
    rom.emplace(rom_result_of(*answer, notes, &from));
    rom->contact_notes = contact_notes;
  }
  Report report{.title = options.title.value_or(loaded.joint.name),
                .joint = loaded.joint,
                .reference_pose = loaded.report.placement.reference_pose,
                .rom = rom ? &*rom : nullptr,
                .rom_error = error};
  if (layers) report.layers.emplace(std::move(*layers));
  if (recorded)
    report.recorded.emplace(ReportedMotion{std::filesystem::path(options.motion).filename().string(),
                                           recorded->question, recorded->answer});
  write_report(options.out, report);
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
      "         condyle report --empty --out drop_a_hip.html\n"
      "The file needs no server and no network, and sends nothing. Where limits cannot be answered it says "
      "why and shows the joint.");
  auto options = std::make_shared<Options>();
  command->add_option("JOINT", options->joint, "The joint file, .toml");
  command->add_flag_callback(
      "--empty", [options] { options->content = Content::nothing; },
      "Write a page without a joint, which takes the meshes of a hip that are dropped on it");
  command->add_option("--out", options->out, "Write the page to this file, .html")
      ->required()
      ->option_text("FILE");
  command->add_option("--title", options->title, "Put this heading on the page")
      ->option_text("TEXT (the joint's name)");
  command
      ->add_option("--motion", options->motion,
                   "Show the frames of this recorded motion, .mot, .sto or .csv, and their curves")
      ->option_text("FILE");
  command->add_flag_callback(
      "--load", [options] { options->with_pressure = true; },
      "Show pressure too, with the layers of the joint file: as a colour in any pose, and with --motion in "
      "its curves");
  add_map(*command, options->range);
  add_past(*command, options->range);
  add_bearing(*command, options->range);
  add_accept(*command, options->range);
  add_band(*command, options->range);
  add_strict(*command, options->strictness);
  group_help(*command, {{"Most used", {"--out", "--band", "--map", "--motion", "--load"}},
                        {"Question", {"--vary", "--past", "--translation"}},
                        uncertainty_group(),
                        {"Contact", {"--bearing", "--accept-reference-contact"}},
                        {"Output", {"--empty", "--title", "--strict", "--help"}}});
  command->callback([options, command] { run(*options, *command); });
}

}  // namespace condyle::cli
