#include "io/file/plain_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace condyle::io {
namespace {

/// Behind the last character there can be.
constexpr char32_t unicode_end = 0x110000;

struct CodePoint {
  char32_t value;     ///< unicode_end where no character of UTF-8 begins
  std::size_t bytes;  ///< then 0
};

/// RFC 3629: no longer form than needed, no surrogates, at most U+10FFFF.
CodePoint first_of(std::string_view text) noexcept {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  constexpr std::array<char32_t, 5> smallest = {0, 0, 0x80, 0x800, 0x10000};
  if (lead < 0xC0 || lead > 0xF4 || text.size() < bytes) return {unicode_end, 0};
  char32_t value = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {unicode_end, 0};
    value = value << 6 | (byte(i) & 0x3Fu);
  }
  const bool is_surrogate = value >= 0xD800 && value <= 0xDFFF;
  if (value < smallest[bytes] || value >= unicode_end || is_surrogate) return {unicode_end, 0};
  return {value, bytes};
}

bool is_control(char32_t c) noexcept {
  return c < 0x20 || (c >= 0x7F && c < 0xA0);
}

bool is_obeyed(char32_t c) noexcept {
  return is_control(c) || c == 0x2028 || c == 0x2029 || (c >= 0x202A && c <= 0x202E) ||
         (c >= 0x2066 && c <= 0x2069);
}

}  // namespace

std::string plain_text(std::string_view text, LineEnds line_ends) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto [value, bytes] = first_of(text);
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
    const auto [value, bytes] = first_of(json);
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
    const auto [value, bytes] = first_of(text);
    if (bytes > 0 && is_control(value)) return true;
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return false;
}

std::size_t end_of_utf8(std::string_view text) noexcept {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t bytes = first_of(text.substr(at)).bytes;
    if (bytes == 0) break;
    at += bytes;
  }
  return at;
}

}  // namespace condyle::io
