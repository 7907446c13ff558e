#pragma once

#include <string>
#include <string_view>

namespace condyle::io {

/// Text between tags or in double quotes, whatever a name holds. Control characters, which XML 1.0 does not have, are blanks.
std::string xml_escaped(std::string_view text);

}  // namespace condyle::io
