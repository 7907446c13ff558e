#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace condyle::core {

/// Quotation, for messages, of a file or of a user's words: its start, plain characters only, so that the message
/// stays one line.
inline std::string one_line(std::string_view text, std::size_t longest = 200) {
  std::string out;
  for (const char c : text.substr(0, longest)) out += c >= ' ' && c <= '~' ? c : '?';
  return text.size() > longest ? out + "..." : out;
}

}  // namespace condyle::core
