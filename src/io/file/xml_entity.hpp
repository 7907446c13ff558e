#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace condyle::io {

/// Appends the character of the entity that `text` begins with, one of the five of XML or &#233;, and gives the entity's
/// length; 0 where none begins there.
std::size_t append_entity(std::string& out, std::string_view text);

}  // namespace condyle::io
