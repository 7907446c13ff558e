#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "answer.hpp"
#include "choice.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/io/study.hpp"
#include "contact_options.hpp"
#include "help_formatter.hpp"
#include "model_options.hpp"
#include "range_options.hpp"
#include "resection_options.hpp"
#include "with_progress.hpp"

namespace condyle::cli {
namespace {

struct StudyArguments {
  std::string table, out, shard, depth;
  std::optional<std::string> crate_date;
  std::optional<Anatomy> anatomy;
  StudyLoadArguments load;
  bool follows_load = false;
  std::vector<std::string> motions;
  bool leaves_out_reference_contacts = false, measures = false;
  ResectionArguments cut;
  io::BadJoint bad_joint = io::BadJoint::is_a_row;
  RangeArguments range;
};

io::StudyFollowLoad follow_load_of(const StudyArguments& given) {
  if (given.load.pose)
    throw UsageError("--follow-load: stands beside --load, and one of the two is meant by --force");
  const StudyLoadArguments& load = given.load;
  if (load.force.empty()) throw UsageError("--follow-load: needs --force");
  return {Vec3(load.force[0], load.force[1], load.force[2]), directions_of(load.along), load.contact};
}

io::StudyOptions study_options(const StudyArguments& given) {
  const RangeArguments& range = given.range;
  io::StudyOptions options;
  options.anatomy = given.anatomy.value_or(Anatomy::hip);
  options.motions = names_in(given.motions);
  options.bearing = range.bearing;
  options.reference_contact = range.reference_contact;
  if (given.leaves_out_reference_contacts) options.leave_out_reference_contacts.emplace();
  options.map = grid_of(range, JointKind::free, options.anatomy);
  if (options.map && options.map->translates()) throw UsageError("--map: a study has maps of angles only");
  options.bands = band_of(range);
  if (!given.depth.empty()) options.depth_at = io::study_pose(given.depth, options.anatomy);
  options.measures = given.measures;
  if (!given.cut.targets.empty())
    options.resection = io::StudyResection{parse_reach(given.cut.targets), resection_request_of(given.cut)};
  if (given.follows_load)
    options.follow_load = follow_load_of(given);
  else if (given.load.pose)
    options.load = study_load_of(given.load, options.anatomy);
  else if (given.load.any_beside())
    throw UsageError("--force, --e and all else on a load: needs --load or --follow-load");
  return options;
}

void study_command(const StudyArguments& given) {
  io::Study study{given.table, given.out, study_options(given), {}, given.bad_joint, given.crate_date};
  if (!given.shard.empty()) study.shard = io::Shard::parse(given.shard);
  const io::StudyDone done =
      with_progress([&](const Control& control) { return io::run_study(study, control); }, Writes::parts);
  for (const io::NotedJoint& joint : done.noted) note(joint.id + ": " + joint.codes);
  if (done.earlier > 0) note(fmt::format("{} joints were answered by an earlier run", done.earlier));
  if (done.was_there) note("is there already, of the same inputs, options and version");
  if (!done.written.empty()) say_written(done.written);
  print(fmt::format("{} answered, {} failed\n", done.joints, done.failures));
  // A shard may hold failures only: condyle merge knows of all joints.
  if (!study.shard) io::require_answered(done, study.table);
}

}  // namespace

void add_study(CLI::App& app) {
  auto* command = app.add_subcommand("study", "Compute the limits of many joints: a table in, tables out");
  command->footer(
      "Example: condyle sample cohort --n 4 --out cohort\n"
      "         condyle study cohort/cohort.csv --out study --shard 1/2\n"
      "         condyle study cohort/cohort.csv --out study --shard 2/2\n"
      "         condyle merge study\n"
      "A joint that cannot be answered is a row of failures.csv with its exit code and reason; the study "
      "answers the "
      "others and ends with exit code 0. If none could be answered it ends with the exit code of the "
      "first "
      "one; a shard with 0. Rows done before with the same inputs, options and version are "
      "not done again.");
  auto options = std::make_shared<StudyArguments>();
  command
      ->add_option(
          "TABLE", options->table,
          "A CSV file with a row per joint: id, then joint (a joint file), or fixed and mobile (meshes) with "
          "side, units and axes, or sample (1 to 4) with measures. A column follow names the recorded motion "
          "that the translation of a free joint follows. Other columns go into the results")
      ->required();
  add_out(*command, options->out,
          "Write limits.csv, hips.csv, failures.csv, columns.csv, study.h5 and study.json into this "
          "folder")
      ->required();
  add_value(
      *command, "--shard", options->shard, "i/N",
      "Answer only part i of N of the table, into FOLDER/shards. condyle merge puts the parts together");
  add_crate(*command, options->crate_date);
  add_motions(*command, options->motions);
  add_anatomy(*command, options->anatomy, "The joint of all rows of the table", "hip");
  add_map(*command, options->range);
  add_bearing(*command, options->range);
  command->add_flag("--exclude-reference-contacts", options->leaves_out_reference_contacts,
                    "Ignore triangles that are in contact in the reference pose");
  add_accept(*command, options->range);
  add_band(*command, options->range);
  add_value(*command, "--depth", options->depth, "POSE",
            "Compute how deep the bodies are in each other in this pose too, such as \"flexion=90 "
            "internal_rotation=30\"");
  command->add_flag(
      "--measures", options->measures,
      "Measure the shape of each hip too, as condyle measure does, with bands if --band says so; the "
      "pelvis is tilted forwards by the table's column pelvic_tilt_deg");
  CLI::Option* resect =
      add_value(*command, "--resect", options->cut.targets, "MOTION=DEG ...",
                "Find the bone that must go for these motions to reach this far, as condyle resect "
                "--reach does: \"flexion=115 fadir=+10\"");
  add_cut(*command, options->cut, resect);
  add_value(*command, "--load", options->load.pose, "POSE",
            "Compute contact pressure in this pose too (\"\" is the reference pose), with the layers "
            "of the joint "
            "files or those of --e, --nu and --thickness");
  command->add_flag(
      "--follow-load", options->follows_load,
      "Do not hold the centre of free joints: at each angle the contact carries --force. Limits are then "
      "bounded, not exact");
  add_study_load(*command, options->load, "With --load or --follow-load: ");
  add_flag(*command, "--strict", options->bad_joint, io::BadJoint::ends_run,
           "End the run, and write nothing, at a joint that cannot be answered or with which something looks "
           "wrong (exit code 4)");
  group_help(*command, {{"Most used", {"--out", "--motion", "--band", "--map", "--shard"}},
                        {"Question",
                         {"--anatomy", "--vary", "--depth", "--measures", "--resect", "--load",
                          "--follow-load", "--force", "--along"}},
                        resection_group(),
                        uncertainty_group(),
                        {"Contact",
                         {"--bearing", "--accept-reference-contact", "--exclude-reference-contacts", "--e",
                          "--nu", "--thickness", "--law", "--casting", "--rule", "--reach"}},
                        {"Output", {"--crate", "--strict", "--help"}}});
  command->callback([options] { study_command(*options); });
}

}  // namespace condyle::cli
