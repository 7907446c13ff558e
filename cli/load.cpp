#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/load_result.hpp"
#include "contact_options.hpp"
#include "notes.hpp"

namespace condyle::cli {
namespace {

struct Options {
  std::string joint, pose, out;
  std::shared_ptr<ContactChanges> contact = std::make_shared<ContactChanges>();
  std::shared_ptr<BalanceGiven> balance = std::make_shared<BalanceGiven>();
  Strictness strictness = Strictness::notes;
  std::shared_ptr<WhereOptions> where = std::make_shared<WhereOptions>();
  AnswerForm form = AnswerForm::text;
};

LoadAnswer answer_of(const ElasticContact& surfaces, const LoadQuestion& question,
                     const BalanceGiven& given) {
  LoadAnswer answer{question.X_FM, {}};
  if (question.load) {
    answer.balanced = balance(surfaces, question.X_FM, *question.load, balance_options_of(given));
    if (!answer.balanced->carries_load()) throw UsageError("--force: " + reason_of(*answer.balanced));
    answer.X_FM = answer.balanced->X_FM;
    answer.contact = answer.balanced->contact;
  } else {
    answer.contact = surfaces.at(question.X_FM);
  }
  answer.cut_off_by_reach = surfaces.cut_off_by_reach(answer.X_FM);
  answer.refined_force_n = surfaces.refined_force_n(answer.X_FM);
  return answer;
}

void run(const Options& options, const CLI::App& command) {
  const LoadedJoint loaded = read_joint(options.joint);
  const Joint& joint = loaded.joint;
  const GivenPose given = given_pose(options.pose, joint);
  for (const std::string& remark : given.notes) note(remark);
  const Provenance from = provenance_of(loaded, words_of(command), options.where->frame);
  if (!options.out.empty()) check_load_folder(options.out, &from);
  const ContactEntry contact = contact_of(*options.contact, loaded.report.file, true);
  const ContactSurfaces surfaces = surfaces_of(contact, joint);
  LoadQuestion question{
      joint, given.pose, given.X_FM, surfaces, contact, {}, noted(loaded, options.strictness), &from};
  if (options.balance->any()) question.load = load_of(*options.balance);
  const ElasticContact layers(surfaces.fixed.mesh, surfaces.mobile.mesh,
                              elastic_options(contact, surfaces, loaded));
  const BodyNames names{surfaces.fixed.name, surfaces.mobile.name};
  std::vector<ContactNote> notes;
  note_contact(notes, check_layers(layers, names), loaded, options.strictness);
  if (question.load) note_contact(notes, check_load(*question.load), loaded, options.strictness);
  LoadAnswer answer = answer_of(layers, question, *options.balance);
  note_contact(notes, check_contact(answer.contact, names), loaded, options.strictness);
  answer.notes = std::move(notes);
  if (!options.out.empty())
    say_written(write_load(options.out, question, answer, options.where->vtp_encoding));
  print(options.form == AnswerForm::json ? load_json(question, answer) : load_text(question, answer));
}

}  // namespace

void add_load(CLI::App& app) {
  auto* command = app.add_subcommand(
      "load", "Contact pressure in one pose, and the pose in which the contact carries a load");
  command->footer(
      "Example: condyle sample cartilages --scenario 7 --out sample\n"
      "         condyle load sample/cartilages.toml --e 12 --nu 0.42 --thickness 1.5 --force 0 1500 -200");
  auto options = std::make_shared<Options>();
  command->add_option("JOINT", options->joint, "Joint file (TOML)")->required();
  command->add_option(
      "--pose", options->pose,
      "Angles in degrees and, of a free joint, x, y, z in mm, such as \"flexion=30 x=2\"; or 16 numbers, the "
      "matrix X_FM row by row");
  add_rays(*command, options->contact);
  add_layers(*command, options->contact);
  add_balance(*command, options->balance);
  command->add_option("--out", options->out, "Folder for fixed.vtp, mobile.vtp and load.json");
  add_where(*command, options->where);
  command->add_flag_callback(
      "--json", [options] { options->form = AnswerForm::json; }, "Answer in JSON");
  add_strict(*command, options->strictness);
  command->callback([options, command] { run(*options, *command); });
}

}  // namespace condyle::cli
