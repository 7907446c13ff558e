#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "choice.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "follow_options.hpp"
#include "io/result/crate.hpp"
#include "io/result/limit_files.hpp"
#include "io/result/rom_files.hpp"
#include "io/result/rom_result.hpp"
#include "joint_command.hpp"
#include "range_options.hpp"

namespace condyle::cli {
namespace {

enum class Task { limits, list_motions };
enum class ReferenceContacts { count, leave_out };

struct RomArguments : JointArguments {
  std::vector<std::string> motions;
  std::optional<double> allow_depth_mm;
  std::optional<std::string> crate_date;
  FollowArguments follow;
  io::TextForm text = io::TextForm::brief;
  ReferenceContacts reference_contacts = ReferenceContacts::count;
  RangeArguments range;
  io::LimitFile limits;  ///< no path: none
  Task task = Task::limits;
  motion::ClockPlane clock = motion::ClockPlane::sagittal;
};

/// One line per motion: its name, what varies and how far, and what is held.
std::string list_of(const std::vector<motion::Motion>& motions, Anatomy joint) {
  std::size_t widest = 0;
  for (const motion::Motion& motion : motions) widest = std::max(widest, motion.name.size());
  std::string text;
  for (const motion::Motion& motion : motions) {
    const auto degrees = [&](JointAngle angle) { return angle_of(motion.start, angle).degrees() + 0.0; };
    const double from = degrees(motion.vary), to = from + sign_of(motion.sense) * motion.range.degrees();
    text += fmt::format("{:<{}}  {} from {:g} to {:g}", motion.name, widest, name_of(motion.vary, joint),
                        from, to);
    for (const JointAngle angle : all_joint_angles)
      if (angle != motion.vary && degrees(angle) != 0)
        text += fmt::format(", {} {:g}", name_of(angle, joint), degrees(angle));
    text += "\n";
  }
  return text;
}

RangeRequest request_of(const RomArguments& options, const io::LoadedJoint& loaded,
                        std::vector<motion::Motion> motions) {
  RangeRequest request = range_request_of(options.range, loaded, std::move(motions));
  if (options.reference_contacts == ReferenceContacts::leave_out)
    request.range.overlap.leave_out_reference_contacts.emplace();
  if (options.allow_depth_mm)
    request.allowed_depth = motion::AllowedDepth{.depth_mm = *options.allow_depth_mm};
  request.clock = options.clock;
  return request;
}

/// --write-limits and what goes with it.
CLI::Option* add_limits(CLI::App& command, RomArguments& given) {
  auto* write = command.add_option(
      "--write-limits", given.limits.path,
      "Write limits of each coordinate by itself for another program: .osim of the model that condyle init "
      "read the joint from, .xml of MuJoCo; or .csv of coupled limits, by --map or over a grid of 10 "
      "degrees");
  write->option_text("FILE");
  add_choice(
      command, "--limits", given.limits.source,
      {{"bony", LimitSource::bony}, {"living", LimitSource::living}},
      "With --write-limits: where bone ends a motion, or where a living hip is expected to if studies say so",
      "bony")
      ->needs(write);
  add_choice(command, "--angle-unit", given.limits.angles,
             {{"degree", io::AngleUnit::degrees}, {"radian", io::AngleUnit::radians}},
             "The unit of angles in an .xml, as <compiler angle=...> of your model has it", "degree")
      ->needs(write);
  add_choice(command, "--stop", given.limits.stop,
             {{"limit", io::StopForce::limit}, {"linear", io::StopForce::linear}},
             "The force of an .osim: CoordinateLimitForce, or CoordinateLinearStopForce of OpenSim 4.6",
             "limit")
      ->needs(write);
  add_value(command, "--model", given.limits.model, "FILE",
            "Write a copy of this model, .osim, and no fragment")
      ->needs(write);
  return write;
}

/// Where the bodies are in contact in the reference pose, the error names the options there are.
RangeAnswer answer_of(const RomArguments& options, const io::LoadedJoint& loaded,
                      const RangeRequest& request) {
  return answered(options, [&](const Control& control) {
    try {
      return answer_range(loaded, request, control);
    } catch (const motion::ReferenceContactError& error) {
      throw motion::ReferenceContactError(std::string(error.what()) +
                                          " (--allow-depth, --exclude-reference-contacts, "
                                          "[reference_pose] in the joint file, --accept-reference-contact)");
    }
  });
}

void rom_command(const RomArguments& options, const CLI::App& command) {
  if (options.crate_date) io::check_crate_date(*options.crate_date);
  say_as(options.text);
  const io::InputRecorder read;
  const io::LoadedJoint loaded = joint_of(options);
  std::vector<motion::Motion> motions = Case(loaded).motions(names_in(options.motions));
  if (options.task == Task::list_motions) return print(list_of(motions, loaded.joint.anatomy));
  RangeRequest request = request_of(options, loaded, std::move(motions));
  std::optional<Followed> followed;
  io::name_joint_file(options.joint, [&] {
    followed.emplace(options.follow, loaded,
                     options.motions.empty() ? io::MotionsAre::all : io::MotionsAre::chosen, request);
    check_range_request(loaded, request);
  });
  const std::vector<JointNote> notes = noted(loaded, options.strictness);
  note_contact(range_request_notes(request), loaded, options.strictness);
  io::Provenance from = provenance_of(options, loaded, command, {options.follow.record});
  io::LimitCoordinates known_by;
  if (!options.limits.path.empty())
    known_by = io::limit_coordinates(loaded, options.limits, &from, !options.range.translation.empty());
  // A folder that cannot be written to is reported before the work, not after it.
  if (!options.out.empty()) io::check_rom_folder(options.out, &from);
  if (!options.limits.path.empty() && !options.out.empty() &&
      std::filesystem::weakly_canonical(std::filesystem::absolute(options.limits.path).parent_path()) ==
          std::filesystem::weakly_canonical((std::filesystem::absolute(options.out) / "file").parent_path()))
    throw UsageError("--write-limits: " + options.limits.path.string() +
                     " would lie in the folder of --out, whose files are replaced");

  io::add_other_files(from, read);
  const RangeAnswer answer = answer_of(options, loaded, request);
  note_all(answer.notes);
  io::RomResult result = io::rom_result_of(answer, notes, &from);
  std::optional<LimitBoxRecord> box;
  if (!known_by.coordinates.empty()) {
    box = answered(options, [&](const Control& control) {
      return io::limit_box(known_by, loaded, answer, request, options.limits.source, control);
    });
    result.box = &*box;
    io::write_limits(options.limits, *box, loaded, known_by, &from);
    note("wrote " + options.limits.path.string());
  }
  if (!options.out.empty())
    say_written(io::write_rom(options.out, result, options.vtp_encoding, options.crate_date));
  print(options.form == AnswerForm::json ? io::rom_json(result) : io::rom_text(result, options.text));
}

}  // namespace

void add_rom(CLI::App& app) {
  auto* command =
      app.add_subcommand("rom", "Compute how far a joint turns before bone meets bone, where, and why");
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle rom sample/hip.toml --motion flexion --motion fadir\n"
      "         condyle rom sample/hip.toml --map flexion=0:120:10 adduction=-30:20:10 --out range\n"
      "         condyle rom sample/hip.toml --write-limits hip.xml --angle-unit radian\n"
      "Exit code 6: the bodies are in contact in the reference pose and no option says what to do about it.");
  auto options = std::make_shared<RomArguments>();
  add_joint(*command, *options);
  add_motions(*command, options->motions);
  add_flag(*command, "--list-motions", options->task, Task::list_motions,
           "Print the motions that the joint has, with their angles, and end");
  auto* map = add_map(*command, options->range);
  auto* translation = add_translation(*command, options->range);
  auto* past = add_past(*command, options->range);
  auto* bearing = add_bearing(*command, options->range);
  auto* contacts =
      add_flag(*command, "--exclude-reference-contacts", options->reference_contacts,
               ReferenceContacts::leave_out, "Ignore triangles that are in contact in the reference pose");
  auto* depth =
      command->add_option("--allow-depth", options->allow_depth_mm,
                          "End a motion where the radial depth exceeds this, for meshes that overlap in "
                          "every pose. Such a limit is searched for and is not exact");
  depth->option_text("MM");
  auto* accept = add_accept(*command, options->range);
  auto* band = add_band(*command, options->range);
  CLI::Option* limits = add_limits(*command, *options);
  for (CLI::Option* other : {map, bearing, contacts, accept, band, limits}) depth->excludes(other);
  add_follow(*command, options->follow, {map, contacts, accept, band, depth, translation, past, limits});
  add_choice(
      *command, "--clock", options->clock,
      {{"sagittal", motion::ClockPlane::sagittal}, {"rim", motion::ClockPlane::rim}},
      "The plane of the clock on which contacts are read: the sagittal one, or that of the rim with 6 at "
      "the notch",
      "sagittal");
  auto* out =
      add_out(*command, options->out,
              "Write rom.json, limits.csv and bearing.vtp into this folder; map.csv, map_intervals.csv and "
              "map.vtp of a map, zone_*.vtp of zones. python3 -m condyle.plot FOLDER draws them");
  add_crate(*command, options->crate_date)->needs(out);
  add_person(*command, options->person);
  add_where(*command, *options);
  add_json(*command, options->form);
  add_verbose(*command, options->text);
  add_strict(*command, options->strictness, or_contact);
  group_help(*command,
             {{"Most used", {"--motion", "--band", "--map", "--out", "--json"}},
              {"Question",
               {"--set", "--age", "--sex", "--species", "--list-motions", "--vary", "--past", "--translation",
                "--clock"}},
              uncertainty_group(),
              {"Centre not held", follow_names()},
              {"Contact",
               {"--bearing", "--accept-reference-contact", "--exclude-reference-contacts", "--allow-depth"}},
              {"For other programs", {"--write-limits", "--limits", "--stop", "--model", "--angle-unit"}},
              {"Output", {"--verbose", "--crate", "--frame", "--ascii", "--strict", "--help"}}});
  command->callback([options, command] { rom_command(*options, *command); });
}

}  // namespace condyle::cli
