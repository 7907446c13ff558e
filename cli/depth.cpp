#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "condyle/inspect.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "contact_options.hpp"
#include "help_formatter.hpp"
#include "io/file/input_recorder.hpp"
#include "io/file/whole_file.hpp"
#include "io/joint/name_joint_file.hpp"
#include "io/mesh/parse.hpp"
#include "io/result/depth_result.hpp"
#include "io/result/provenance_forms.hpp"
#include "mesh/require_solid.hpp"
#include "notes.hpp"
#include "set_option.hpp"

namespace condyle::cli {
namespace {

enum class Scope { vertices_and_pairs, pairs_only };

struct DepthArguments {
  ParameterArguments parameters;
  std::string joint, pose, matrix, out;
  DepthMethod method = DepthMethod::reliable;
  std::optional<std::string> about;
  std::shared_ptr<io::ContactChanges> rays = std::make_shared<io::ContactChanges>();
  io::VertexTables vertices = io::VertexTables::leave_out;
  Scope scope = Scope::vertices_and_pairs;
  Strictness strictness = Strictness::notes;
  std::shared_ptr<WhereOptions> where = std::make_shared<WhereOptions>();
  AnswerForm form = AnswerForm::text;
};

DepthRequest request_of(const DepthArguments& options, const io::PoseArgument& given,
                        const io::ContactEntry& entry, Anatomy joint) {
  DepthRequest request{.X_FM = given.X_FM, .pose = given.pose.angles(), .method = options.method};
  if (options.about) request.about = io::joint_angle_named(*options.about, joint);
  if (options.method == DepthMethod::normal) request.casting = entry.casting, request.rays = entry.rays;
  // Files have the nearest distance of every vertex.
  if (!options.out.empty()) request.distances = contact::DistancesOf::all_vertices;
  return request;
}

/// By its coordinates, as a matrix, or as a matrix in a file.
io::PoseArgument pose_of(const DepthArguments& options, const Joint& joint) {
  if (options.matrix.empty()) return io::given_pose(options.pose, joint);
  const std::string bytes = io::read_whole_file(options.matrix);
  const std::string text = io::without_comments({bytes, options.matrix});
  try {
    if (!io::is_matrix(text)) throw UsageError("pose: a matrix begins with a number");
    return io::given_pose(text, joint);
  } catch (const UsageError& error) {
    throw FileError(fmt::format("{}: {}", options.matrix, error.what()));
  }
}

std::string files_of(const std::vector<io::BodyMeshReport>& meshes) {
  std::string files;
  for (const io::BodyMeshReport& mesh : meshes) files += (files.empty() ? "" : " + ") + mesh.mesh.string();
  return files;
}

/// Whether the meshes allow the question: solids for vertices inside, outer sides for normals, nothing for pairs.
void require_meshes(const io::LoadedJoint& loaded, const DepthArguments& options) {
  const auto require = [&](const Mesh& mesh, const std::vector<io::BodyMeshReport>& reports) {
    if (options.method == DepthMethod::normal) return mesh::require_oriented(mesh, files_of(reports));
    if (options.scope == Scope::pairs_only) return;
    try {
      mesh::require_solid(mesh, files_of(reports));
    } catch (const MeshError& error) {
      const bool is_oriented = !mesh.is_closed() && inspect(mesh).inconsistent_edges.count == 0;
      throw MeshError(std::string(error.what()) +
                      (is_oriented ? " (--method normal or --pairs-only accept such meshes)"
                                   : " (--pairs-only accepts such meshes)"));
    }
  };
  require(loaded.joint.fixed.mesh, loaded.report.fixed);
  require(loaded.joint.mobile.mesh, loaded.report.mobile);
}

/// The joint with the parts that cast and are cast at in the place of bodies of several.
Joint joint_of_surfaces(const io::ContactEntry& entry, Joint joint) {
  io::ContactSurfaces surfaces = io::surfaces_of(entry, joint);
  if (!entry.fixed_part.empty()) joint.fixed = std::move(surfaces.fixed);
  if (!entry.mobile_part.empty()) joint.mobile = std::move(surfaces.mobile);
  return joint;
}

void depth_command(const DepthArguments& options, const CLI::App& command) {
  const bool by_normals = options.method == DepthMethod::normal;
  if (options.rays->any_of_rays() && !by_normals)
    throw UsageError("--casting, --rule, --reach: are for --method normal");
  const io::InputRecorder read;
  const io::LoadedJoint loaded = joint_at(io::read_joint(options.joint), options.parameters);
  const io::ContactEntry entry = contact_of(*options.rays, loaded.report.file, false);
  const Joint joint = by_normals ? joint_of_surfaces(entry, loaded.joint) : loaded.joint;
  const io::PoseArgument given = pose_of(options, joint);
  const DepthRequest request = request_of(options, given, entry, joint.anatomy);
  check_depth_request(joint, request);
  for (const std::string& remark : given.notes) note("pose: " + remark);
  require_meshes(loaded, options);
  io::Provenance from = io::provenance_of(loaded, words_of(command), options.where->frame);
  if (!options.matrix.empty()) from.read.emplace_back(options.matrix);
  if (!options.out.empty()) io::check_depth_folder(options.out, &from);
  const io::DepthQuestion question{.joint = joint,
                                   .pose = given.pose,
                                   .X_FM = given.X_FM,
                                   .notes = noted(loaded, options.strictness),
                                   .provenance = &from};
  io::add_other_files(from, read);
  const DepthAnswer answer = io::name_joint_file(options.joint, [&] { return answer_depth(joint, request); });
  const io::DepthResult result = io::depth_result(question, answer);
  if (!options.out.empty())
    say_written(
        io::write_depth(options.out, question, result, {options.where->vtp_encoding, options.vertices}));
  print(options.form == AnswerForm::json ? result.json : result.text);
}

}  // namespace

void add_depth(CLI::App& app) {
  auto* command =
      app.add_subcommand("depth", "Compute where and how deep two bones penetrate each other in one pose");
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle depth sample/hip.toml --pose \"flexion=110 internal_rotation=30\" --out deep\n"
      "         condyle depth sample/hip.toml --pose flexion=140 --method normal --casting mobile");
  auto options = std::make_shared<DepthArguments>();
  options->parameters = add_set(*command);
  command->add_option("JOINT", options->joint, "The joint file, .toml")->required();
  auto* pose = command->add_option(
      "--pose", options->pose,
      "Compute in this pose: angles in degrees, and x, y, z of a free joint in mm, such as "
      "\"flexion=90 adduction=-10 internal_rotation=20\"; omitted values are 0. Or 16 numbers, the matrix "
      "X_FM row by row");
  pose->option_text("POSE (all 0)");
  command->add_option("--matrix", options->matrix, "Read that matrix from this file")
      ->excludes(pose)
      ->option_text("FILE");
  command
      ->add_option_function<std::string>(
          "--method",
          [options](const std::string& name) {
            options->method = name == "reliable"     ? DepthMethod::reliable
                              : name == "radial"     ? DepthMethod::radial
                              : name == "tangential" ? DepthMethod::tangential
                                                     : DepthMethod::normal;
          },
          "reliable measures along rays from the joint centre if that is a depth, else along the arc "
          "about "
          "a joint axis that frees the vertex soonest; radial along rays; tangential along arcs about one "
          "axis; normal from triangles along their normals, open meshes too")
      ->check(CLI::IsMember({"reliable", "radial", "tangential", "normal"}))
      ->option_text("reliable|radial|tangential|normal (reliable)");
  command
      ->add_option("--about", options->about,
                   "With --method tangential: the angle whose axis the mobile body rotates about")
      ->option_text("flexion|adduction|internal_rotation (flexion)");
  add_rays(*command, options->rays, "With --method normal: ");
  auto* out = command->add_option("--out", options->out,
                                  "Write fixed.vtp, mobile.vtp, pairs.csv and depth.json into this folder");
  out->option_text("FOLDER");
  add_where(*command, options->where);
  command
      ->add_flag_callback(
          "--csv", [options] { options->vertices = io::VertexTables::write; },
          "With --out: write fixed.csv and mobile.csv too, a line per vertex")
      ->needs(out);
  command->add_flag_callback(
      "--pairs-only", [options] { options->scope = Scope::pairs_only; },
      "Accept open meshes: list the pairs of triangles in contact, and vertices inside a closed body");
  command->add_flag_callback(
      "--json", [options] { options->form = AnswerForm::json; },
      "Print the answer as JSON, with every number in full");
  add_strict(*command, options->strictness);
  group_help(*command, {{"Most used", {"--pose", "--method", "--out", "--json", "--strict"}},
                        {"Question", {"--set", "--matrix", "--about", "--pairs-only"}},
                        {"Contact", {"--casting", "--rule", "--reach"}},
                        {"Output", {"--frame", "--ascii", "--csv", "--help"}}});
  command->callback([options, command] { depth_command(*options, *command); });
}

}  // namespace condyle::cli
