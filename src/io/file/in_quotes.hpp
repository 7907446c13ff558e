#pragma once

#include <string>
#include <string_view>

namespace condyle::io {

/// What a message may quote of a text or a file that can hold anything: its start, on one line, plain
/// characters only.
inline std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;  // characters: enough to find the place, short enough for one line
  std::string out = "'";
  for (const char c : text.substr(0, longest)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (text.size() > longest ? "...'" : "'");
}

}  // namespace condyle::io
