#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <string>
#include <vector>

#include "answer.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "io/result/frame_result.hpp"
#include "notes.hpp"
#include "set_option.hpp"

namespace condyle::cli {
namespace {

struct FrameArguments {
  ParameterArguments parameters;
  std::string joint;
  Strictness strictness = Strictness::notes;
  AnswerForm form = AnswerForm::text;
};

void frame_command(const FrameArguments& options, const CLI::App& command) {
  const io::LoadedJoint joint = joint_at(io::read_joint(options.joint), options.parameters);
  const std::vector<JointNote> notes = noted(joint, options.strictness);
  const io::Provenance from = io::provenance_of(joint, words_of(command));
  print(options.form == AnswerForm::json ? io::frame_json(joint, notes, &from) : io::to_text(joint));
}

}  // namespace

void add_frame(CLI::App& app) {
  auto* command =
      app.add_subcommand("frame", "Show the frame of a joint: centre, axes, fit, and what was converted");
  command->footer("Example: condyle frame right_hip.toml --json --strict");
  auto options = std::make_shared<FrameArguments>();
  options->parameters = add_set(*command);
  command->add_option("JOINT", options->joint, "The joint file, .toml")->required();
  command->add_flag_callback(
      "--json", [options] { options->form = AnswerForm::json; },
      "Print the answer as JSON, with every number in full");
  add_strict(*command, options->strictness);
  command->callback([options, command] { frame_command(*options, *command); });
}

}  // namespace condyle::cli
