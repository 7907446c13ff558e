#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <string>
#include <vector>

#include "answer.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "help_formatter.hpp"
#include "io/joint/name_joint_file.hpp"
#include "io/result/measure_result.hpp"
#include "notes.hpp"
#include "range_options.hpp"
#include "set_option.hpp"
#include "with_progress.hpp"

namespace condyle::cli {
namespace {

struct MeasureArguments {
  ParameterArguments parameters;
  std::string joint, out;
  double tilt_deg = 0;
  std::shared_ptr<RangeArguments> range = std::make_shared<RangeArguments>();
  bool definitions = false;
  Strictness strictness = Strictness::notes;
  AnswerForm form = AnswerForm::text;
};

void measure_command(const MeasureArguments& options, const CLI::App& command) {
  const io::LoadedJoint loaded = joint_at(io::read_joint(options.joint), options.parameters);
  const std::vector<JointNote> notes = noted(loaded, options.strictness);
  const io::Provenance from = io::provenance_of(loaded, words_of(command));
  if (!options.out.empty()) io::check_measure_folder(options.out, &from);
  const MeasureRequest request{Angle::degrees(options.tilt_deg), band_of(*options.range)};
  const MeasureAnswer answer = io::name_joint_file(options.joint, [&] {
    return with_progress([&](const Control& control) { return answer_measures(loaded, request, control); });
  });
  const io::MeasureResult result{loaded.joint, answer, notes, &from};
  if (!options.out.empty()) say_written(io::write_measures(options.out, result));
  print(options.form == AnswerForm::json ? io::measure_json(result)
                                         : io::measure_text(result, options.definitions));
}

}  // namespace

void add_measure(CLI::App& app) {
  auto* command = app.add_subcommand(
      "measure", "Measure the shape of a hip: alpha angles, versions, centre-edge angles, coverage");
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle measure sample/hip.toml\n"
      "A measure that the meshes do not show is empty, with the reason.");
  auto options = std::make_shared<MeasureArguments>();
  options->parameters = add_set(*command);
  command->add_option("JOINT", options->joint, "The joint file, .toml")->required();
  command
      ->add_option("--tilt", options->tilt_deg,
                   "Tilt the pelvis forwards by this before acetabular angles are measured, -60 to 60")
      ->option_text("DEG (0)");
  add_band(*command, options->range);
  command
      ->add_option("--out", options->out,
                   "Write measures.json, measures.csv, neck.csv and rim.csv into this folder")
      ->option_text("FOLDER");
  command->add_flag(
      "--definitions", options->definitions,
      "Print the definition of each measure, its planes and axes, and the source of its normal range");
  command->add_flag_callback(
      "--json", [options] { options->form = AnswerForm::json; },
      "Print the answer as JSON, with every number in full");
  add_strict(*command, options->strictness);
  group_help(*command, {{"Most used", {"--band", "--tilt", "--out", "--json", "--strict"}},
                        {"Question", {"--set", "--definitions"}},
                        uncertainty_group(),
                        {"Output", {"--help"}}});
  command->callback([options, command] { measure_command(*options, *command); });
}

}  // namespace condyle::cli
