#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answer/require_surface.hpp"
#include "choice.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/inspect.hpp"
#include "condyle/io/pose_text.hpp"
#include "core/parallel.hpp"
#include "help_formatter.hpp"
#include "io/file/output_file.hpp"
#include "io/file/whole_file.hpp"
#include "io/mesh/parse.hpp"
#include "io/result/repair_text.hpp"
#include "io/result/touch_result.hpp"
#include "model_options.hpp"
#include "notes.hpp"

/// Two meshes without a joint file: touch, turn and slide.

namespace condyle::cli {
namespace {

struct TwoMeshes {
  std::string fixed, mobile, matrix, out, picture;
  std::optional<std::string> pose;
  std::optional<io::PolygonRule> polygons;
  std::optional<LengthUnit> units;
  std::vector<double> along, axis, centre = {0, 0, 0}, from;
  std::vector<std::string> repairs;
  TouchMeasures measures = TouchMeasures::depth;
  Strictness strictness = Strictness::notes;
  io::VtpEncoding vtp_encoding = io::VtpEncoding::binary;
  AnswerForm form = AnswerForm::text;
};

Vec3 three_of(const std::vector<double>& values) {
  return {values[0], values[1], values[2]};
}

/// With its digest only where the answer has one.
io::TouchMesh read_touch_mesh(const std::string& path, const TwoMeshes& options) {
  io::check_is_file(path);
  const io::MeshFormat format = io::mesh_format_of(path);
  const std::string bytes = io::read_whole_file(path);
  TriMesh mesh = io::read_mesh(bytes, format, path, options.polygons.value_or(io::PolygonRule::refuse)).mesh;
  std::vector<Repair> repairs;
  for (const std::string& name : options.repairs) repairs.push_back(io::repair_named(name));
  try {
    for (const RepairDone& done : repair_mesh(mesh, repairs)) note(path + ": repair " + io::describe(done));
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: {}", path, error.what()));
  }
  if (const double mm = mm_per(options.units.value_or(LengthUnit::millimetres)); mm != 1)
    for (std::vector<double>* row : {&mesh.vertices.x, &mesh.vertices.y, &mesh.vertices.z})
      for (double& value : *row) value *= mm;
  const bool has_digest =
      options.form == AnswerForm::json || !options.out.empty() || !options.picture.empty();
  try {
    io::TouchMesh read{path, std::move(mesh), has_digest ? io::digest_of(bytes) : io::FileDigest{}};
    require_surface(read.mesh, "the mesh");
    return read;
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: {}", path, error.what()));
  }
}

io::PoseArgument placing_of(const TwoMeshes& options) {
  if (options.matrix.empty())
    return options.pose ? io::matrix_pose(*options.pose) : io::PoseArgument{{}, Pose::Identity()};
  const std::string bytes = io::read_whole_file(options.matrix);
  try {
    return io::matrix_pose(io::without_comments({bytes, options.matrix}));
  } catch (const UsageError& error) {
    throw FileError(fmt::format("{}: {}", options.matrix, error.what()));
  }
}

io::TouchFiles read_touch_files(const TwoMeshes& options, const CLI::App& command) {
  const io::PoseArgument pose = placing_of(options);
  for (const std::string& remark : pose.notes) note("pose: " + remark);
  std::optional<io::TouchMesh> fixed, mobile;
  core::parallel_pair([&] { fixed = read_touch_mesh(options.fixed, options); },
                      [&] { mobile = read_touch_mesh(options.mobile, options); });
  io::TouchFiles files{.fixed = std::move(*fixed),
                       .mobile = std::move(*mobile),
                       .X_FM = pose.X_FM,
                       .read = {options.fixed, options.mobile},
                       .command = words_of(command)};
  if (!options.matrix.empty()) files.read.emplace_back(options.matrix);
  return files;
}

/// Says the notes of an answer, or refuses it for them, before anything is written.
template <class Answer>
Answer with_notes_said(Answer answer, const TwoMeshes& options) {
  say_notes(answer.notes, options.fixed + ", " + options.mobile, options.strictness);
  return answer;
}

/// In the form that was asked for.
template <class Answer>
void say_touch(const TwoMeshes& options, const io::TouchFiles& files, const Answer& answer,
               io::Json (*object)(const Answer&, const io::TouchFiles*),
               std::string (*text)(const Answer&, const io::TouchFiles&)) {
  print(options.form == AnswerForm::json ? io::document(object(answer, &files)) : text(answer, files));
}

std::vector<Vec3> ways_out_of(const TwoMeshes& options) {
  std::vector<Vec3> along;
  for (std::size_t i = 0; i < options.along.size(); i += 3)
    along.emplace_back(options.along[i], options.along[i + 1], options.along[i + 2]);
  if (along.empty() && options.measures == TouchMeasures::all)
    for (int k = 0; k < 3; ++k) along.insert(along.end(), {Vec3(Vec3::Unit(k)), Vec3(-Vec3::Unit(k))});
  return along;
}

void touch_command(const TwoMeshes& options, const CLI::App& command) {
  if (options.along.size() % 3 != 0) throw UsageError("--along: needs three numbers for each direction");
  const io::TouchFiles files = read_touch_files(options, command);
  if (!options.out.empty()) io::check_touch_folder(options.out, files);
  if (!options.picture.empty()) io::check_output_file(options.picture, files.read, {"a picture", {".png"}});
  const TouchAnswer answer = with_notes_said(
      answer_touch(files.fixed.mesh, files.mobile.mesh,
                   {.X_FM = files.X_FM,
                    .measures = options.measures,
                    .along = ways_out_of(options),
                    .centre = options.from.empty() ? std::nullopt : std::optional(three_of(options.from)),
                    .units_are_stated = options.units.has_value()}),
      options);
  if (!options.out.empty()) say_written(io::write_touch(options.out, answer, files, options.vtp_encoding));
  if (!options.picture.empty()) {
    io::write_touch_picture(options.picture, answer, files);
    say_written({options.picture});
  }
  say_touch(options, files, answer, io::touch_object, io::touch_text);
}

void turn_command(const TwoMeshes& options, const CLI::App& command) {
  const io::TouchFiles files = read_touch_files(options, command);
  const TurnRequest request{three_of(options.axis), three_of(options.centre), files.X_FM,
                            options.units.has_value()};
  say_touch(options, files,
            with_notes_said(answer_turn(files.fixed.mesh, files.mobile.mesh, request), options),
            io::turn_object, io::turn_text);
}

void slide_command(const TwoMeshes& options, const CLI::App& command) {
  const io::TouchFiles files = read_touch_files(options, command);
  const SlideRequest request{three_of(options.along), files.X_FM, options.units.has_value()};
  say_touch(options, files,
            with_notes_said(answer_slide(files.fixed.mesh, files.mobile.mesh, request), options),
            io::slide_object, io::slide_text);
}

/// A, B, and where B is.
CLI::App* add_two_meshes(CLI::App& app, const char* name, const char* help, TwoMeshes& options) {
  auto* command = app.add_subcommand(name, help);
  command->add_option("A", options.fixed, "The mesh that stays, .stl, .obj, .ply, .vtp or .vtk")->required();
  command->add_option("B", options.mobile, "The mesh that moves")->required();
  auto* pose = command->add_option("--pose", options.pose,
                                   "Place B in the frame of A by this matrix, 16 numbers row by row");
  pose->option_text("MATRIX (as the files have it)");
  add_value(*command, "--matrix", options.matrix, "FILE", "Read that matrix from this file")->excludes(pose);
  add_choice(*command, "--units", options.units,
             {{"mm", LengthUnit::millimetres},
              {"cm", LengthUnit::centimetres},
              {"in", LengthUnit::inches},
              {"m", LengthUnit::metres}},
             "The unit of both meshes; all else is in mm", "mm");
  add_polygons(*command, options.polygons, "refuse");
  add_repair(*command, options.repairs);
  add_strict(*command, options.strictness);
  add_json(*command, options.form);
  return command;
}

}  // namespace

void add_touch(CLI::App& app) {
  auto options = std::make_shared<TwoMeshes>();
  auto* command = add_two_meshes(
      app, "touch", "Compute whether two meshes touch, how deep, and how one gets free: no joint file",
      *options);
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle touch sample/hip_bone.ply sample/femur.ply --pose \"1 0 0 2  0 1 0 0  0 0 1 1  0 0 0 "
      "1\"\n"
      "         condyle touch sample/hip_bone.ply sample/femur.ply --measures --along 0 -1 0");
  add_value(*command, "--along", options->along, "X Y Z ... (with --measures both ways along x, y and z)",
            "How far B moves along this direction until it is free; any number of directions")
      ->expected(3)
      ->take_all();
  add_value(*command, "--centre", options->from, "X Y Z",
            "Measure the depth along rays from this joint centre too, as condyle depth does")
      ->expected(3);
  add_flag(*command, "--measures", options->measures, TouchMeasures::all,
           "Compute penetration volume and areas too, which takes longer than the rest");
  add_out(*command, options->out, "Write touch.json, fixed.vtp, mobile.vtp and place.vtp into this folder");
  add_value(*command, "--picture", options->picture, "FILE",
            "Draw both meshes and what meets into this file, .png");
  add_flag(*command, "--ascii", options->vtp_encoding, io::VtpEncoding::text, "Write VTP files as text");
  group_help(*command, {{"Most used", {"--pose", "--measures", "--along", "--centre", "--out", "--json"}},
                        {"Meshes", {"--matrix", "--units", "--polygons", "--repair", "--strict"}},
                        {"Output", {"--picture", "--ascii", "--help"}}});
  command->callback([options, command] { touch_command(*options, *command); });
}

