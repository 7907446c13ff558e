#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>
#include <vector>

#include "condyle/io/joint_file.hpp"

/// --set, of every command that reads a joint.

namespace condyle::cli {

using ParameterArguments = std::shared_ptr<std::vector<std::string>>;

/// Adds the option; its values are written while arguments are read.
ParameterArguments add_set(CLI::App& command);

/// The joint at the values given. Throws UsageError that begins with the option.
io::LoadedJoint joint_at(io::LoadedJoint loaded, const ParameterArguments& given);

}  // namespace condyle::cli
