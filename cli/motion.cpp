#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/joint_motion.hpp"
#include "condyle/io/motion_result.hpp"
#include "contact_options.hpp"
#include "followed.hpp"
#include "io/motion/gaps.hpp"
#include "io/motion/load_table.hpp"
#include "motion_surfaces.hpp"
#include "notes.hpp"

namespace condyle::cli {
namespace {

struct Options {
  std::string joint, motion, loads, out;
  bool with_pressure = false, between = false;
  std::shared_ptr<ContactChanges> contact = std::make_shared<ContactChanges>();
  std::shared_ptr<BalanceGiven> balance = std::make_shared<BalanceGiven>();
  std::vector<double> cycle;
  MotionFiles files;
  Strictness strictness = Strictness::notes;
  std::shared_ptr<WhereOptions> where = std::make_shared<WhereOptions>();
  AnswerForm form = AnswerForm::text;
};

/// What each frame has to carry; nothing where no load is given. Frames without their load are gaps of the motion.
std::vector<Load> loads_of(const Options& options, JointMotion& motion) {
  if (options.loads.empty())
    return options.balance->any() ? std::vector<Load>{load_of(*options.balance)} : std::vector<Load>{};
  const MotionTable table = read_motion_table(options.loads);
  const auto given = io::loads_of(table, motion.times, options.balance->frame, options.balance->rotations);
  std::vector<std::string> processing = table.processing;
  io::note_gaps(table, given, processing);
  for (const std::string& remark : processing)
    motion.processing.push_back(fmt::format("{}: {}", options.loads, remark));
  std::vector<Load> loads(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i])
      loads[i] = *given[i];
    else
      motion.X_FM[i].reset();
  }
  return loads;
}

/// Whether the mobile body's origin is in one place in all frames.
bool holds_centre(std::span<const std::optional<Pose>> X_FM) {
  std::optional<Vec3> centre;
  return std::all_of(X_FM.begin(), X_FM.end(), [&](const std::optional<Pose>& X) {
    if (X && !centre) centre = X->translation();
    return !X || X->translation() == *centre;
  });
}

MotionAnswer answer_of(const Options& options, const MotionSurfaces& surfaces, const MotionQuestion& question,
                       const std::vector<Load>& loads) {
  MotionAnswer answer;
  std::vector<std::optional<Pose>> X_FM = question.motion.X_FM;
  if (!loads.empty()) {
    const BalanceOptions balance = balance_options_of(*options.balance);
    // As in the swing of a gait: there is no pose to look for, in these frames only.
    for (std::size_t i = 0; i < X_FM.size() && !options.loads.empty(); ++i) {
      if (!X_FM[i] || !io::is_zero_along(loads[i], *X_FM[i], balance)) continue;
      answer.without_load.push_back(i);
      X_FM[i].reset();
    }
    answer.balanced = followed("balanced frames", [&](const auto& follow, std::stop_token stop) {
      return balance_along(*surfaces.elastic(), X_FM, loads, balance, {.progress = follow, .stop = stop});
    });
    // What does not carry its load has no contact to tell of.
    for (std::size_t i = 0; i < X_FM.size(); ++i) {
      if (!X_FM[i]) continue;
      if (answer.balanced[i]->carries_load())
        X_FM[i] = answer.balanced[i]->X_FM;
      else
        X_FM[i].reset();
    }
  }
  // Between samples of a held centre contact is exact and cheap, so it is always looked for; else on request.
  if (answer.balanced.empty() &&
      (options.between || (question.motion.times.in_seconds && holds_centre(X_FM)))) {
    answer.between = followed("ways between samples", [&](const auto& follow, std::stop_token stop) {
      return contact_between_frames(surfaces.bodies(), question.motion, {.progress = follow, .stop = stop});
    });
  }
  answer.frames = surfaces.frames(X_FM);
  if (surfaces.elastic())
    if (const auto largest = frame_of_largest_force(answer))
      if (const auto refined = surfaces.elastic()->refined_force_n(answer.frames[*largest]->X_FM))
        answer.refined_largest_force_n = refined->norm();
  return answer;
}

