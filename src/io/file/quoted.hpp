#pragma once

#include <string>
#include <string_view>

namespace condyle::io {

/// What a message may quote of a text that can hold anything: its start, on one line.
inline std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string out = "'";
  for (const char c : text.substr(0, longest)) out += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  return out + (text.size() > longest ? "...'" : "'");
}

}  // namespace condyle::io
