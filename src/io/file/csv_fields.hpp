#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/parse.hpp"

namespace condyle::io {

/// The fields of a line (RFC 4180), quotes taken off and blanks around them too; no field goes over a line's end. Raises
/// FileError that names the line by this number.
std::vector<std::string> csv_fields(std::string_view line, std::size_t number, const Source& source);

}  // namespace condyle::io
