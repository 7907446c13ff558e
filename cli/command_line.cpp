#include "command_line.hpp"

#include <algorithm>
#include <array>

#include "choice.hpp"

namespace condyle::cli {
namespace {

/// Options for the place and format of an answer, not its content.
bool decides_nothing(const std::string& name) {
  constexpr std::array<std::string_view, 4> names = {"--out", "--crate", "--json", "--verbose"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

void add_words(const CLI::Option& option, std::vector<std::string>& words) {
  const std::vector<std::string> values = option.results();
  if (option.get_positional()) {
    words.insert(words.end(), values.begin(), values.end());
    return;
  }
  const std::string name = option.get_name();
  if (decides_nothing(name)) return;
  const bool is_flag = option.get_items_expected_max() == 0 || option.get_type_size_max() == 0;
  if (is_flag) {
    for (const std::string& value : values) words.push_back(value == "true" ? name : name + "=" + value);
  } else if (option.get_items_expected_min() > 1) {
    words.push_back(name);
    words.insert(words.end(), values.begin(), values.end());
  } else {
    for (const std::string& value : values) words.insert(words.end(), {name, value});
  }
}

}  // namespace

std::vector<std::string> words_of(const CLI::App& command) {
  std::vector<std::string> words = {command.get_name()};
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 0) add_words(*option, words);
  }
  return words;
}

CLI::Option* add_out(CLI::App& command, std::string& out, const std::string& help) {
  return add_value(command, "--out", out, "FOLDER", help);
}

CLI::Option* add_crate(CLI::App& command, std::optional<std::string>& date) {
  return add_value(command, "--crate", date, "YYYY-MM-DD",
                   "Say in ro-crate-metadata.json which files were made of which, as a Process Run Crate of "
                   "RO-Crate that was published on this day: results have no date of their own");
}

void add_verbose(CLI::App& command, io::TextForm& form) {
  add_flag(command, "--verbose", form, io::TextForm::whole,
           "Print the table of bands, every caveat with its source and every note too");
}

void say_as(io::TextForm form) {
  if (form == io::TextForm::brief) say_at_most(3);
}

void add_json(CLI::App& command, AnswerForm& form, const char* help) {
  add_flag(command, "--json", form, AnswerForm::json, help);
}

}  // namespace condyle::cli
