#pragma once

#include <CLI/Formatter.hpp>
#include <string>
#include <vector>

namespace condyle::cli {

/// Options by their long names, in the order of the help: those that most people need first.
struct HelpGroup {
  std::string title;
  std::vector<std::string> options;
};

/// The options of bands, shared by several commands.
HelpGroup uncertainty_group();

/// Help of lines no longer than a terminal is wide: descriptions are broken between words. Options stand in groups; those in
/// no group come last. Help of more than 60 lines ends with the group that still fits, and its last line names those that --help-all has.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::vector<HelpGroup> groups = {});
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_footer(const CLI::App* app) const override;

 private:
  std::vector<HelpGroup> groups_;
};

/// Gives the help of a command its groups. What is asked and recorded does not depend on them.
void group_help(CLI::App& command, std::vector<HelpGroup> groups);

}  // namespace condyle::cli
