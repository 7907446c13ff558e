#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answer/depth_meshes.hpp"
#include "choice.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "contact_options.hpp"
#include "io/file/whole_file.hpp"
#include "io/joint/depth_surfaces.hpp"
#include "io/mesh/parse.hpp"
#include "io/result/depth_result.hpp"
#include "joint_command.hpp"

namespace condyle::cli {
namespace {

enum class Scope { vertices_and_pairs, pairs_only };

struct DepthArguments : JointArguments {
  std::string pose, matrix;
  DepthMethod method = DepthMethod::reliable;
  std::optional<std::string> about;
  io::ContactChanges rays;
  io::VertexTables vertices = io::VertexTables::leave_out;
  Scope scope = Scope::vertices_and_pairs;
};

DepthRequest request_of(const DepthArguments& options, const io::PoseArgument& given, Anatomy joint) {
  DepthRequest request{.X_FM = given.X_FM, .pose = given.pose.angles(), .method = options.method};
  if (options.about) request.about = io::arcs_about(*options.about, joint);
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

/// A mesh that is refused is named by its files, with the options that accept it.
void require_meshes(const io::LoadedJoint& loaded, const DepthArguments& options) {
  if (options.scope == Scope::pairs_only && options.method != DepthMethod::normal) return;
  const std::string fixed = files_of(loaded.report.fixed), mobile = files_of(loaded.report.mobile);
  try {
    answer::require_depth_meshes(loaded.joint, options.method, {fixed, mobile});
  } catch (const answer::NoSolidError& error) {
    throw MeshError(std::string(error.what()) + (error.normals_would_do
                                                     ? " (--method normal or --pairs-only accept such meshes)"
                                                     : " (--pairs-only accepts such meshes)"));
  }
}

void depth_command(const DepthArguments& options, const CLI::App& command) {
  const bool by_normals = options.method == DepthMethod::normal;
  if (options.rays.any_of_rays() && !by_normals)
    throw UsageError("--casting, --rule, --reach: are for --method normal");
  const io::InputRecorder read;
  const io::LoadedJoint loaded = joint_of(options);
  const io::ContactEntry entry = contact_of(options.rays, loaded.report.file, false);
  const Joint joint = by_normals ? io::joint_of_surfaces(entry, loaded.joint) : loaded.joint;
  const io::PoseArgument given = pose_of(options, joint);
  DepthRequest request = request_of(options, given, joint.anatomy);
  if (by_normals) request = io::cast_as(entry, request);
  check_depth_request(joint, request);
  for (const std::string& remark : given.notes) note("pose: " + remark);
  require_meshes(loaded, options);
  io::Provenance from = provenance_of(options, loaded, command, {options.matrix});
  if (!options.out.empty()) io::check_depth_folder(options.out, &from);
  const io::DepthQuestion question{.joint = joint,
                                   .pose = given.pose,
                                   .X_FM = given.X_FM,
                                   .notes = noted(loaded, options.strictness),
                                   .provenance = &from};
  io::add_other_files(from, read);
  const DepthAnswer answer = answered(options, [&] {
    const auto limits = limits_of_poses(loaded.joint);
    request.limits = limits.get(), request.deepest_place = true;
    return answer_depth(joint, request);
  });
  const io::DepthResult result = io::depth_result(question, answer);
  if (!options.out.empty())
    say_written(io::write_depth(options.out, question, result, {options.vtp_encoding, options.vertices}));
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
  add_joint(*command, *options);
  auto* pose = command->add_option(
      "--pose", options->pose,
      "Compute in this pose: angles in degrees, and x, y, z of a free joint in mm, such as "
      "\"flexion=90 adduction=-10 internal_rotation=20\"; omitted values are 0. Or 16 numbers, the matrix "
      "X_FM row by row");
  pose->option_text("POSE (all 0)");
  add_value(*command, "--matrix", options->matrix, "FILE", "Read that matrix from this file")->excludes(pose);
  add_choice(*command, "--method", options->method,
             {{"reliable", DepthMethod::reliable},
              {"radial", DepthMethod::radial},
              {"tangential", DepthMethod::tangential},
              {"normal", DepthMethod::normal}},
             "reliable measures along rays from the joint centre if that is a depth, else along the arc "
             "about "
             "a joint axis that frees the vertex soonest; radial along rays; tangential along arcs about one "
             "axis; normal from triangles along their normals, open meshes too",
             "reliable");
  add_value(*command, "--about", options->about, "flexion|adduction|internal_rotation|AXIS [POINT] (flexion)",
            "With --method tangential: the angle whose axis the mobile body rotates about, or an axis in "
            "the joint frame, \"x y z\", and a point of it in mm, \"x y z px py pz\"");
  add_rays(*command, options->rays, "With --method normal: ");
  auto* out = add_out(*command, options->out,
                      "Write fixed.vtp, mobile.vtp, pairs.csv and depth.json into this folder");
  add_where(*command, *options);
  add_flag(*command, "--csv", options->vertices, io::VertexTables::write,
           "With --out: write fixed.csv and mobile.csv too, a line per vertex")
      ->needs(out);
  add_flag(*command, "--pairs-only", options->scope, Scope::pairs_only,
           "Accept open meshes: list the pairs of triangles in contact, and vertices inside a closed body");
  add_json(*command, options->form);
  add_strict(*command, options->strictness);
  group_help(*command, {{"Most used", {"--pose", "--method", "--out", "--json", "--strict"}},
                        {"Question", {"--set", "--matrix", "--about", "--pairs-only"}},
                        {"Contact", {"--casting", "--rule", "--reach"}},
                        {"Output", {"--frame", "--ascii", "--csv", "--help"}}});
  command->callback([options, command] { depth_command(*options, *command); });
}

}  // namespace condyle::cli
