#include <memory>
#include <vector>

#include "commands.hpp"
#include "io/result/frame_result.hpp"
#include "joint_command.hpp"

namespace condyle::cli {
namespace {

void frame_command(const JointArguments& options, const CLI::App& command) {
  const io::LoadedJoint joint = joint_of(options);
  const std::vector<JointNote> notes = noted(joint, options.strictness);
  const io::Provenance from = provenance_of(options, joint, command);
  print(options.form == AnswerForm::json ? io::frame_json(joint, notes, &from) : io::to_text(joint));
}

}  // namespace

void add_frame(CLI::App& app) {
  auto* command =
      app.add_subcommand("frame", "Show the frame of a joint: centre, axes, fit, and what was converted");
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle frame sample/hip.toml --json --strict");
  auto options = std::make_shared<JointArguments>();
  add_joint(*command, *options);
  add_json(*command, options->form);
  add_strict(*command, options->strictness);
  command->callback([options, command] { frame_command(*options, *command); });
}

}  // namespace condyle::cli
