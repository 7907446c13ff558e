#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "answer.hpp"
#include "choice.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/label_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/joint_checks.hpp"
#include "help_formatter.hpp"
#include "io/file/output_file.hpp"
#include "io/image/unread_image.hpp"
#include "io/joint/settings_lines.hpp"
#include "joint_command.hpp"
#include "label_options.hpp"
#include "model_options.hpp"
#include "notes.hpp"
#include "proposed_files.hpp"
#include "with_progress.hpp"

namespace condyle::cli {
namespace {

namespace fs = std::filesystem;

struct InitArguments {
  std::string fixed, mobile;  ///< files
  std::string joint;          ///< of a model, or which joint two meshes are
  ModelOptions model;
  std::string fixed_label, mobile_label;
  std::optional<Side> side;
  std::optional<LengthUnit> units;
  LabelOptions labels;
  Person person;
  bool seat = false;
  std::string out;

  fs::path joint_file() const { return out.empty() ? fs::path("joint.toml") : fs::path(out); }
};

void check_out(const InitArguments& options) {
  if (options.out.empty()) return;
  refuse_existing(options.out, "and may have been edited");
  io::check_output_file(options.out, {}, {"a joint file", {".toml"}});
}

/// Which joint two meshes are; empty if it was not given.
std::optional<Anatomy> anatomy_of(const std::string& joint) {
  if (joint.empty()) return std::nullopt;
  for (const Anatomy known : all_anatomies)
    if (joint == name_of(known)) return known;
  throw UsageError("--joint: two meshes are a hip, knee, ankle, elbow or shoulder, not " + joint);
}

void propose_from_meshes(const InitArguments& options) {
  (void)io::mesh_format_of(options.fixed);
  if (options.mobile.empty()) throw UsageError("MOBILE: the mesh of the body that moves is needed");
  const io::JointProposal proposal = io::propose_joint(
      io::ProposalRequest{.fixed = options.fixed,
                          .mobile = options.mobile,
                          .joint_file = options.joint_file(),
                          .side = options.side,
                          .units = options.units,
                          .anatomy = anatomy_of(options.joint),
                          .polygons = options.model.polygons.value_or(io::PolygonRule::refuse),
                          .person = options.person,
                          .seat = options.seat});
  note_to_fill_in(proposal);
  if (options.out.empty()) return print(proposal.toml);
  io::write_output_file(options.out, proposal.toml);
  note("wrote " + options.out);
}

void check_labels(const InitArguments& options) {
  if (options.out.empty())
    throw UsageError("--out: is needed, the surfaces of the bones are written beside the joint file");
  if (options.units) throw UsageError("--units: surfaces of label maps are in mm");
  if (options.model.polygons) throw UsageError("--polygons: surfaces of label maps have none");
  if (anatomy_of(options.joint).value_or(Anatomy::hip) != Anatomy::hip)
    throw UsageError(
        "--joint: bones of a label map are made a hip; write others with condyle surface and give both "
        "meshes");
  if (options.mobile.empty() && (options.fixed_label.empty() || options.mobile_label.empty()))
    throw UsageError("--fixed, --mobile: both labels are needed, by number or by name");
}

void propose_from_labels(const InitArguments& options) {
  check_labels(options);
  const auto bone = [&](const std::string& label) {
    return io::LabelBoneRequest{label, options.labels.task, options.labels.surface};
  };
  io::LabelJointRequest request{.labels = options.fixed,
                                .file = options.labels.file,
                                .fixed = bone(options.fixed_label),
                                .mobile = bone(options.mobile_label),
                                .joint_file = options.joint_file(),
                                .side = options.side};
  if (!options.mobile.empty()) request.mobile_labels = options.mobile;
  io::LabelJoint joint =
      with_progress([&](const Control& control) { return io::propose_joint(request, control); });
  joint.proposal.toml += io::person_text(options.person);
  write_proposal(joint, request.joint_file);
}

/// What is wrong with the ligaments that the file has; other notes are for whoever answers by it.
void note_ligaments(const io::Model& model, const io::ModelJointRequest& request) {
  const io::LoadedJoint joint = io::read_joint(model, request);
  note_all(check_ligaments(joint.joint, joint.report.placement));
}

void propose_from_model(const InitArguments& options) {
  if (!options.mobile.empty()) throw UsageError("MOBILE: a model has both bodies");
  if (options.units) throw UsageError("--units: lengths of a model are metres");
  if (!options.fixed_label.empty() || !options.mobile_label.empty())
    throw UsageError("--fixed, --mobile: are for label maps, and " + options.fixed + " is none");
  const io::Model model = model_of(options.fixed, options.model.geometry);
  io::ModelJointRequest request = request_of(model, options.model, options.joint, options.side);
  request.joint_file = options.joint_file();
  io::ModelJointProposal proposed = io::propose_joint(model, request);
  proposed.proposal.toml += io::person_text(options.person);
  for (const io::ModelNote& of_model : proposed.notes) note(io::to_text(of_model));
  note_to_fill_in(proposed.proposal);
  // What cannot be loaded as it stands is printed and no file, which would be in the way of the next proposal.
  const std::string unusable = proposed.missing_body + proposed.unreadable;
  if (options.out.empty()) print(proposed.proposal.toml);
  if (!unusable.empty()) throw FileError(unusable);
  if (!options.out.empty()) {
    io::write_output_file(options.out, proposed.proposal.toml);
    note("wrote " + options.out);
  }
  if (proposed.proposal.to_fill_in.empty() &&
      proposed.proposal.toml.find("[[ligament]]") != std::string::npos)
    note_ligaments(model, request);
}

void init_command(const InitArguments& options, const CLI::App& command) {
  check_out(options);
  io::refuse_unread_image(options.fixed);
  if (!io::label_format_of(options.fixed)) refuse_label_options(command, options.fixed);
  if (options.seat && (is_model(options.fixed) || io::label_format_of(options.fixed)))
    throw UsageError(
        "--seat: is for two meshes; a scan has its bones where they are, and a model says where");
  if (is_model(options.fixed)) return propose_from_model(options);
  if (options.model.any())
    throw UsageError("--anatomy, --contact, --geometry: are for models of OpenSim, .osim");
  if (io::label_format_of(options.fixed)) return propose_from_labels(options);
  if (!options.fixed_label.empty() || !options.mobile_label.empty())
    throw UsageError("--fixed, --mobile: are for label maps, and " + options.fixed + " is none");
  propose_from_meshes(options);
}

}  // namespace

void add_init(CLI::App& app) {
  auto* command = app.add_subcommand("init",
                                     "Propose a joint file for two meshes, two bones of a label map or a "
                                     "joint of an OpenSim model, with the evidence for each value");
  command->footer(
      "Example: condyle sample hip --voxel 1 --out bones\n"
      "         condyle init bones/hip_bone.ply bones/femur.ply --side right -o proposed.toml\n"
      "         condyle init bones/labels.nii.gz --task total --fixed hip_right --mobile femur_right -o "
      "hip.toml\n"
      "A knee is FEMUR TIBIA --joint knee, and so are ankle, elbow and shoulder; a joint of an OpenSim model "
      "is MODEL.osim --joint NAME.\n"
      "Values that could not be inferred are comments to fill in. Read the file before you use it.");
  auto options = std::make_shared<InitArguments>();
  command
      ->add_option("FIXED", options->fixed,
                   "The mesh of the body that stays, such as the hip bone; or a label map: .nii, .nii.gz, "
                   ".nrrd, .nhdr, .mha, .mhd; or a model of OpenSim: .osim")
      ->required();
  command->add_option(
      "MOBILE", options->mobile,
      "The mesh of the body that moves, such as the femur; a label map if it is in a file of its own");
  add_value(*command, "--fixed", options->fixed_label, "LABEL",
            "The label of the fixed body: its number, or its name if the file or --task has names");
  add_value(*command, "--mobile", options->mobile_label, "LABEL", "The label of the mobile body");
  add_value(*command, "--joint", options->joint, "NAME",
            "The joint of a model, by its name there; of two meshes hip, knee, ankle, elbow or "
            "shoulder, FIXED the bone nearer to the trunk. Default for two meshes: hip");
  add_model(*command, options->model);
  add_label_surface(*command, options->labels);
  add_label_file(*command, options->labels);
  add_side(
      *command, options->side,
      "The side of the body. Default: by the labels' names or the model's, else inferred from the bones");
  add_choice(*command, "--units", options->units,
             {{"mm", LengthUnit::millimetres},
              {"cm", LengthUnit::centimetres},
              {"in", LengthUnit::inches},
              {"m", LengthUnit::metres}},
             "The unit of both meshes. Default: inferred from their size");
  command->add_flag(
      "--seat", options->seat,
      "Move the mobile mesh so that its head lies in the socket, as bones of shape models need: every "
      "answer says that it was moved");
  add_species(*command, options->person.species);
  add_value(*command, "-o,--out", options->out, "FILE (standard output)",
            "Write the joint file here, and surfaces of a label map beside it");
  std::vector<std::string> of_labels{"--fixed", "--mobile"};
  for (const std::string& name : label_surface_names()) of_labels.push_back(name);
  std::vector<std::string> of_models;
  for (const std::string& name : model_names()) of_models.push_back(name);
  group_help(*command, {{"Joint", {"--joint", "--side", "--seat", "--units", "--species"}},
                        {"Output", {"--out", "--help"}},
                        {"Label maps", of_labels},
                        {"Models", of_models},
                        {"Images", label_file_names()}});
  command->callback([options, command] { init_command(*options, *command); });
}

}  // namespace condyle::cli
