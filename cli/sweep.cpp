#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "choice.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "condyle/io/study.hpp"
#include "contact_options.hpp"
#include "io/file/input_file.hpp"
#include "io/sweep/load_quantities.hpp"
#include "io/sweep/sweep_files.hpp"
#include "io/sweep/target_table.hpp"
#include "joint_command.hpp"
#include "range_options.hpp"

namespace condyle::cli {
namespace {

struct SweepArguments : JointArguments {
  std::string vary, targets, shard;
  BestDesign best_by = BestDesign::largest_margin;
  std::vector<std::string> measures;
  StudyLoadArguments load;
  RangeArguments range;
};

SweepShare share_of(const std::string& text) {
  if (text.empty()) return {};
  const io::Shard shard = io::Shard::parse(text);
  return {shard.number, shard.of};
}

/// Further quantities of each design.
void add_quantities(const SweepArguments& options, const io::LoadedJoint& loaded, SweepRequest& request) {
  const std::vector<std::string> keys = names_in(options.measures);
  if (!keys.empty()) request.quantities.push_back(measured_quantities(keys, Case(loaded).measure_options()));
  if (options.load.pose) {
    request.quantities.push_back(
        io::load_quantities(loaded, study_load_of(options.load, loaded.joint.anatomy)));
  } else if (options.load.any_beside()) {
    throw UsageError("--force, --e and all else on a load: needs --load");
  }
}

void sweep_command(const SweepArguments& options, const CLI::App& command) {
  const io::InputRecorder read;
  const io::LoadedJoint loaded = joint_of(options);
  const std::string targets = io::read_whole_file(options.targets);
  RangeRequest range = range_request_of(options.range, loaded, {});
  SweepRequest request{.parameters = plan::parse_sweep(options.vary),
                       .targets = io::parse_targets(targets, options.targets, Case(loaded).motions(),
                                                    loaded.joint.kind, loaded.joint.anatomy),
                       .range = range.range,
                       .bands = range.bands,
                       .share = share_of(options.shard),
                       .best_by = options.best_by};
  add_quantities(options, loaded, request);
  if (request.share.of > 1 && options.out.empty())
    throw UsageError("--shard: needs --out, where its results lie");
  io::name_joint_file(options.joint, [&] { check_sweep(loaded, request); });
  const std::vector<JointNote> notes = noted(loaded, options.strictness);
  io::Provenance from = provenance_of(options, loaded, command, {options.targets});
  const std::string asked = io::sweep_options(from.command, read.inputs());
  const std::filesystem::path folder = io::sweep_folder(options.out, request.share);
  std::optional<io::SweepResult> result;
  if (!options.out.empty()) {
    io::check_sweep_folder(folder, &from);
    result = io::sweep_there(folder, asked, request.share);
  }
  if (result) {
    note("is there already, of the same inputs, options and version");
  } else {
    SweepAnswer answer =
        answered(options, [&](const Control& control) { return answer_sweep(loaded, request, control); });
    if (const auto why = read.passing_failure()) throw FileError(*why);
    io::add_other_files(from, read);
    result = io::sweep_result_of(loaded, std::move(answer), notes, &from);
    const io::SweepKey key = io::sweep_key(asked, io::sweep_inputs(read));
    if (!options.out.empty()) say_written(io::write_sweep(folder, *result, key, &from));
  }
  note_all(result->answer.limit_notes);
  note_all(result->answer.notes);
  print(options.form == AnswerForm::json ? io::sweep_json(*result) : io::sweep_text(*result));
}

}  // namespace

void add_sweep(CLI::App& app) {
  auto* command = app.add_subcommand(
      "sweep",
      "Compute limits over values of parameters of parts, and which designs leave target motions free");
  command->footer(
      "Example: condyle sample replacement --out thr\n"
      "         printf 'name,motion,reach_deg\\nsitting,flexion,110\\npivoting,external_rotation,40\\n' > "
      "daily.csv\n"
      "         condyle sweep thr/hip.toml --vary \"cup.inclination=30:50:1 cup.anteversion=0:30:1\" "
      "--targets "
      "daily.csv --out zone\n"
      "         python3 -m condyle.plot zone\n"
      "A share that was done before with the same inputs, options and version is not done again; condyle "
      "merge puts shares "
      "together.");
  auto options = std::make_shared<SweepArguments>();
  add_joint(*command, *options, "The joint file, .toml, with [[part]]");
  add_value(*command, "--vary", options->vary, "PART.PARAMETER=FIRST:LAST:STEP ...",
            "One to four parameters with their first and last value and a step: \"cup.inclination=30:50:1 "
            "cup.anteversion=0:30:1\"")
      ->required();
  add_value(*command, "--targets", options->targets, "FILE",
            "A CSV file with a row for each motion that must be free: name, motion (or start and movement), "
            "reach_deg, pelvic_tilt_deg of the posture, and weight, by which its margin is divided where the "
            "best "
            "design is chosen")
      ->required();
  add_out(*command, options->out,
          "Write sweep.json, designs.csv, safe.csv and zone.vtp into this folder. python3 -m condyle.plot "
          "FOLDER draws them");
  add_choice(*command, "--best", options->best_by,
             {{"largest-margin", BestDesign::largest_margin}, {"least-change", BestDesign::least_change}},
             "Call the design best that leaves most margin, or the safe one nearest to the joint as it is",
             "largest-margin");
  add_value(*command, "--shard", options->shard, "i/N",
            "Compute only part i of N of the designs, into FOLDER/shards. condyle merge puts the "
            "parts together");
  add_value(*command, "--measures", options->measures, "KEY[,KEY...]",
            "Measure the shape of each design's hip too, by keys of condyle measure: "
            "centre_edge_lateral_section_deg,...")
      ->expected(1)
      ->take_all();
  add_value(*command, "--load", options->load.pose, "POSE",
            "Compute contact pressure of each design in this pose too (\"\" is the reference pose), "
            "with the layers "
            "of the joint file or those of --e, --nu and --thickness");
  add_study_load(*command, options->load, "With --load: ");
  add_band(*command, options->range);
  add_bearing(*command, options->range);
  add_accept(*command, options->range);
  add_json(*command, options->form, "Print the answer as JSON, without the designs, which --out writes");
  add_strict(*command, options->strictness);
  group_help(*command, {{"Most used", {"--vary", "--targets", "--out", "--band", "--shard"}},
                        {"Question", {"--set", "--best", "--measures", "--load", "--force", "--along"}},
                        {"Contact",
                         {"--bearing", "--accept-reference-contact", "--e", "--nu", "--thickness", "--law",
                          "--casting", "--rule", "--reach"}},
                        uncertainty_group(),
                        {"Output", {"--json", "--strict", "--help"}}});
  command->callback([options, command] { sweep_command(*options, *command); });
}

}  // namespace condyle::cli
