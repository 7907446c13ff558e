#include "help_formatter.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <algorithm>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace condyle::cli {
namespace {

constexpr std::size_t line_width = 100, description_column = 32;
constexpr std::ptrdiff_t most_lines = 60;

std::ptrdiff_t lines_in(std::string_view text) {
  return std::count(text.begin(), text.end(), '\n');
}

/// Broken between words, with `at_break` before each break, lines after the first indented; lines of the text stay lines, with what
/// they begin with.
std::string wrapped(const std::string& text, std::size_t first_column, std::size_t indent,
                    std::string_view at_break = {}) {
  std::string out;
  std::istringstream lines(text);
  std::size_t column = first_column;
  for (std::string line; std::getline(lines, line);) {
    if (!out.empty()) out += "\n", column = 0;
    const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
    out += line.substr(0, blanks), column += blanks;
    std::istringstream words(line);
    bool begins = true;
    for (std::string word; words >> word; begins = false) {
      if (!begins && column + 1 + word.size() + at_break.size() > line_width) {
        out += std::string(at_break) + "\n" + std::string(indent, ' ');
        column = indent;
      } else if (!begins) {
        out += " ", ++column;
      }
      out += word, column += word.size();
    }
  }
  return out;
}

/// A name and, from one column on, its description.
std::string entry(std::string name, const std::string& description) {
  name = "  " + name;
  if (description.empty()) return name + "\n";
  if (name.size() + 2 > description_column)
    name += "\n" + std::string(description_column, ' ');
  else
    name.resize(description_column, ' ');
  return name + wrapped(description, description_column, description_column) + "\n";
}

/// Without the argument that a command takes, and without --help-all, which the help of a command names where it leaves options out.
std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  const CLI::Option* left_out = app.get_parent() ? app.get_help_all_ptr() : nullptr;
  return app.get_options(
      [&](const CLI::Option* option) { return option->nonpositional() && option != left_out; });
}

}  // namespace

HelpGroup uncertainty_group() {
  return {"Uncertainty", {"--seed", "--sigma-centre", "--sigma-axes", "--sigma-surface"}};
}

HelpFormatter::HelpFormatter(std::vector<HelpGroup> groups) : groups_(std::move(groups)) {
  label("Positionals", "Arguments");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  std::string help = make_description(app) + make_usage(app, std::move(name)) + make_positionals(app);
  std::vector<const CLI::Option*> rest = options_of(*app);
  std::vector<std::pair<std::string, std::string>> groups;  // title and text
  std::ptrdiff_t lines = 0;
  const auto add = [&](const std::string& title, const std::vector<const CLI::Option*>& shown) {
    if (shown.empty()) return;
    groups.emplace_back(title, make_group(title, false, shown));
    lines += lines_in(groups.back().second);
  };
  for (const HelpGroup& group : groups_) {
    std::vector<const CLI::Option*> shown;
    for (const std::string& option : group.options) {
      const auto found = std::find_if(rest.begin(), rest.end(),
                                      [&](const CLI::Option* each) { return each->check_name(option); });
      if (found == rest.end()) continue;
      shown.push_back(*found);
      rest.erase(found);
    }
    add(group.title, shown);
  }
  add(groups_.empty() ? "Options" : "Other", rest);
  std::string end = make_subcommands(app, mode) + "\n" + make_footer(app);
  const bool has_all =
      mode != CLI::AppFormatMode::Normal || lines_in(help) + lines + lines_in(end) <= most_lines;
  std::string left_out;
  std::ptrdiff_t free =
      most_lines - lines_in(help) - lines_in(end) - 2;  // the line on those left out, broken
  for (const auto& [title, text] : groups) {
    free -= lines_in(text);
    if (has_all || (free >= 0 && left_out.empty()))
      help += text;
    else
      left_out += (left_out.empty() ? "More options by --help-all: " : ", ") + title;
  }
  return help + end + (left_out.empty() ? "" : wrapped(left_out, 0, 2) + "\n");
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  std::string name = make_option_name(option, is_positional);
  // A flag's default value, which its description says.
  if (const auto brace = name.find('{'); brace != name.npos) name.erase(brace);
  const std::string& text = option->get_option_text();
  if (!text.empty())
    name += (text.starts_with("[=") ? "" : " ") + text;
  else if (is_positional)
    name += option->get_expected_max() > 1 ? "..." : "";
  else if (option->get_type_size() != 0 && !option->get_type_name().empty())
    name += " " + option->get_type_name();
  std::vector<std::string> others;
  for (const CLI::Option* other : option->get_excludes()) others.push_back(other->get_name());
  std::sort(others.begin(), others.end());
  std::string description = make_option_desc(option);
  for (std::size_t i = 0; i < others.size(); ++i) description += (i == 0 ? "; not with " : ", ") + others[i];
  if (option->get_required() && !is_positional) description += "; required";
  return entry(std::move(name), description);
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return entry(command->get_name(), command->get_description());
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrapped(CLI::Formatter::make_description(app), 0, 0) + "\n";
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  std::string text;
  std::istringstream lines(app->get_footer());
  for (std::string line; std::getline(lines, line);) {
    // A shell reads a command that goes on after a backslash as one.
    const bool is_command = line.starts_with("Example: ") || line.starts_with(" ");
    text += (is_command ? wrapped(line, 0, 11, " \\") : wrapped(line, 0, 2)) + "\n";
  }
  return text;
}

void group_help(CLI::App& command, std::vector<HelpGroup> groups) {
  command.formatter(std::make_shared<HelpFormatter>(std::move(groups)));
}

}  // namespace condyle::cli
