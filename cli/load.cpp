#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "choice.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "contact_options.hpp"
#include "io/result/load_result.hpp"
#include "joint_command.hpp"

namespace condyle::cli {
namespace {

struct LoadArguments : JointArguments {
  std::string pose;
  std::optional<std::string> about;
  io::ContactChanges contact;
  BalanceArguments balance;
};

void load_command(const LoadArguments& options, const CLI::App& command) {
  const io::InputRecorder read;
  const io::LoadedJoint loaded = joint_of(options);
  const Joint& joint = loaded.joint;
  const io::PoseArgument given = io::given_pose(options.pose, joint);
  for (const std::string& remark : given.notes) note(remark);
  io::Provenance from = provenance_of(options, loaded, command);
  if (!options.out.empty()) io::check_load_folder(options.out, &from);
  const io::ContactEntry contact = contact_of(options.contact, loaded.report.file, true);
  const io::ContactSurfaces surfaces = io::surfaces_of(contact, joint);
  LoadRequest request{.X_FM = given.X_FM, .names = {surfaces.fixed.name, surfaces.mobile.name}};
  require_load(options.balance, options.balance.any());
  if (options.balance.any()) request.load = load_of(options.balance);
  if (request.load) request.balance = balance_options_of(options.balance, joint);
  if (options.about)
    request.about = io::arcs_about(*options.about, joint.anatomy), request.system = joint.coordinates();
  const io::LoadQuestion question{
      joint, given.pose, given.X_FM, surfaces, contact, request.load, noted(loaded, options.strictness),
      &from};
  const contact::ElasticContact layers(surfaces.fixed.mesh, surfaces.mobile.mesh,
                                       io::elastic_options(contact, surfaces, loaded));
  io::add_other_files(from, read);
  const LoadAnswer answer = answered(options, [&] {
    const auto limits = limits_of_poses(joint);
    request.limits = limits.get();
    return answer_load(layers, request);
  });
  note_contact(answer.notes, loaded, options.strictness);
  if (!answer.carries_load()) throw UsageError("--force: " + contact::reason_of(*answer.balanced));
  if (!options.out.empty()) say_written(io::write_load(options.out, question, answer, options.vtp_encoding));
  print(options.form == AnswerForm::json ? io::load_json(question, answer) : io::load_text(question, answer));
}

}  // namespace

void add_load(CLI::App& app) {
  auto* command = app.add_subcommand(
      "load", "Compute contact pressure in one pose, and the pose in which the contact carries a load");
  command->footer(
      "Example: condyle sample cartilages --scenario 7 --out sample\n"
      "         condyle load sample/cartilages.toml --e 12 --nu 0.42 --thickness 1.5 --force 0 1500 -200");
  auto options = std::make_shared<LoadArguments>();
  add_joint(*command, *options);
  add_value(*command, "--pose", options->pose, "POSE (all 0)",
            "Compute in this pose, or start from it: angles in degrees and, of a free joint, x, y, z in mm, "
            "such as \"flexion=30 x=2\"; or 16 numbers, the matrix X_FM row by row");
  add_value(*command, "--about", options->about, "ANGLE|AXIS [POINT]",
            "Give depths along arcs about this angle's axis, or about an axis, too, as condyle depth");
  add_rays(*command, options->contact);
  add_layers(*command, options->contact);
  add_balance(*command, options->balance);
  add_out(*command, options->out, "Write fixed.vtp, mobile.vtp and load.json into this folder");
  add_where(*command, *options);
  add_json(*command, options->form);
  add_strict(*command, options->strictness, or_contact);
  group_help(
      *command,
      {{"Most used", {"--pose", "--force", "--e", "--nu", "--thickness"}},
       {"Question",
        {"--set", "--moment", "--force-frame", "--along", "--free-rotations", "--ligaments", "--about"}},
       {"Contact", {"--law", "--casting", "--rule", "--reach"}},
       {"Output", {"--out", "--json", "--frame", "--ascii", "--strict", "--help"}}});
  command->callback([options, command] { load_command(*options, *command); });
}

}  // namespace condyle::cli
