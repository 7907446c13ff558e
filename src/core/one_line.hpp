#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace condyle::core {

/// Quotation, for messages, of a file or of a user's words: its first characters, with a question mark in the place of each byte
/// that is not part of UTF-8 and of each character that a terminal obeys, so that the message stays one line.
std::string one_line(std::string_view text, std::size_t longest = 200);

}  // namespace condyle::core
