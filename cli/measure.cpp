#include <memory>
#include <vector>

#include "choice.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "io/result/measure_result.hpp"
#include "joint_command.hpp"
#include "range_options.hpp"

namespace condyle::cli {
namespace {

struct MeasureArguments : JointArguments {
  double tilt_deg = 0;
  RangeArguments range;
  bool definitions = false;
};

void measure_command(const MeasureArguments& options, const CLI::App& command) {
  const io::LoadedJoint loaded = joint_of(options);
  const std::vector<JointNote> notes = noted(loaded, options.strictness);
  const io::Provenance from = provenance_of(options, loaded, command);
  if (!options.out.empty()) io::check_measure_folder(options.out, &from);
  const MeasureRequest request{Angle::degrees(options.tilt_deg), band_of(options.range)};
  const MeasureAnswer answer =
      answered(options, [&](const Control& control) { return answer_measures(loaded, request, control); });
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
  add_joint(*command, *options);
  add_value(*command, "--tilt", options->tilt_deg, "DEG (0)",
            "Tilt the pelvis forwards by this before acetabular angles are measured, -60 to 60");
  add_band(*command, options->range);
  add_out(*command, options->out, "Write measures.json, measures.csv, neck.csv and rim.csv into this folder");
  command->add_flag(
      "--definitions", options->definitions,
      "Print the definition of each measure, its planes and axes, and the source of its normal range");
  add_json(*command, options->form);
  add_strict(*command, options->strictness);
  group_help(*command, {{"Most used", {"--band", "--tilt", "--out", "--json", "--strict"}},
                        {"Question", {"--set", "--definitions"}},
                        uncertainty_group(),
                        {"Output", {"--help"}}});
  command->callback([options, command] { measure_command(*options, *command); });
}

}  // namespace condyle::cli
