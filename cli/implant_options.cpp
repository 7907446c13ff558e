#include "implant_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "choice.hpp"
#include "whole_number.hpp"

namespace condyle::cli {
namespace {

std::string option_name(std::string_view parameter) {
  std::string name = "--" + std::string(parameter);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

std::string value_text(const plan::ImplantParameter& size, const plan::Implant& implant,
                       std::span<const std::string_view> of_bones) {
  const char* unit = size.unit == "mm" ? "MM" : "DEG";
  if (std::find(of_bones.begin(), of_bones.end(), size.name) != of_bones.end())
    return fmt::format("{} (the bone's)", unit);
  return fmt::format("{} ({:g})", unit, size.value(implant));
}

}  // namespace

std::vector<std::string> add_sizes(CLI::App& command, ImplantSizeArguments& given,
                                   std::span<const std::string_view> of_bones) {
  std::vector<std::string> names;
  for (const plan::ImplantParameter& each : plan::implant_parameters(given.implant)) {
    names.push_back(option_name(each.name));
    command
        .add_option_function<double>(
            names.back(),
            [&given, set = each.set, name = each.name](double value) {
              set(given.implant, value);
              given.sizes.insert(name);
            },
            std::string(each.meaning))
        ->option_text(value_text(each, given.implant, of_bones));
  }
  return names;
}

void add_facets(CLI::App& command, ImplantSizeArguments& given) {
  command
      .add_option_function<int>(
          "--facets",
          [&given](int facets) { std::visit([&](auto& design) { design.facets = facets; }, given.implant); },
          "Facets around liner and neck: with 360 limits are within 0.01 degrees of the closed form; the "
          "error goes with the square")
      ->check(whole_number(1))
      ->option_text(fmt::format("N ({})", plan::default_facets));
}

void add_definition(CLI::App& command, ImplantSizeArguments& given) {
  add_choice(command, "--definition", std::get<plan::TotalHip>(given.implant).cup.definition,
             {{"radiographic", CupDefinition::radiographic},
              {"anatomic", CupDefinition::anatomic},
              {"operative", CupDefinition::operative}},
             "Which of Murray's definitions inclination and anteversion of the cup are by", "radiographic");
}

}  // namespace condyle::cli