void run(const Options& options, const CLI::App& command) {
  const LoadedJoint loaded = read_joint(options.joint);
  JointMotion motion = motion_of(loaded, read_motion_table(options.motion));
  if (options.between && !motion.times.in_seconds)
    throw UsageError("--between: needs times in seconds, and this motion has frame numbers only");
  const std::vector<Load> loads = loads_of(options, motion);
  for (const std::string& remark : motion.processing) note(remark);
  const bool with_pressure = options.with_pressure || !loads.empty();
  Provenance from = provenance_of(loaded, words_of(command), options.where->frame);
  for (const std::string* file : {&options.motion, &options.loads})
    if (!file->empty()) from.read.emplace_back(*file);
  if (!options.out.empty()) check_motion_folder(options.out, &from);
  const ContactEntry contact = motion_contact_of(*options.contact, loaded.report.file, with_pressure);
  const ContactSurfaces surfaces = surfaces_of(contact, loaded.joint);
  const MotionQuestion question{
      loaded, motion, surfaces, contact, with_pressure, noted(loaded, options.strictness), &from};
  const MotionSurfaces ready(question);
  std::vector<ContactNote> notes;
  const auto also_note = [&](std::vector<ContactNote> more) {
    note_contact(notes, std::move(more), loaded, options.strictness);
  };
  const BodyNames names{surfaces.fixed.name, surfaces.mobile.name};
  also_note(motion.notes);
  if (ready.elastic()) also_note(check_layers(*ready.elastic(), names));
  const auto largest = std::max_element(loads.begin(), loads.end(), [](const Load& a, const Load& b) {
    return a.on_mobile.force_n.norm() < b.on_mobile.force_n.norm();
  });
  if (largest != loads.end()) also_note(check_load(*largest));
  MotionAnswer answer = answer_of(options, ready, question, loads);
  also_note(check_motion(answer.frames, names));
  answer.notes = std::move(notes);
  if (!options.out.empty()) {
    MotionFiles files = options.files;
    files.encoding = options.where->vtp_encoding;
    if (!options.cycle.empty()) files.cycle = Cycle{options.cycle[0], options.cycle[1]};
    const auto written = write_motion(options.out, question, answer, files);
    if (written.size() <= 8)
      say_written(written);
    else
      note(fmt::format("wrote {} files into {}", written.size(), options.out));
  }
  print(options.form == AnswerForm::json ? motion_json(question, answer) : motion_text(question, answer));
}

}  // namespace

void add_motion(CLI::App& app) {
  auto* command = app.add_subcommand(
      "motion", "Contact in every frame of a recorded motion: area, depth, pressure, force");
  command->footer(
      "Example: condyle motion examples/tibiofemoral.toml --motion states.sto --load --out flexion\n"
      "The motion file's columns are those of [recorded_motion] in the joint file, or flexion_deg, x_mm and "
      "the like.");
  auto options = std::make_shared<Options>();
  command->add_option("JOINT", options->joint, "Joint file (TOML)")->required();
  command->add_option("--motion", options->motion, "Recorded motion: .mot, .sto or .csv")
      ->required()
      ->option_text("FILE");
  command->add_flag_callback(
      "--load", [options] { options->with_pressure = true; },
      "Pressure, force and moment too; layers by options or the joint file");
  add_rays(*command, options->contact);
  add_layers(*command, options->contact);
  add_balance(*command, options->balance);
  command
      ->add_option("--loads", options->loads,
                   "Balance a force per frame: columns force_x_n, force_y_n, force_z_n; with "
                   "--free-rotations also moment_x_nmm, ...")
      ->excludes(command->get_option("--force"))
      ->excludes(command->get_option("--moment"))
      ->option_text("FILE");
  auto* between = command->add_flag_callback(
      "--between", [options] { options->between = true; },
      "Contact between the samples too, bounded where the centre moves; where it is held that is exact and "
      "always done");
  for (const char* load : {"--force", "--moment", "--loads"}) between->excludes(command->get_option(load));
  auto* out = command->add_option("--out", options->out, "Folder for curves.csv, curves.sto and motion.json");
  command
      ->add_option("--cycle", options->cycle,
                   "With --out: also cycle.csv, 101 points between two times in seconds")
      ->expected(2)
      ->needs(out)
      ->option_text("START END");
  command
      ->add_flag_callback(
          "--maps", [options] { options->files.maps = true; },
          "With --out: also a VTP file per frame, and motion.pvd for ParaView")
      ->needs(out);
  command
      ->add_flag_callback(
          "--jam", [options] { options->files.jam = true; },
          "With --out: also jam.h5, as OpenSim-JAM writes contact")
      ->needs(out);
  add_where(*command, options->where);
  command->add_flag_callback(
      "--json", [options] { options->form = AnswerForm::json; }, "Answer in JSON");
  add_strict(*command, options->strictness);
  command->callback([options, command] { run(*options, *command); });
}

}  // namespace condyle::cli
