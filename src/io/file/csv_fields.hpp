#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/parse.hpp"

namespace condyle::io {

/// A text as one field of a CSV line (RFC 4180), quoted where it must be. A spreadsheet takes a cell that begins with = + - or @ for
/// a formula, with or without quotes: unless it is a number, an apostrophe stands before it, which marks text there. What a
/// terminal obeys, line ends too, is written as \u001b. csv_fields() takes both off.
std::string csv_field(std::string_view text);

/// Fields as one line, with its end.
std::string csv_line(const std::vector<std::string>& fields);

/// The fields of a line (RFC 4180), quotes taken off and blanks around them too; no field goes over a line's end. Raises
/// FileError that names the line by this number.
std::vector<std::string> csv_fields(std::string_view line, std::size_t number, const Source& source);

}  // namespace condyle::io
