#include "io/file/xml_entity.hpp"

#include <charconv>
#include <cstdint>
#include <utility>

#include "io/file/plain_text.hpp"

namespace condyle::io {

std::size_t append_entity(std::string& out, std::string_view text) {
  static constexpr std::pair<std::string_view, char> named[] = {
      {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}};
  for (const auto& [entity, c] : named)
    if (text.starts_with(entity)) return out += c, entity.size();
  if (!text.starts_with("&#")) return 0;
  const std::size_t end = text.substr(0, 12).find(';');
  if (end == text.npos) return 0;
  std::string_view digits = text.substr(2, end - 2);
  const bool is_hex = digits.starts_with('x');
  if (is_hex) digits.remove_prefix(1);
  std::uint32_t code = 0;
  const auto [last, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), code, is_hex ? 16 : 10);
  const bool is_character = code > 0 && code < 0x110000 && !(code >= 0xd800 && code < 0xe000);
  if (error != std::errc() || last != digits.data() + digits.size() || !is_character) return 0;
  append_utf8(out, code);
  return end + 1;
}

}  // namespace condyle::io
