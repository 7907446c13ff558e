#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "choice.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "contact_options.hpp"
#include "io/motion/gaps.hpp"
#include "io/motion/load_table.hpp"
#include "io/motion/motion_of_joint.hpp"
#include "joint_command.hpp"
#include "model_options.hpp"

namespace condyle::cli {
namespace {

struct MotionArguments : JointArguments {
  std::string motion, loads;
  std::string model_joint;  ///< of a model in place of a joint file
  std::optional<Side> side;
  ModelOptions model;
  bool with_pressure = false, between = false, to_limits = false, screws = false;
  io::ContactChanges contact;
  BalanceArguments balance;
  std::vector<double> cycle;
  io::MotionFiles files;
};

/// The load of each frame, from a file. Frames without one are gaps of the motion.
std::vector<std::optional<contact::Load>> loads_of(const MotionArguments& options, io::JointMotion& motion) {
  if (options.loads.empty()) return {};
  const io::MotionTable table = io::read_motion_table(options.loads);
  auto loads = io::loads_of(table, motion.times, options.balance.frame, options.balance.rotations);
  std::vector<std::string> processing = table.processing;
  io::note_gaps(table, loads, processing);
  for (const std::string& remark : processing)
    motion.processing.push_back(fmt::format("{}: {}", options.loads, remark));
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (!loads[i]) motion.X_FM[i].reset();
  return loads;
}

MotionRequest request_of(const MotionArguments& options, const Joint& joint, io::JointMotion& motion) {
  MotionRequest request{.loads = loads_of(options, motion)};
  request.X_FM = motion.X_FM;
  if (motion.times.in_seconds) request.time_s = motion.times.values;
  require_load(options.balance, options.balance.any() || !options.loads.empty());
  if (options.balance.any()) request.load = load_of(options.balance);
  if (request.has_load()) request.balance = balance_options_of(options.balance, joint);
  if (options.between) request.between = BetweenFrames::always;
  request.screws = options.screws;
  return request;
}

io::LoadedJoint joint_or_model(const MotionArguments& options) {
  if (is_model(options.joint)) {
    const io::Model model = model_of(options.joint, options.model.geometry);
    io::LoadedJoint loaded =
        io::read_joint(model, request_of(model, options.model, options.model_joint, options.side));
    for (const std::string& remark : loaded.report.file.processing) note(remark);
    return loaded;
  }
  if (!options.model_joint.empty() || options.side || options.model.any() || options.model.polygons)
    throw UsageError(
        "--joint, --side, --anatomy, --contact, --geometry, --polygons: are for models of OpenSim, .osim");
  return io::read_joint(options.joint);
}

void motion_command(const MotionArguments& options, const CLI::App& command) {
  const io::InputRecorder read;
  const io::LoadedJoint loaded = joint_at(joint_or_model(options), options.parameters);
  const io::MotionTable table = io::read_motion_table(options.motion);
  io::JointMotion motion = io::motion_of(loaded, table);
  MotionRequest request = request_of(options, loaded.joint, motion);
  if (has_damping(loaded.joint.ligaments)) request.motions = io::recorded_speeds(loaded, table);
  check_motion_request(request);
  for (const std::string& remark : motion.processing) note(remark);
  const bool with_pressure = options.with_pressure || request.has_load();
  io::Provenance from = provenance_of(options, loaded, command, {options.motion, options.loads});
  if (!options.out.empty()) io::check_motion_folder(options.out, &from);
  const io::ContactEntry contact =
      io::motion_contact(contact_of(options.contact, loaded.report.file, with_pressure), with_pressure);
  const io::ContactSurfaces surfaces = io::surfaces_of(contact, loaded.joint);
  const io::MotionQuestion question{loaded,  motion,           surfaces,
                                    contact, with_pressure,    noted(loaded, options.strictness),
                                    &from,   options.to_limits};
  const MotionAnswer answer = io::name_joint_file(options.joint, [&] {
    const io::MotionOfJoint of_joint(question, std::move(request));
    // Frames take long: notes that are errors end the command before them.
    if (options.strictness == Strictness::errors) note_contact(of_joint.notes(), loaded, options.strictness);
    return with_progress([&](const Control& control) { return of_joint.answer(control); });
  });
  io::add_other_files(from, read);
  note_contact(answer.notes, loaded, options.strictness);
  if (!options.out.empty()) {
    io::MotionFiles files = options.files;
    files.encoding = options.vtp_encoding;
    if (!options.cycle.empty()) files.cycle = io::Cycle{options.cycle[0], options.cycle[1]};
    const auto written = io::write_motion(options.out, question, answer, files);
    if (written.size() <= 8)
      say_written(written);
    else
      note(fmt::format("wrote {} files into {}", written.size(), options.out));
  }
  print(options.form == AnswerForm::json ? io::motion_json(question, answer)
                                         : io::motion_text(question, answer));
}

}  // namespace

void add_motion(CLI::App& app) {
  auto* command = app.add_subcommand(
      "motion", "Compute contact in every frame of a recorded motion: area, depth, pressure, force");
  command->footer(
      "Example: condyle sample cartilages --clearance -0.3 --out sample\n"
      "         printf 'time,flexion_deg\\n0,0\\n0.5,15\\n1,30\\n' > walk.csv\n"
      "         condyle motion sample/cartilages.toml --motion walk.csv --load --e 12 --nu 0.42 "
      "--thickness 1.5 --out walk\n"
      "The motion file's columns are those of [recorded_motion] in the joint file, or flexion_deg, x_mm and "
      "the like. A joint of an OpenSim model is MODEL.osim --joint NAME.");
  auto options = std::make_shared<MotionArguments>();
  add_joint(*command, *options, "The joint file, .toml, or a model of OpenSim, .osim, with --joint");
  add_value(*command, "--motion", options->motion, "FILE", "The recorded motion, .mot, .sto or .csv")
      ->required();
  add_value(*command, "--joint", options->model_joint, "NAME",
            "The joint of a model, as condyle init takes it");
  add_side(*command, options->side, "The side of a model's joint. Default: by the ending of its name");
  add_model(*command, options->model);
  add_flag(
      *command, "--load", options->with_pressure, true,
      "Compute pressure, force and moment of the recorded poses too, with the layers of the options or of "
      "the joint file; --force and --loads include it");
  add_rays(*command, options->contact);
  add_layers(*command, options->contact);
  add_balance(*command, options->balance);
  add_value(*command, "--loads", options->loads, "FILE",
            "Move the mobile body in each frame to where the contact carries that row of this table: columns "
            "force_x_n, force_y_n, force_z_n; with --free-rotations moment_x_nmm, ... too")
      ->excludes(command->get_option("--force"))
      ->excludes(command->get_option("--moment"));
  add_flag(
      *command, "--to-limits", options->to_limits, true,
      "Compute how far each frame is from the nearest limit, one angle turning alone: some 10 ms a frame");
  add_flag(*command, "--screws", options->screws, true,
           "Compute depths along arcs about the screw axis of the step into each frame: some 10 ms a frame");
  auto* between = add_flag(
      *command, "--between", options->between, true,
      "Also find contact between the samples, within bounds, if the centre moves. About a held centre it "
      "is exact and always found");
  for (const char* load : {"--force", "--moment", "--loads"}) between->excludes(command->get_option(load));
  auto* out =
      add_out(*command, options->out, "Write curves.csv, curves.sto and motion.json into this folder");
  add_value(*command, "--cycle", options->cycle, "START END",
            "With --out: write cycle.csv too, 101 points between two times in seconds")
      ->expected(2)
      ->needs(out);
  add_flag(*command, "--maps", options->files.maps, true,
           "With --out: write a VTP file per frame too, and motion.pvd for ParaView")
      ->needs(out);
  add_flag(*command, "--jam", options->files.jam, true,
           "With --out: write jam.h5 too, as OpenSim-JAM writes contact")
      ->needs(out);
  add_where(*command, *options);
  add_json(*command, options->form);
  add_strict(*command, options->strictness, or_contact);
  std::vector<std::string> of_models{"--joint", "--side"};
  for (const std::string& name : model_names()) of_models.push_back(name);
  group_help(*command,
             {{"Most used", {"--motion", "--load", "--force", "--out", "--json"}},
              {"Question",
               {"--set", "--to-limits", "--screws", "--between", "--loads", "--moment", "--force-frame",
                "--along", "--free-rotations", "--ligaments"}},
              {"Models", of_models},
              {"Contact", {"--e", "--nu", "--thickness", "--law", "--casting", "--rule", "--reach"}},
              {"Output", {"--cycle", "--maps", "--jam", "--frame", "--ascii", "--strict", "--help"}}});
  command->callback([options, command] { motion_command(*options, *command); });
}

}  // namespace condyle::cli
