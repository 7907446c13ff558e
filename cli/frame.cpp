#include <memory>
#include <optional>
#include <vector>

#include "commands.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "io/result/frame_result.hpp"
#include "joint_command.hpp"

namespace condyle::cli {
namespace {

struct FrameArguments : JointArguments {
  std::string motion;
};

void frame_command(const FrameArguments& options, const CLI::App& command) {
  const io::LoadedJoint joint = joint_of(options);
  const std::vector<JointNote> notes = noted(joint, options.strictness);
  std::optional<io::FunctionalFrame> by_motion;
  if (!options.motion.empty()) by_motion = io::functional_frame(joint, io::read_motion_table(options.motion));
  const io::Provenance from = provenance_of(options, joint, command, {options.motion});
  const io::FunctionalFrame* const by = by_motion ? &*by_motion : nullptr;
  print(options.form == AnswerForm::json ? io::frame_json(joint, notes, &from, by) : io::to_text(joint, by));
}

}  // namespace

void add_frame(CLI::App& app) {
  auto* command =
      app.add_subcommand("frame", "Show the frame of a joint: centre, axes, fit, and what was converted");
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle frame sample/hip.toml --json --strict");
  auto options = std::make_shared<FrameArguments>();
  add_joint(*command, *options);
  add_value(*command, "--from-motion", options->motion, "FILE",
            "Find where a recorded motion turns the joint: the centre of a ball, the axis of others, from "
            "matrices of both bodies, which [recorded_motion] names");
  add_json(*command, options->form);
  add_strict(*command, options->strictness);
  command->callback([options, command] { frame_command(*options, *command); });
}

}  // namespace condyle::cli
