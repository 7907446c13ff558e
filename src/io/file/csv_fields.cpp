#include "io/file/csv_fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/utf8.hpp"
#include "io/file/plain_text.hpp"

#include "io/file/words.hpp"
#include "io/motion/table_builder.hpp"

namespace condyle::io {
namespace {

constexpr char32_t backslash = U'\\';
constexpr std::size_t escape_bytes = 6;  // \u001b

/// Apostrophes, then what a spreadsheet computes; a sign only is none.
bool is_formula(std::string_view text) noexcept {
  text.remove_prefix(std::min(text.find_first_not_of('\''), text.size()));
  return text.size() > 1 && std::string_view("=+-@").find(text.front()) != std::string_view::npos;
}

/// The character that an escape at the start of the text stands for, if it is one that csv_field() writes.
std::optional<char32_t> escaped_character(std::string_view text) noexcept {
  if (text.size() < escape_bytes || !text.starts_with("\\u")) return std::nullopt;
  std::uint32_t value = 0;
  const char* const end = text.data() + escape_bytes;
  if (std::from_chars(text.data() + 2, end, value, 16).ptr != end) return std::nullopt;
  const auto character = static_cast<char32_t>(value);
  if (character == 0 || !(core::is_obeyed(character) || character == backslash)) return std::nullopt;
  return character;
}

std::string escaped_for_csv(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto [value, bytes] = core::first_character(text);
    if (core::is_obeyed(value) || escaped_character(text))
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(value));
    else
      out += text.substr(0, std::max<std::size_t>(bytes, 1));
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return out;
}

/// What csv_field() was given.
std::string text_of_field(std::string_view field) {
  if (field.starts_with('\'') && is_formula(field)) field.remove_prefix(1);
  std::string text;
  while (!field.empty()) {
    const auto character = escaped_character(field);
    if (character)
      append_utf8(text, *character);
    else
      text += field.front();
    field.remove_prefix(character ? escape_bytes : 1);
  }
  return text;
}

}  // namespace

std::string csv_field(std::string_view text) {
  double number = 0;
  const bool is_text_of_formula = is_formula(text) && !parse_number(text, number);
  const std::string field = (is_text_of_formula ? "'" : "") + escaped_for_csv(text);
  if (field == text && field.find_first_of(",\"") == field.npos && !field.starts_with('#')) return field;
  std::string quoted = "\"";
  for (const char c : field) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_line(const std::vector<std::string>& fields) {
  return fmt::format("{}\n", fmt::join(fields, ","));
}

std::vector<std::string> csv_fields(std::string_view line, std::size_t number, const Source& source) {
  std::vector<std::string> fields(1);
  bool in_quotes = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (c == '"' && in_quotes && line.substr(at + 1).starts_with('"'))
      fields.back() += line[++at];
    else if (c == '"')
      in_quotes = !in_quotes;
    else if (c == ',' && !in_quotes)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  if (in_quotes) source.fail(fmt::format("line {}: a quote is not closed", number));
  for (std::string& field : fields) field = text_of_field(trimmed(field));
  return fields;
}

}  // namespace condyle::io
