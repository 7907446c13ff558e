#pragma once

#include <string>
#include <string_view>

#include "condyle/inspect.hpp"

/// Repairs by the names that joint files and the command line give them.

namespace condyle::io {

/// The repair of that name; throws UsageError that lists the valid names.
Repair repair_named(std::string_view name);
std::string_view name_of(Repair repair) noexcept;

/// "weld: merged 12 duplicate vertices", for reports.
std::string describe(const RepairDone& done);

}  // namespace condyle::io
