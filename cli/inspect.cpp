#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "answer.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "help_formatter.hpp"
#include "io/file/output_folder.hpp"
#include "io/result/inspection_result.hpp"
#include "io/result/label_result.hpp"
#include "io/result/model_result.hpp"
#include "io/result/repair_text.hpp"
#include "label_options.hpp"
#include "model_options.hpp"

namespace condyle::cli {
namespace {

struct InspectArguments {
  std::vector<std::string> meshes;  ///< or label maps, or models
  LabelOptions labels;
  std::vector<std::string> geometry;  ///< folders with meshes of models
  std::optional<io::PolygonRule> polygons;
  std::vector<std::string> repairs;
  std::string out;
  AnswerForm form = AnswerForm::text;
};

/// The name a repaired mesh is written under: PLY keeps every bit whatever format it came from.
std::string repaired_name(const std::filesystem::path& mesh) {
  return mesh.stem().string() + ".ply";
}

void check_names_differ(const InspectArguments& options) {
  std::set<std::string> names;
  for (const std::string& mesh : options.meshes)
    if (!names.insert(repaired_name(mesh)).second)
      throw UsageError("--out: two meshes would be written as " + repaired_name(mesh));
}

enum class FileKind { mesh, label_map, model };

FileKind kind_of(const std::string& path) {
  if (is_model(path)) return FileKind::model;
  return io::label_format_of(path) ? FileKind::label_map : FileKind::mesh;
}

/// The one kind that all files are of.
FileKind kind_of(const InspectArguments& options) {
  const FileKind kind = kind_of(options.meshes.front());
  for (const std::string& path : options.meshes)
    if (kind_of(path) != kind)
      throw UsageError("MESH: meshes, label maps and models are inspected one after the other, not together");
  const bool is_of_meshes = !options.repairs.empty() || !options.out.empty() || options.polygons.has_value();
  if (kind != FileKind::mesh && is_of_meshes)
    throw UsageError(
        "--repair, --polygons, --out: are for meshes; condyle surface extracts one from a label map");
  if (kind != FileKind::model && !options.geometry.empty())
    throw UsageError("--geometry: is for models of OpenSim, .osim");
  return kind;
}

void inspect_models(const InspectArguments& options, const CLI::App& command) {
  std::vector<io::Model> models;
  for (const std::string& path : options.meshes) models.push_back(model_of(path, options.geometry));
  print(options.form == AnswerForm::json ? io::models_json(models, words_of(command))
                                         : io::models_text(models));
}

void inspect_label_maps(const InspectArguments& options, const CLI::App& command) {
  std::vector<io::LabelInspection> images;
  for (const std::string& path : options.meshes)
    images.push_back(io::inspect_labels(path, options.labels.file));
  print(options.form == AnswerForm::json ? io::labels_json(images, words_of(command))
                                         : io::labels_text(images));
}

void inspect_command(const InspectArguments& options, const CLI::App& command) {
  const FileKind kind = kind_of(options);
  if (kind != FileKind::label_map) refuse_label_options(command, options.meshes.front());
  if (kind == FileKind::model) return inspect_models(options, command);
  if (kind == FileKind::label_map) return inspect_label_maps(options, command);
  std::vector<Repair> repairs;
  for (const std::string& name : options.repairs) repairs.push_back(io::repair_named(name));
  const std::vector<std::filesystem::path> meshes(options.meshes.begin(), options.meshes.end());
  const auto is_repaired = [&](std::string_view name) {
    return std::any_of(meshes.begin(), meshes.end(),
                       [&](const auto& mesh) { return repaired_name(mesh) == name; });
  };
  if (!options.out.empty()) {
    check_names_differ(options);
    io::OutputFolder{options.out, is_repaired, meshes};
  }

  std::vector<io::MeshInspection> inspections;
  std::vector<TriMesh> repaired;
  for (const std::string& path : options.meshes) {
    io::InspectedMesh inspected =
        io::inspect_file(path, repairs, options.polygons.value_or(io::PolygonRule::refuse));
    inspections.push_back(std::move(inspected.inspection));
    if (!options.out.empty()) repaired.push_back(std::move(inspected.mesh));
  }
  if (!options.out.empty()) {
    io::OutputFolder out(options.out, is_repaired, meshes);
    for (std::size_t i = 0; i < repaired.size(); ++i)
      io::write_mesh(out.file(repaired_name(options.meshes[i])), repaired[i]);
    out.commit();
  }
  print(options.form == AnswerForm::json ? io::inspection_json(inspections, words_of(command))
                                         : io::to_text(inspections));
}

}  // namespace

void add_inspect(CLI::App& app) {
  auto* command =
      app.add_subcommand("inspect", "Report the contents and the defects of meshes, label maps and models");
  command->footer(
      "Example: condyle sample hip --voxel 1 --out scan\n"
      "         condyle inspect scan/femur.ply scan/hip_bone.ply\n"
      "         condyle inspect scan/femur.ply --repair drop_unreferenced,flip_inverted --out repaired\n"
      "         condyle inspect scan/labels.nii.gz");
  auto options = std::make_shared<InspectArguments>();
  command
      ->add_option("MESH", options->meshes,
                   "Mesh files, .stl, .obj, .ply, .vtp or .vtk, or label maps, .nii, .nii.gz, .hdr, .nrrd, "
                   ".nhdr, .mha or .mhd, or models of OpenSim, .osim")
      ->required();
  add_repair(*command, options->repairs);
  add_polygons(*command, options->polygons, "refuse");
  add_out(*command, options->out, "Write the meshes into this folder, as read and repaired, .ply");
  add_json(*command, options->form);
  add_label_file(*command, options->labels);
  add_geometry(*command, options->geometry);
  group_help(*command, {{"Meshes", {"--repair", "--polygons", "--out"}},
                        {"Label maps", label_file_names()},
                        {"Models", {"--geometry"}},
                        {"Output", {"--json", "--help"}}});
  command->callback([options, command] { inspect_command(*options, *command); });
}

}  // namespace condyle::cli
