#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <string>

#include "answer.hpp"
#include "condyle/error.hpp"
#include "condyle/io/depth_result.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/output_folder.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/whole_file.hpp"
#include "condyle/contact.hpp"
#include "mesh/require_solid.hpp"
#include "verbs.hpp"

namespace condyle::cli {
namespace {

enum class Method { radial, tangential };
enum class Scope { vertices_and_pairs, pairs_only };

struct Options {
  std::string joint, pose, out;
  Method method = Method::radial;
  std::string about = "flexion";
  Scope scope = Scope::vertices_and_pairs;
  AnswerForm form = AnswerForm::text;
};

/// What both methods give: texts, and arrays for each body.
struct Answer {
  std::string text, json;
  std::vector<MeshArray> fixed_arrays, mobile_arrays;
  std::vector<TrianglePair> pairs;
};

Answer by_radial(const DepthQuestion& question, const JointContact& contact) {
  RadialContact found = contact.radial(question.X_FM);
  const RadialSummary summary = summarise(contact, question.X_FM, found);
  return {depth_text(question, found, summary), depth_json(question, found, summary),
          depth_arrays(found.fixed_in_mobile), depth_arrays(found.mobile_in_fixed), std::move(found.pairs)};
}

Answer by_tangential(const DepthQuestion& question, const JointContact& contact, JointAngle about) {
  const TurnAxis axis{about, axis_of(about, question.joint.side, question.angles)};
  TangentialContact found = contact.tangential(question.X_FM, axis.direction_F);
  return {depth_text(question, axis, found), depth_json(question, axis, found),
          depth_arrays(found.fixed_in_mobile), depth_arrays(found.mobile_in_fixed), std::move(found.pairs)};
}

void write_results(const std::string& folder, const DepthQuestion& question, const Answer& answer) {
  OutputFolder out(folder);
  const InContact in_contact = contact_arrays(question.joint, answer.pairs);
  write_vtp(out.file("fixed.vtp"), question.joint.fixed.mesh, answer.fixed_arrays, {&in_contact.fixed, 1});
  write_vtp(out.file("mobile.vtp"), posed(question.X_FM, question.joint.mobile.mesh), answer.mobile_arrays,
            {&in_contact.mobile, 1});
  write_whole_file(out.file("pairs.csv"), pairs_csv(answer.pairs));
  write_whole_file(out.file("depth.json"), answer.json);
  out.commit();
}

void require_solids(const LoadedJoint& loaded) {
  try {
    mesh::require_solid(loaded.joint.fixed.mesh, loaded.report.fixed.mesh.string());
    mesh::require_solid(loaded.joint.mobile.mesh, loaded.report.mobile.mesh.string());
  } catch (const MeshError& error) {
    throw MeshError(std::string(error.what()) + " (--pairs-only accepts such meshes)");
  }
}

void run(const Options& options) {
  const LoadedJoint loaded = read_joint(options.joint);
  const Joint& joint = loaded.joint;
  const JointAngles angles = parse_pose(options.pose, joint.kind);
  if (options.scope == Scope::vertices_and_pairs) require_solids(loaded);
  const DepthQuestion question{joint, angles, pose_at(joint.side, angles)};
  const JointContact contact(joint);
  const Answer answer = options.method == Method::radial
                            ? by_radial(question, contact)
                            : by_tangential(question, contact, joint_angle_named(options.about));
  if (!options.out.empty()) write_results(options.out, question, answer);
  print(options.form == AnswerForm::json ? answer.json : answer.text);
}

}  // namespace

void add_depth(CLI::App& app) {
  auto* verb = app.add_subcommand("depth", "Where and how deep two bones penetrate each other in one pose");
  verb->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle depth sample/hip.toml --pose \"flexion=110 adduction=10 internal_rotation=30\" --out "
      "deep");
  auto options = std::make_shared<Options>();
  verb->add_option("JOINT", options->joint, "Joint file (TOML)")->required();
  verb->add_option(
      "--pose", options->pose,
      "Angles in degrees, such as \"flexion=90 adduction=-10 internal_rotation=20\"; those left out are 0");
  verb->add_option_function<std::string>(
          "--method",
          [options](const std::string& name) {
            options->method = name == "radial" ? Method::radial : Method::tangential;
          },
          "radial: along rays from the centre; tangential: along arcs about an axis")
      ->check(CLI::IsMember({"radial", "tangential"}))
      ->option_text("radial|tangential (radial)");
  verb->add_option("--about", options->about, "The angle whose axis the tangential method turns about")
      ->option_text("flexion|adduction|internal_rotation (flexion)");
  verb->add_option(
      "--out", options->out,
      "Folder for fixed.vtp, mobile.vtp (both in the fixed body's joint frame), pairs.csv and depth.json");
  verb->add_flag_callback(
      "--pairs-only", [options] { options->scope = Scope::pairs_only; },
      "Accept open meshes: intersecting triangle pairs, and vertices only against a body that is closed");
  verb->add_flag_callback(
      "--json", [options] { options->form = AnswerForm::json; }, "Answer in JSON");
  verb->callback([options] { run(*options); });
}

}  // namespace condyle::cli
