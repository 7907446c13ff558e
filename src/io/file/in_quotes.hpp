#pragma once

#include <string>
#include <string_view>

#include "core/one_line.hpp"

namespace condyle::io {

/// Quotation, for messages, of a text or a file that can hold anything: its start, on one line, plain characters
/// only.
inline std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;  // characters: enough to find the place, short enough for one line
  return "'" + core::one_line(text, longest) + "'";
}

}  // namespace condyle::io
