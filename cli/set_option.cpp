#include "set_option.hpp"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <string>
#include <utility>

#include "condyle/error.hpp"

namespace condyle::cli {

ParameterArguments add_set(CLI::App& command) {
  auto given = std::make_shared<std::vector<std::string>>();
  command
      .add_option(
          "--set", *given,
          "Move a part of the joint file to this value of its parameter, such as cup.inclination=42, or "
          "several in one text; any number")
      ->expected(1)
      ->take_all()
      ->option_text("PART.PARAMETER=VALUE ...");
  return given;
}

io::LoadedJoint joint_at(io::LoadedJoint loaded, const ParameterArguments& given) {
  if (given->empty()) return loaded;
  std::string text;
  for (const std::string& words : *given) text += words + " ";
  try {
    return with_parameters(loaded, parse_parameters(text));
  } catch (const UsageError& error) {
    throw UsageError(std::string("--set: ") + error.what());
  }
}

}  // namespace condyle::cli