void add_turn(CLI::App& app) {
  auto options = std::make_shared<TwoMeshes>();
  auto* command = add_two_meshes(
      app, "turn", "Compute where a mesh that turns about an axis meets another one, over a whole turn",
      *options);
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle turn sample/hip_bone.ply sample/femur.ply --axis 0 0 1");
  add_value(*command, "--axis", options->axis, "X Y Z",
            "Direction of the axis in the frame of A; of any length")
      ->expected(3)
      ->required();
  add_value(*command, "--centre", options->centre, "X Y Z (0 0 0)", "A point on the axis, in mm")
      ->expected(3);
  group_help(*command, {{"Most used", {"--axis", "--centre", "--pose", "--json"}},
                        {"Meshes", {"--matrix", "--units", "--polygons", "--repair", "--strict"}},
                        {"Output", {"--help"}}});
  command->callback([options, command] { turn_command(*options, *command); });
}

void add_slide(CLI::App& app) {
  auto options = std::make_shared<TwoMeshes>();
  auto* command = add_two_meshes(
      app, "slide", "Compute where a mesh that slides along a direction meets another one", *options);
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle slide sample/hip_bone.ply sample/femur.ply --along 1 0 0");
  add_value(*command, "--along", options->along, "X Y Z", "The direction in the frame of A; of any length")
      ->expected(3)
      ->required();
  group_help(*command, {{"Most used", {"--along", "--pose", "--json"}},
                        {"Meshes", {"--matrix", "--units", "--polygons", "--repair", "--strict"}},
                        {"Output", {"--help"}}});
  command->callback([options, command] { slide_command(*options, *command); });
}

}  // namespace condyle::cli
