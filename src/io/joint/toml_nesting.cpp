#include "io/joint/toml_nesting.hpp"

#include <algorithm>

namespace condyle::io {
namespace {

bool is_of_bare_key(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         static_cast<unsigned char>(c) >= 0x80;
}

/// Behind the string that begins at `at` (TOML 1.0, "String"): basic or literal, of one line or of several.
std::size_t end_of_string(std::string_view text, std::size_t at) noexcept {
  const char quote = text[at];
  const bool has_escapes = quote == '"';
  const std::string_view three = has_escapes ? "\"\"\"" : "'''";
  const bool of_lines = text.substr(at).starts_with(three);
  at += of_lines ? 3 : 1;
  for (; at < text.size(); ++at) {
    if (has_escapes && text[at] == '\\') {
      if (of_lines || !text.substr(at + 1).starts_with('\n')) ++at;
    } else if (of_lines && text.substr(at).starts_with(three)) {
      // The last three quotes of up to five end it.
      at += 3;
      for (int more = 0; more < 2 && at < text.size() && text[at] == quote; ++more) ++at;
      return at;
    } else if (!of_lines && (text[at] == quote || text[at] == '\n')) {
      return text[at] == quote ? at + 1 : at;
    }
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> line_nested_too_deep(std::string_view text) noexcept {
  std::size_t line = 1, brackets = 0, parts = 1, at = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      const std::size_t end = std::min(end_of_string(text, at), text.size());
      line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                                  text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      at = end;
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '[' || c == '{') ++brackets;
    if ((c == ']' || c == '}') && brackets > 0) --brackets;
    if (c == '.')
      ++parts;
    else if (c != ' ' && c != '\t' && !is_of_bare_key(c))
      parts = 1;
    if (brackets > most_toml_levels || parts > most_toml_levels) return line;
    line += c == '\n';
    ++at;
  }
  return std::nullopt;
}

}  // namespace condyle::io
