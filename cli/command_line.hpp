#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "answer.hpp"
#include "io/result/rom_result.hpp"

/// Command line as answers quote it, and options that several commands share.

namespace condyle::cli {

/// The words of a command that decide its answer, in one order whatever order they were given in: names
/// of commands, arguments, options with their values. Without --out, --crate, --json, --verbose and --threads, so that runs compare.
std::vector<std::string> words_of(const CLI::App& command);

/// --out, a folder.
CLI::Option* add_out(CLI::App& command, std::string& out, const std::string& help);
/// --crate, the date of a crate (io/result/crate.hpp).
CLI::Option* add_crate(CLI::App& command, std::optional<std::string>& date);
/// --json; `form` is written while arguments are read.
void add_json(CLI::App& command, AnswerForm& form,
              const char* help = "Print the answer as JSON, with every number in full");

/// --verbose; `form` is written while arguments are read, and say_as() takes it.
void add_verbose(CLI::App& command, io::TextForm& form);
/// How many notes are said: in brief the first ones, and the codes of the others.
void say_as(io::TextForm form);

}  // namespace condyle::cli
