#include "sample_implants.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "choice.hpp"
#include "command_line.hpp"
#include "condyle/sample/hip.hpp"
#include "help_formatter.hpp"
#include "implant_options.hpp"
#include "io/result/implant_result.hpp"
#include "io/result/sample_files.hpp"
#include "whole_number.hpp"

namespace condyle::cli {
namespace {

enum class Bones { sample, none };

struct ImplantOptions {
  ImplantSizeArguments given;
  Side side = Side::right;
  Bones bones = Bones::none;
  int scenario = 1;
  std::string out;
};

void sample_implant_command(const ImplantOptions& options) {
  plan::ImplantMeshes meshes;
  if (options.bones == Bones::sample)
    meshes = *sample::sample_replacement(std::get<plan::TotalHip>(options.given.implant), {},
                                         static_cast<sample::Scenario>(options.scenario), options.side);
  else
    meshes = plan::implant_meshes(options.given.implant, options.side);
  io::OutputFolder out(options.out);
  io::write_sample_implant(out, meshes, options.given.implant, options.side);
  out.commit();
  std::string text, files;
  for (const auto* body : {&meshes.fixed, &meshes.mobile})
    for (const auto& [part, mesh] : *body) {
      text +=
          fmt::format("{}: {} vertices, {} triangles\n", part, mesh.vertices.size(), mesh.triangles.size());
      files += part + ".ply, ";
    }
  const char* joint =
      std::holds_alternative<plan::TotalHip>(options.given.implant) ? "hip.toml" : "shoulder.toml";
  print(text + io::implant_lines(options.given.implant, options.side) +
        fmt::format("written to {}: {}{}\n", options.out, files, joint));
}

void add_common(CLI::App& command, ImplantOptions& options, const char* files) {
  add_out(command, options.out, fmt::format("Write {} into this folder", files))->required();
  add_choice(command, "--side", options.side, {{"right", Side::right}, {"left", Side::left}},
             "The side of the body. A left implant is the right one mirrored", "right");
  add_facets(command, options.given);
}

void add_replacement(CLI::App& sample) {
  auto* command = sample.add_subcommand(
      "replacement", "Make a total hip of its sizes, in the sample hip or by itself, and a joint file");
  command->footer(
      "Example: condyle sample replacement --inclination 45 --anteversion 20 --out thr\n"
      "         condyle sample replacement --bones none --head-radius 18 --definition anatomic --out alone\n"
      "         condyle rom thr/hip.toml");
  auto options = std::make_shared<ImplantOptions>();
  options->given.implant = plan::TotalHip{};
  options->bones = Bones::sample;
  add_common(*command, *options, "a mesh for each part and hip.toml");
  add_definition(*command, options->given);
  add_choice(*command, "--bones", options->bones, {{"sample", Bones::sample}, {"none", Bones::none}},
             "Bones around the implant: the sample hip with its usual measures, or none", "sample");
  add_value(*command, "--scenario", options->scenario, "1..4 (1)",
            "How fine the bones are, as in condyle sample hip")
      ->check(whole_number(1, 4));
  const std::vector<std::string> sizes = add_sizes(*command, options->given);
  group_help(*command, {{"Most used", {"--out", "--side", "--bones", "--definition"}},
                        {"Sizes", sizes},
                        {"Resolution", {"--facets", "--scenario", "--help"}}});
  command->callback([options] { sample_implant_command(*options); });
}

void add_reverse_shoulder(CLI::App& sample) {
  auto* command =
      sample.add_subcommand("reverse-shoulder", "Make a reverse shoulder of its sizes, and a joint file");
  command->footer(
      "Example: condyle sample reverse-shoulder --neck-shaft 145 --out reverse\n"
      "         condyle rom reverse/shoulder.toml");
  auto options = std::make_shared<ImplantOptions>();
  options->given.implant = plan::ReverseShoulder{};
  add_common(*command, *options, "a mesh for each part and shoulder.toml");
  const std::vector<std::string> sizes = add_sizes(*command, options->given);
  group_help(*command,
             {{"Most used", {"--out", "--side"}}, {"Sizes", sizes}, {"Resolution", {"--facets", "--help"}}});
  command->callback([options] { sample_implant_command(*options); });
}

}  // namespace

void add_sample_implants(CLI::App& sample) {
  add_replacement(sample);
  add_reverse_shoulder(sample);
}

}  // namespace condyle::cli
