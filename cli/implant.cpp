#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "choice.hpp"
#include "commands.hpp"
#include "condyle/answer.hpp"
#include "implant_options.hpp"
#include "io/result/implant_result.hpp"
#include "joint_command.hpp"

namespace condyle::cli {
namespace {

struct ImplantArguments : JointArguments {
  ImplantSizeArguments given{plan::TotalHip{}};
  ImplantCentre centre = ImplantCentre::head;
  bool as_rim = false;
};

/// Sizes, default: the bone's own.
constexpr std::array<std::string_view, 4> sizes_of_bones{"neck_shaft", "stem_version", "offset",
                                                         "cup_radius"};

ImplantRequest request_of(const ImplantArguments& options) {
  const auto is_left = [&](std::string_view size) { return !options.given.sizes.contains(size); };
  return {.hip = std::get<plan::TotalHip>(options.given.implant),
          .of_bones = {.neck_shaft = is_left("neck_shaft"),
                       .stem_version = is_left("stem_version"),
                       .offset = is_left("offset"),
                       .cup_radius = is_left("cup_radius"),
                       .cup = options.as_rim},
          .centre = options.centre};
}

void implant_command(const ImplantArguments& options, const CLI::App& command) {
  const io::LoadedJoint loaded = joint_of(options);
  const std::vector<JointNote> notes = noted(loaded, options.strictness);
  const io::Provenance from = provenance_of(options, loaded, command);
  if (!options.out.empty()) io::check_implant_folder(options.out, &from);
  const ImplantAnswer answer = answered(options, [&] { return answer_implant(loaded, request_of(options)); });
  note_all(answer.notes);
  const io::ImplantResult result{loaded.joint, answer, notes, &from, &loaded.report.file};
  if (!options.out.empty()) say_written(io::write_implant(options.out, result));
  print(options.form == AnswerForm::json ? io::implant_json(result) : io::implant_text(result));
}

void add_placement(CLI::App& command, ImplantArguments& options) {
  add_choice(command, "--centre", options.centre,
             {{"head", ImplantCentre::head}, {"socket", ImplantCentre::socket}},
             "The centre of cup and head: that of the head of the femur, or of the socket", "head");
  command
      .add_flag("--as-rim", options.as_rim,
                "Orient the cup like the rim of the bone, in place of its inclination and anteversion")
      ->excludes("--inclination")
      ->excludes("--anteversion");
}

}  // namespace

void add_implant(CLI::App& app) {
  auto* command =
      app.add_subcommand("implant", "Put a total hip in the place of a hip, and write the joint with it");
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle implant sample/hip.toml --inclination 42 --out thr\n"
      "         condyle rom thr/hip.toml\n"
      "Bones and implant only: soft tissue, fixation and the strength of the remaining bone are not "
      "modelled.");
  auto options = std::make_shared<ImplantArguments>();
  add_joint(*command, *options);
  add_out(*command, options->out, "Write implant.json, and hip.toml with its meshes into this folder");
  add_definition(*command, options->given);
  const std::vector<std::string> sizes = add_sizes(*command, options->given, sizes_of_bones);
  add_placement(*command, *options);
  add_facets(*command, options->given);
  add_json(*command, options->form);
  add_strict(*command, options->strictness);
  const std::vector<std::string> others(sizes.begin() + 2, sizes.end());
  group_help(*command, {{"Most used", {"--inclination", "--anteversion", "--as-rim", "--out", "--json"}},
                        {"Placement", {"--definition", "--centre", "--set"}},
                        {"Sizes", others},
                        {"Output", {"--facets", "--strict", "--help"}}});
  command->callback([options, command] { implant_command(*options, *command); });
}

}  // namespace condyle::cli
