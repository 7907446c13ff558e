#pragma once

#include <CLI/Formatter.hpp>
#include <string>

namespace condyle::cli {

/// Help of lines no longer than a terminal is wide: descriptions are broken between words.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_footer(const CLI::App* app) const override;
};

}  // namespace condyle::cli
