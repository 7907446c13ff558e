#pragma once

#include <string_view>
#include <vector>

namespace condyle::io {

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text) noexcept;

/// Split at blanks.
std::vector<std::string_view> words_of(std::string_view text);

}  // namespace condyle::io
