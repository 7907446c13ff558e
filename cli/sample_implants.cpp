#include "sample_implants.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/sample/hip.hpp"
#include "help_formatter.hpp"
#include "io/result/sample_files.hpp"

namespace condyle::cli {
namespace {

enum class Bones { sample, none };

struct ImplantOptions {
  Implant implant;
  Side side = Side::right;
  Bones bones = Bones::none;
  int scenario = 1;
  std::string out;
};

/// Its angles by each definition, and what neck and liner do.
std::string implant_lines(const Implant& implant, Side side) {
  std::string text;
  if (const auto* hip = std::get_if<TotalHip>(&implant)) {
    text += "cup, inclination and anteversion:";
    for (const auto definition :
         {CupDefinition::radiographic, CupDefinition::anatomic, CupDefinition::operative}) {
      const CupAngles angles = by_definition(hip->cup, definition);
      text += fmt::format("{} {:.2f} {:.2f} {}", definition == CupDefinition::radiographic ? "" : ",",
                          angles.inclination.degrees(), angles.anteversion.degrees(), name_of(definition));
    }
    text += "\n";
  }
  const auto pair = revolved_pair(implant, side);
  text += pair ? fmt::format("neck meets liner where their axes are {:.4f} degrees apart\n",
                             pair->half_angle.degrees())
               : fmt::format("limits of meshes only: {}\n", why_not_revolved(implant));
  return text;
}

void sample_implant_command(const ImplantOptions& options) {
  ImplantMeshes meshes;
  if (options.bones == Bones::sample)
    meshes = *sample_replacement(std::get<TotalHip>(options.implant), {},
                                 static_cast<Scenario>(options.scenario), options.side);
  else
    meshes = implant_meshes(options.implant, options.side);
  OutputFolder out(options.out);
  write_sample_implant(out, meshes, options.implant, options.side);
  out.commit();
  std::string text, files;
  for (const auto* body : {&meshes.fixed, &meshes.mobile})
    for (const auto& [part, mesh] : *body) {
      text +=
          fmt::format("{}: {} vertices, {} triangles\n", part, mesh.vertices.size(), mesh.triangles.size());
      files += part + ".ply, ";
    }
  const char* joint = std::holds_alternative<TotalHip>(options.implant) ? "hip.toml" : "shoulder.toml";
  print(text + implant_lines(options.implant, options.side) +
        fmt::format("written to {}: {}{}\n", options.out, files, joint));
}

std::string option_name(std::string_view parameter) {
  std::string name = "--" + std::string(parameter);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

/// Options of all sizes; their names.
std::vector<std::string> add_sizes(CLI::App& command, const std::shared_ptr<ImplantOptions>& options) {
  std::vector<std::string> names;
  for (const ImplantParameter& each : implant_parameters(options->implant)) {
    names.push_back(option_name(each.name));
    command
        .add_option_function<double>(
            names.back(), [options, set = each.set](double value) { set(options->implant, value); },
            std::string(each.meaning))
        ->option_text(
            fmt::format("{} ({:g})", each.unit == "mm" ? "MM" : "DEG", each.value(options->implant)));
  }
  return names;
}

void add_common(CLI::App& command, const std::shared_ptr<ImplantOptions>& options, const char* files) {
  command.add_option("--out", options->out, fmt::format("Write {} into this folder", files))
      ->required()
      ->option_text("FOLDER");
  command
      .add_option_function<std::string>(
          "--side",
          [options](const std::string& name) { options->side = name == "left" ? Side::left : Side::right; },
          "The side of the body. A left implant is the right one mirrored")
      ->check(CLI::IsMember({"right", "left"}))
      ->option_text("right|left (right)");
  command
      .add_option_function<int>(
          "--facets",
          [options](int facets) {
            std::visit([&](auto& design) { design.facets = facets; }, options->implant);
          },
          "Facets around liner and neck: with 360 limits are within 0.01 degrees of the closed form; the "
          "error goes with the square")
      ->option_text(fmt::format("N ({})", default_facets));
}

void add_replacement(CLI::App& sample) {
  auto* command = sample.add_subcommand(
      "replacement", "Make a total hip of its sizes, in the sample hip or alone, and a joint file");
  command->footer(
      "Example: condyle sample replacement --inclination 45 --anteversion 20 --out thr\n"
      "         condyle sample replacement --bones none --head-radius 18 --definition anatomic --out alone\n"
      "         condyle rom thr/hip.toml");
  auto options = std::make_shared<ImplantOptions>();
  options->implant = TotalHip{};
  options->bones = Bones::sample;
  add_common(*command, options, "a mesh for each part and hip.toml");
  command
      ->add_option_function<std::string>(
          "--definition",
          [options](const std::string& word) {
            std::get<TotalHip>(options->implant).cup.definition = cup_definition_named(word);
          },
          "Which of Murray's definitions inclination and anteversion of the cup are by")
      ->check(CLI::IsMember({"radiographic", "anatomic", "operative"}))
      ->option_text("radiographic|anatomic|operative (radiographic)");
  command
      ->add_option_function<std::string>(
          "--bones",
          [options](const std::string& word) {
            options->bones = word == "none" ? Bones::none : Bones::sample;
          },
          "Bones around the implant: the sample hip with its usual measures, or none")
      ->check(CLI::IsMember({"sample", "none"}))
      ->option_text("sample|none (sample)");
  command->add_option("--scenario", options->scenario, "How fine the bones are, as in condyle sample hip")
      ->check(CLI::Range(1, 4))
      ->option_text("1..4 (1)");
  const std::vector<std::string> sizes = add_sizes(*command, options);
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
  options->implant = ReverseShoulder{};
  add_common(*command, options, "a mesh for each part and shoulder.toml");
  const std::vector<std::string> sizes = add_sizes(*command, options);
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
