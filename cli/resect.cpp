#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "choice.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "interrupt.hpp"
#include "io/mesh/vertex_marks.hpp"
#include "io/result/resection_result.hpp"
#include "joint_command.hpp"
#include "range_options.hpp"
#include "resection_options.hpp"

namespace condyle::cli {
namespace {

struct ResectArguments : JointArguments {
  std::string protect_mobile, protect_fixed;
  std::size_t curve_points = ResectionRequest{}.curve_points;
  ResectionArguments cut;
  RangeArguments range;
};

std::vector<std::uint8_t> marks_in(const std::string& file, const Body& body) {
  if (file.empty()) return {};
  return io::read_vertex_marks(file, body.mesh.vertices().size(), body.name);
}

void resect_command(const ResectArguments& options, const CLI::App& command) {
  const io::InputRecorder read;
  const io::LoadedJoint loaded = joint_of(options);
  const std::vector<JointNote> notes = noted(loaded, options.strictness);
  io::Provenance from =
      provenance_of(options, loaded, command, {options.protect_mobile, options.protect_fixed});
  if (!options.out.empty()) io::check_resection_folder(options.out, &from);
  const std::vector<motion::Motion> motions = Case(loaded).motions();
  const RangeRequest range = range_request_of(options.range, loaded, motions);
  ResectionRequest request;
  request.resection = resection_request_of(options.cut);
  request.resection.targets = reach_targets(motions, options.cut.targets);
  request.resection.mobile.vertices = marks_in(options.protect_mobile, loaded.joint.mobile);
  request.resection.fixed.vertices = marks_in(options.protect_fixed, loaded.joint.fixed);
  request.resection.range = range.range;
  request.motions = motions;
  request.bands = range.bands;
  request.confidence = confidence_of(options.cut, range.bands);
  request.curve_points = options.curve_points;
  request.keep_if_stopped = true;
  const ResectionAnswer answer = answered(options, [&] {
    return with_progress([&](const Control& control) { return answer_resection(loaded, request, control); },
                         Writes::files);
  });
  io::add_other_files(from, read);
  note_all(answer.notes);
  note_all(answer.limit_notes);
  const io::ResectionResult result{loaded.joint, answer, notes, &from, &loaded.report.file};
  if (!options.out.empty()) say_written(io::write_resection(options.out, result));
  print(options.form == AnswerForm::json ? io::resection_json(result) : io::resection_text(result));
  if (std::any_of(answer.notes.begin(), answer.notes.end(),
                  [](const ResectionNote& note) { return note.code == ResectionNoteCode::stopped; }))
    throw Interrupted("interrupted; the answer is what there was until then");
}

}  // namespace

void add_resect(CLI::App& app) {
  auto* command = app.add_subcommand(
      "resect", "Find the bone that must go for motions to reach their targets, and the joint without it");
  command->footer(
      "Example: condyle sample hip --alpha-angle 70 --out sample\n"
      "         condyle resect sample/hip.toml --reach \"internal_rotation_at_90_flexion=45\" --out plan\n"
      "         condyle rom plan/resected.toml\n"
      "Osseous: labrum, cartilage, capsule and the strength of the remaining bone are not modelled.");
  auto options = std::make_shared<ResectArguments>();
  options->range.band.samples = BandRequest{}.samples;
  add_joint(*command, *options);
  CLI::Option* reach =
      add_value(*command, "--reach", options->cut.targets, "MOTION=DEG ...",
                "How far each motion shall go from its start, by its name in condyle rom "
                "--list-motions: \"flexion=115 fadir=30\"; with a plus how far beyond its limit now: "
                "\"fadir=+10\"")
          ->required();
  add_cut(*command, options->cut, reach);
  add_confidence(*command, options->cut)->excludes(command->get_option("--margin"));
  add_value(
      *command, "--protect", options->protect_mobile, "FILE",
      "Keep these vertices of the moving body: a file with a line for each vertex of its mesh, 1 to keep "
      "it and 0 if it may go");
  add_value(*command, "--protect-fixed", options->protect_fixed, "FILE", "The same for the fixed body");
  add_curve(*command, options->curve_points);
  add_band(*command, options->range, 0);
  add_bearing(*command, options->range);
  add_accept(*command, options->range);
  add_out(*command, options->out,
          "Write resection.json, limits.csv, curve.csv, hours.csv, the depth on the bones as .vtp, and "
          "resected.toml with its meshes into this folder");
  add_json(*command, options->form);
  add_strict(*command, options->strictness);
  group_help(*command,
             {{"Most used", {"--reach", "--out", "--confidence", "--from", "--json"}},
              {"Question", {"--set", "--band"}},
              {"Bone that stays", {"--deepest", "--within", "--protect", "--protect-fixed", "--margin"}},
              {"Contact", {"--bearing", "--accept-reference-contact"}},
              uncertainty_group(),
              {"Cut", {"--share", "--burr", "--edge", "--curve"}},
              {"Output", {"--strict", "--help"}}});
  command->callback([options, command] { resect_command(*options, *command); });
}

}  // namespace condyle::cli
