#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answer.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "help_formatter.hpp"
#include "io/file/input_recorder.hpp"
#include "io/joint/name_joint_file.hpp"
#include "io/mesh/vertex_marks.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/resection_result.hpp"
#include "notes.hpp"
#include "range_options.hpp"
#include "resection_options.hpp"
#include "set_option.hpp"
#include "whole_number.hpp"
#include "with_progress.hpp"

namespace condyle::cli {
namespace {

struct ResectArguments {
  ParameterArguments parameters;
  std::string joint, out, protect_mobile, protect_fixed;
  std::size_t curve_points = ResectionRequest{}.curve_points;
  std::shared_ptr<ResectionArguments> cut = std::make_shared<ResectionArguments>();
  std::shared_ptr<RangeArguments> range = std::make_shared<RangeArguments>();
  Strictness strictness = Strictness::notes;
  AnswerForm form = AnswerForm::text;
};

std::vector<std::uint8_t> marks_in(const std::string& file, const Body& body) {
  if (file.empty()) return {};
  return io::read_vertex_marks(file, body.mesh.vertices().size(), body.name);
}

void resect_command(const ResectArguments& options, const CLI::App& command) {
  const io::InputRecorder read;
  const io::LoadedJoint loaded = joint_at(io::read_joint(options.joint), options.parameters);
  const std::vector<JointNote> notes = noted(loaded, options.strictness);
  io::Provenance from = io::provenance_of(loaded, words_of(command));
  for (const std::string& marks : {options.protect_mobile, options.protect_fixed})
    if (!marks.empty()) from.read.emplace_back(marks);
  if (!options.out.empty()) io::check_resection_folder(options.out, &from);
  const std::vector<motion::Motion> motions = Case(loaded).motions();
  const RangeRequest range = range_request_of(*options.range, loaded, motions);
  ResectionRequest request;
  request.resection = resection_request_of(*options.cut);
  request.resection.targets = reach_targets(motions, options.cut->targets);
  request.resection.mobile.vertices = marks_in(options.protect_mobile, loaded.joint.mobile);
  request.resection.fixed.vertices = marks_in(options.protect_fixed, loaded.joint.fixed);
  request.resection.range = range.range;
  request.motions = motions;
  request.bands = range.bands;
  request.curve_points = options.curve_points;
  const ResectionAnswer answer = io::name_joint_file(options.joint, [&] {
    return with_progress([&](const Control& control) { return answer_resection(loaded, request, control); });
  });
  io::add_other_files(from, read);
  const io::ResectionResult result{loaded.joint, answer, notes, &from, &loaded.report.file};
  if (!options.out.empty()) say_written(io::write_resection(options.out, result));
  print(options.form == AnswerForm::json ? io::resection_json(result) : io::resection_text(result));
}

}  // namespace

void add_resect(CLI::App& app) {
  auto* command = app.add_subcommand(
      "resect", "Find the bone that must go for motions to reach their targets, and the joint without it");
  command->footer(
      "Example: condyle sample hip --alpha-angle 70 --out sample\n"
      "         condyle resect sample/hip.toml --reach \"internal_rotation_at_90_flexion=30\" --out plan\n"
      "         condyle rom plan/resected.toml\n"
      "Osseous: labrum, cartilage, capsule and the strength of the remaining bone are not modelled.");
  auto options = std::make_shared<ResectArguments>();
  options->parameters = add_set(*command);
  command->add_option("JOINT", options->joint, "The joint file, .toml")->required();
  CLI::Option* reach =
      command
          ->add_option("--reach", options->cut->targets,
                       "How far each motion shall go from its start, by its name in condyle rom "
                       "--list-motions: \"flexion=115 fadir=30\"")
          ->option_text("MOTION=DEG ...")
          ->required();
  add_cut(*command, options->cut, reach);
  command
      ->add_option(
          "--protect", options->protect_mobile,
          "Keep these vertices of the moving body: a file with a line for each vertex of its mesh, 1 to keep "
          "it and 0 if it may go")
      ->option_text("FILE");
  command->add_option("--protect-fixed", options->protect_fixed, "The same for the fixed body")
      ->option_text("FILE");
  command
      ->add_option("--curve", options->curve_points,
                   "Points on the curve of degrees against mm3 for each target; 0 for none, each costs a cut")
      ->option_text("N (10)")
      ->check(whole_number(0, 1000));
  add_band(*command, options->range);
  add_bearing(*command, options->range);
  add_accept(*command, options->range);
  command
      ->add_option(
          "--out", options->out,
          "Write resection.json, limits.csv, curve.csv, hours.csv, the depth on the bones as .vtp, and "
          "resected.toml with its meshes into this folder")
      ->option_text("FOLDER");
  command->add_flag_callback(
      "--json", [options] { options->form = AnswerForm::json; },
      "Print the answer as JSON, with every number in full");
  add_strict(*command, options->strictness);
  group_help(*command,
             {{"Most used", {"--reach", "--out", "--from", "--band", "--json"}},
              {"Question", {"--set"}},
              {"Bone that stays", {"--deepest", "--within", "--protect", "--protect-fixed", "--margin"}},
              {"Contact", {"--bearing", "--accept-reference-contact"}},
              uncertainty_group(),
              {"Cut", {"--share", "--burr", "--edge", "--curve"}},
              {"Output", {"--strict", "--help"}}});
  command->callback([options, command] { resect_command(*options, *command); });
}

}  // namespace condyle::cli
