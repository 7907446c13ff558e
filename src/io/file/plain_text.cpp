#include "io/file/plain_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/utf8.hpp"

namespace condyle::io {

using core::first_character;
using core::is_control;
using core::is_obeyed;

std::string plain_text(std::string_view text, LineEnds line_ends) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto [value, bytes] = first_character(text);
    if (bytes == 0)
      out += '?';
    else if (is_obeyed(value) && !(value == '\n' && line_ends == LineEnds::keep))
      out += ' ';
    else
      out += text.substr(0, bytes);
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return out;
}

std::string escaped_json(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  while (!json.empty()) {
    const auto [value, bytes] = first_character(json);
    if (is_obeyed(value) && value != '\n')
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(value));
    else
      out += json.substr(0, std::max<std::size_t>(bytes, 1));
    json.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return out;
}

bool has_control_character(std::string_view text) noexcept {
  while (!text.empty()) {
    const auto [value, bytes] = first_character(text);
    if (bytes > 0 && is_control(value)) return true;
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return false;
}

void append_utf8(std::string& text, std::uint32_t character) {
  const auto byte = [&](std::uint32_t value) { text += static_cast<char>(value); };
  if (character < 0x80) {
    byte(character);
  } else if (character < 0x800) {
    byte(0xc0 | character >> 6), byte(0x80 | (character & 0x3f));
  } else if (character < 0x10000) {
    byte(0xe0 | character >> 12), byte(0x80 | (character >> 6 & 0x3f)), byte(0x80 | (character & 0x3f));
  } else {
    byte(0xf0 | character >> 18), byte(0x80 | (character >> 12 & 0x3f)), byte(0x80 | (character >> 6 & 0x3f)),
        byte(0x80 | (character & 0x3f));
  }
}

std::size_t end_of_utf8(std::string_view text) noexcept {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t bytes = first_character(text.substr(at)).bytes;
    if (bytes == 0) break;
    at += bytes;
  }
  return at;
}

}  // namespace condyle::io
