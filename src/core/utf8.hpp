#pragma once

#include <cstddef>
#include <string_view>

/// Characters of texts that strangers wrote.

namespace condyle::core {

/// Behind the last character there can be.
inline constexpr char32_t unicode_end = 0x110000;

struct Character {
  char32_t value;     ///< unicode_end where no character of UTF-8 begins
  std::size_t bytes;  ///< then 0
};

/// The first character of a text that is not empty, by RFC 3629: no longer form than needed, no surrogates, at most U+10FFFF.
Character first_character(std::string_view text) noexcept;

/// C0, DEL or C1 of ECMA-48.
constexpr bool is_control(char32_t c) noexcept {
  return c < 0x20 || (c >= 0x7F && c < 0xA0);
}

/// What a terminal obeys: control characters, and those that begin a line or turn the direction of writing.
constexpr bool is_obeyed(char32_t c) noexcept {
  return is_control(c) || c == 0x2028 || c == 0x2029 || (c >= 0x202A && c <= 0x202E) ||
         (c >= 0x2066 && c <= 0x2069);
}

}  // namespace condyle::core
