#include "core/one_line.hpp"

#include <algorithm>

#include "core/utf8.hpp"

namespace condyle::core {

std::string one_line(std::string_view text, std::size_t longest) {
  std::string out;
  for (std::size_t characters = 0; !text.empty(); ++characters) {
    if (characters == longest) return out + "...";
    const auto [value, bytes] = first_character(text);
    if (bytes == 0 || is_obeyed(value))
      out += '?';
    else
      out += text.substr(0, bytes);
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return out;
}

}  // namespace condyle::core
