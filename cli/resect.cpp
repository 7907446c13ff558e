#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answer.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "followed.hpp"
#include "help_formatter.hpp"
#include "io/joint/name_joint_file.hpp"
#include "io/mesh/vertex_marks.hpp"
#include "io/result/resection_result.hpp"
#include "notes.hpp"
#include "range.hpp"
#include "range_options.hpp"

namespace condyle::cli {
namespace {

struct Options {
  std::string joint, out, reach, protect_mobile, protect_fixed;
  std::string from = "mobile";
  std::optional<double> share, deepest_mm, within_mm, burr_mm;
  double margin_mm = 0, edge_mm = ResectionRequest{}.edge_mm;
  std::size_t curve_points = ResectionQuery{}.curve_points;
  std::shared_ptr<RangeGiven> range = std::make_shared<RangeGiven>();
  Strictness strictness = Strictness::notes;
  AnswerForm form = AnswerForm::text;
};

/// The share of the fixed body.
double fixed_share(const Options& options) {
  if (options.share && options.from != "both") throw UsageError("--share: only with --from both");
  if (options.from == "both") return options.share.value_or(0.5);
  return options.from == "fixed" ? 1 : 0;
}

KeptBone kept(const Options& options, const std::string& protect, const Body& body) {
  KeptBone bone{options.deepest_mm, options.within_mm, {}};
  if (!protect.empty())
    bone.vertices = io::read_vertex_marks(protect, body.mesh.vertices().size(), body.name);
  return bone;
}

void run(const Options& options, const CLI::App& command) {
  const LoadedJoint loaded = read_joint(options.joint);
  const std::vector<JointNote> notes = noted(loaded, options.strictness);
  Provenance from = provenance_of(loaded, words_of(command));
  for (const std::string& marks : {options.protect_mobile, options.protect_fixed})
    if (!marks.empty()) from.read.emplace_back(marks);
  if (!options.out.empty()) check_resection_folder(options.out, &from);
  const std::vector<Motion> motions = motions_of(loaded);
  const RangeRequest range = range_request_of(*options.range, loaded, motions);
  ResectionQuery query;
  query.resection.targets = reach_targets(motions, options.reach);
  query.resection.fixed_share = fixed_share(options);
  query.resection.mobile = kept(options, options.protect_mobile, loaded.joint.mobile);
  query.resection.fixed = kept(options, options.protect_fixed, loaded.joint.fixed);
  query.resection.margin_mm = options.margin_mm;
  query.resection.burr_mm = options.burr_mm;
  query.resection.edge_mm = options.edge_mm;
  query.resection.range = range.range;
  query.motions = motions;
  query.bands = range.bands;
  query.curve_points = options.curve_points;
  query.measures.ischiofemoral_pose = loaded.report.placement.reference_pose.angles;
  const ResectionAnswer answer = io::name_joint_file(options.joint, [&] {
    return followed_by_stage([&](const AnswerControl& control) {
      return answer_resection(loaded.joint, loaded.report.placement, query, control);
    });
  });
  const ResectionResult result{loaded.joint, answer, notes, &from, &loaded.report.file};
  if (!options.out.empty()) say_written(write_resection(options.out, result));
  print(options.form == AnswerForm::json ? resection_json(result) : resection_text(result));
}

}  // namespace

void add_resect(CLI::App& app) {
  auto* command = app.add_subcommand(
      "resect", "Find the bone that must go so that motions reach their targets, and the joint without it");
  command->footer(
      "Example: condyle sample hip --alpha-angle 70 --out sample\n"
      "         condyle resect sample/hip.toml --reach \"internal_rotation_at_90_flexion=30\" --out plan\n"
      "         condyle rom plan/resected.toml\n"
      "Osseous: labrum, cartilage, capsule and the strength of the bone that is left are not modelled.");
  auto options = std::make_shared<Options>();
  command->add_option("JOINT", options->joint, "The joint file, .toml")->required();
  command
      ->add_option("--reach", options->reach,
                   "How far each motion shall go from its start, by its name in condyle rom --list-motions: "
                   "\"flexion=115 fadir=30\"")
      ->option_text("MOTION=DEG ...")
      ->required();
  command
      ->add_option("--from", options->from,
                   "The body that is cut: the moving one, the one that stays, as at a socket's rim, or both")
      ->option_text("mobile|fixed|both (mobile)")
      ->check(CLI::IsMember({"mobile", "fixed", "both"}));
  command
      ->add_option("--share", options->share,
                   "With --from both: the share of the depth that the fixed body is cut for, 0 to 1")
      ->option_text("SHARE (0.5)");
  command
      ->add_option("--margin", options->margin_mm,
                   "Keep what is left clear of the other bone's surface moved outwards by this, 0 to 10")
      ->option_text("MM (0)");
  command
      ->add_option("--burr", options->burr_mm,
                   "Leave what a ball of this diameter can make, 0.5 to 30: no groove is narrower, and what "
                   "goes only for that is said")
      ->option_text("MM");
  command->add_option("--deepest", options->deepest_mm, "Remove no more than this anywhere")
      ->option_text("MM");
  command
      ->add_option(
          "--within", options->within_mm,
          "Keep what is farther than this outside the ball of the bearing surface, the head's radius and "
          "margin: the head-neck junction is its border")
      ->option_text("MM");
  command
      ->add_option(
          "--protect", options->protect_mobile,
          "Keep these vertices of the moving body: a file with a line for each vertex of its mesh, 1 to keep "
          "it and 0 if it may go")
      ->option_text("FILE");
  command->add_option("--protect-fixed", options->protect_fixed, "The same of the body that stays")
      ->option_text("FILE");
  command->add_option("--edge", options->edge_mm, "Make triangles around the cut so small, 0.05 to 10")
      ->option_text("MM (0.5)");
  command
      ->add_option("--curve", options->curve_points,
                   "Points on the curve of degrees against mm3 for each target; 0 for none, each costs a cut")
      ->option_text("N (10)")
      ->check(CLI::Range(0, 1000));
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
             {{"Most used", {"--reach", "--out", "--from", "--band", "--json", "--strict"}},
              {"Bone that stays", {"--deepest", "--within", "--protect", "--protect-fixed", "--margin"}},
              {"Contact", {"--bearing", "--accept-reference-contact"}},
              uncertainty_group(),
              {"Cut", {"--share", "--burr", "--edge", "--curve"}},
              {"Output", {"--help"}}});
  command->callback([options, command] { run(*options, *command); });
}

}  // namespace condyle::cli
