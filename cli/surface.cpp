#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "answer.hpp"
#include "choice.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/io/label_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "help_formatter.hpp"
#include "io/file/output_file.hpp"
#include "io/file/output_folder.hpp"
#include "io/image/label_name.hpp"
#include "io/result/label_result.hpp"
#include "label_options.hpp"
#include "notes.hpp"
#include "with_progress.hpp"

namespace condyle::cli {
namespace {

struct SurfaceArguments {
  std::string image, label, out;
  LabelOptions labels;
  AnswerForm form = AnswerForm::text;
};

void surface_command(const SurfaceArguments& options, const CLI::App& command) {
  if (!options.out.empty()) {
    io::check_written_mesh(options.out);
    const std::filesystem::path read[] = {options.image};
    io::check_output_file(options.out, read);
  }
  const io::LabelMap map = io::read_labels(options.image, options.labels.file);
  if (options.out.empty())
    throw UsageError(
        fmt::format("--out FILE and --label are needed: in {}, {}", options.image, io::labels_there(map)));
  const io::LabelBoneRequest request{options.label, options.labels.task, options.labels.surface};
  const io::LabelBone bone = with_progress(
      [&](const Control& control) { return io::bone_of(map, options.image, request, control); });
  note_all(map.notes);
  note_all(bone.notes);
  const std::filesystem::path out(options.out);
  io::OutputFolder folder(out.has_parent_path() ? out.parent_path() : ".");
  io::write_mesh(folder.file(out.filename().string()), bone.surface.mesh);
  folder.commit();
  note("wrote " + options.out);
  print(options.form == AnswerForm::json ? io::surface_json(bone, options.image, words_of(command))
                                         : io::surface_text(bone));
}

}  // namespace

void add_surface(CLI::App& app) {
  auto* command = app.add_subcommand("surface", "Extract the surface of one bone from a label map");
  command->footer(
      "Example: condyle sample hip --voxel 1 --out scan\n"
      "         condyle surface scan/labels.nii.gz --label 76 -o femur.ply\n"
      "         condyle surface scan/labels.nii.gz --task total --label femur_right -o femur.ply\n"
      "The surface is closed and in LPS, mm: it lies over its image in 3D Slicer.");
  auto options = std::make_shared<SurfaceArguments>();
  command->add_option("LABELS", options->image, "A label map: .nii, .nii.gz, .hdr, .nrrd, .nhdr, .mha, .mhd")
      ->required();
  add_value(*command, "--label", options->label, "LABEL",
            "The label of the bone: its number, or its name if the file or --task has names. Without "
            "it the only label");
  add_value(*command, "-o,--out", options->out, "FILE", "Write the surface here, .ply or .vtp; required");
  add_json(*command, options->form);
  add_label_surface(*command, options->labels);
  add_label_file(*command, options->labels);
  std::vector<std::string> of_bone{"--label"};
  for (const std::string& name : label_surface_names()) of_bone.push_back(name);
  group_help(*command,
             {{"Bone", of_bone}, {"Image", label_file_names()}, {"Output", {"--out", "--json", "--help"}}});
  command->callback([options, command] { surface_command(*options, *command); });
}

}  // namespace condyle::cli
