#pragma once

#include <CLI/App.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/implant.hpp"

/// Options on the sizes of an implant, shared by the commands that make one.

namespace condyle::cli {

struct ImplantSizeArguments {
  plan::Implant implant;
  std::set<std::string_view> sizes = {};  ///< the names of those that were given
};

/// Adds the options of all sizes, and returns their names. `given` is written while arguments are read. The help names `of_bones` in place of a
/// default where the size is in this list.
std::vector<std::string> add_sizes(CLI::App& command, ImplantSizeArguments& given,
                                   std::span<const std::string_view> of_bones = {});

/// --facets.
void add_facets(CLI::App& command, ImplantSizeArguments& given);

/// --definition, of a total hip.
void add_definition(CLI::App& command, ImplantSizeArguments& given);

}  // namespace condyle::cli
