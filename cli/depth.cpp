#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <string>

#include "answer.hpp"
#include "condyle/contact/joint_contact.hpp"
#include "condyle/core/error.hpp"
#include "condyle/io/depth_result.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/output_folder.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/whole_file.hpp"
#include "condyle/mesh/require_solid.hpp"
#include "verbs.hpp"

namespace condyle::cli {
namespace {

enum class Method { radial, tangential };
enum class Scope { vertices_and_pairs, pairs_only };

struct Options {
  std::string joint, pose, out;
  Method method = Method::radial;
  JointAngle about = JointAngle::flexion;
  Scope scope = Scope::vertices_and_pairs;
  AnswerForm form = AnswerForm::text;
};

void write_results(const Options& options, const DepthQuestion& question, const RadialContact& contact) {
  OutputFolder out(options.out);
  const InContact in_contact = contact_arrays(question.joint, contact.pairs);
  write_vtp(out.file("fixed.vtp"), question.joint.fixed.mesh, depth_arrays(contact.fixed_in_mobile),
            {&in_contact.fixed, 1});
  write_vtp(out.file("mobile.vtp"), posed(question.X_FM, question.joint.mobile.mesh),
            depth_arrays(contact.mobile_in_fixed), {&in_contact.mobile, 1});
  write_whole_file(out.file("pairs.csv"), pairs_csv(contact.pairs));
  write_whole_file(out.file("depth.json"), depth_json(question, contact));
  out.commit();
}

void run(const Options& options) {
  const LoadedJoint loaded = read_joint(options.joint);
  const Joint& joint = loaded.joint;
  const JointAngles angles = parse_pose(options.pose, joint.kind);
  if (options.scope == Scope::vertices_and_pairs) {
    require_solid(joint.fixed.mesh, loaded.report.fixed.mesh.string());
    require_solid(joint.mobile.mesh, loaded.report.mobile.mesh.string());
  }
  const DepthQuestion question{joint, angles, pose_at(joint.side, angles)};
  const RadialContact contact = JointContact(joint.fixed.mesh, joint.mobile.mesh).radial(question.X_FM);
  if (!options.out.empty()) write_results(options, question, contact);
  print(options.form == AnswerForm::json ? depth_json(question, contact) : depth_text(question, contact));
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
