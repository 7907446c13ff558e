#include "model_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "choice.hpp"
#include "condyle/error.hpp"
#include "io/mesh/parse.hpp"
#include "io/mesh/polygon_rule.hpp"

namespace condyle::cli {

void add_anatomy(CLI::App& command, std::optional<Anatomy>& anatomy, const std::string& help,
                 const std::string& otherwise) {
  std::vector<std::string> words;
  for (const Anatomy each : all_anatomies) words.emplace_back(name_of(each));
  add_words(
      command, "--anatomy", words, [&anatomy](std::size_t place) { anatomy = all_anatomies[place]; }, help,
      otherwise);
}

void add_geometry(CLI::App& command, std::vector<std::string>& folders) {
  add_value(command, "--geometry", folders, "FOLDER",
            "Look for a model's meshes here too, after its own folder and its folder Geometry; any number")
      ->allow_extra_args(false);
}

void add_polygons(CLI::App& command, std::optional<io::PolygonRule>& polygons, const std::string& otherwise) {
  command
      .add_option_function<std::string>(
          "--polygons", [&polygons](const std::string& rule) { polygons = io::polygon_rule_named(rule); },
          "What to do with polygons of more than three corners: refuse them; split them where their surface "
          "is certain "
          "or nearly so; or guess it of twisted ones too. Default: " +
              otherwise)
      ->check(CLI::IsMember(io::polygon_rules()))
      ->option_text("refuse|split|guess");
}

void add_repair(CLI::App& command, std::vector<std::string>& repairs) {
  add_value(command, "--repair", repairs, "weld,drop_unreferenced,flip_inverted",
            "Make these repairs, which lose nothing, in this order")
      ->delimiter(',')
      ->allow_extra_args(false);
}

void add_model(CLI::App& command, ModelOptions& options) {
  add_anatomy(command, options.anatomy,
              "The kind of a model's joint. Default: by the names of joint and bodies");
  add_value(command, "--contact", options.contact, "NAME",
            "The contact of a model between the two bodies. Default: the first");
  add_geometry(command, options.geometry);
  add_polygons(command, options.polygons, "refuse; for meshes of a model split");
}

std::vector<std::string> model_names() {
  return {"--anatomy", "--contact", "--geometry", "--polygons"};
}

void add_side(CLI::App& command, std::optional<Side>& side, const std::string& help) {
  add_choice(command, "--side", side, {{"right", Side::right}, {"left", Side::left}}, help);
}

bool is_model(const std::string& path) {
  return io::lower_case(path).ends_with(".osim");
}

io::Model model_of(const std::string& path, const std::vector<std::string>& geometry) {
  const std::vector<std::filesystem::path> folders(geometry.begin(), geometry.end());
  return io::read_model(path, folders);
}

io::ModelJointRequest request_of(const io::Model& model, const ModelOptions& options,
                                 const std::string& joint, const std::optional<Side>& side) {
  if (joint.empty()) {
    std::string names;
    for (const io::ModelJoint& of : model.joints)
      if (!of.name.empty()) names += (names.empty() ? "" : ", ") + of.name;
    throw UsageError(fmt::format("--joint: is needed, one of {}", names.empty() ? "none" : names));
  }
  return {.joint = joint,
          .joint_file = {},
          .anatomy = options.anatomy,
          .side = side,
          .contact = options.contact,
          .polygons = options.polygons.value_or(io::PolygonRule::split)};
}

}  // namespace condyle::cli
