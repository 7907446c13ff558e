#pragma once

#include <string>
#include <string_view>

namespace condyle::io {

/// A text as one field of a CSV line (RFC 4180): quoted where it must be.
inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace condyle::io
