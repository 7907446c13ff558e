#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace condyle::core {

/// printf into a string, for lines of less than 400 characters; the core has no library for text.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace condyle::core
