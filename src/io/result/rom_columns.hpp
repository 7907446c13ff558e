#pragma once

#include <string>
#include <vector>

#include "condyle/io/rom_result.hpp"

namespace condyle::io {

/// Names of the columns of rom_csv(), which has what each one means in docs/formats-rom.md and leaves clock_hour out where the
/// joint is no hip.
std::vector<std::string> rom_columns(Anatomy joint);

/// The fields of one limit in that order, quoted where they must be, empty where there is no answer.
std::vector<std::string> rom_fields(const RomResult& result, std::size_t limit);

/// As one line of a table, with its end.
std::string csv_line(const std::vector<std::string>& fields);

}  // namespace condyle::io
