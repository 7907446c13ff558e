#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// Texts of strangers' files and names, as a terminal may get them.

namespace condyle::io {

/// Whether a line end ends a line, or is a control character like any other.
enum class LineEnds { keep, replace };

/// The text without what a terminal obeys: a blank in the place of each control character (C0, DEL and C1 of ECMA-48) and of
/// each character that begins a line or turns the direction of writing (U+2028, U+2029, U+202A to U+202E, U+2066 to U+2069), a
/// question mark in the place of each byte that is not part of UTF-8.
std::string plain_text(std::string_view text, LineEnds line_ends = LineEnds::replace);

/// JSON as it was written, with such characters in its strings as escapes of JSON; line ends stay.
std::string escaped_json(std::string_view json);

/// C0, DEL, or C1 in UTF-8.
bool has_control_character(std::string_view text) noexcept;

/// Appends the bytes of UTF-8 of a character.
void append_utf8(std::string& text, std::uint32_t character);

/// Where the first byte lies that is not part of UTF-8 (RFC 3629); the size where there is none.
std::size_t end_of_utf8(std::string_view text) noexcept;

}  // namespace condyle::io
