#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>
#include <vector>

#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"

/// Command line as answers quote it, and options that several commands share.

namespace condyle::cli {

/// The words of a command that decide its answer, in one order whatever order they were given in: names
/// of commands, arguments, options with their values. Without --out, --json and --threads, so that runs compare.
std::vector<std::string> words_of(const CLI::App& command);

/// --frame and --ascii, for commands that write points and meshes.
struct WhereOptions {
  io::AnswerFrameName frame = io::AnswerFrameName::joint;
  io::VtpEncoding vtp_encoding = io::VtpEncoding::binary;
};
void add_where(CLI::App& command, const std::shared_ptr<WhereOptions>& options);

}  // namespace condyle::cli
