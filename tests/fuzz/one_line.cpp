#include "fuzz/one_line.hpp"

#include <algorithm>

namespace condyle::test {

std::string fault_of_message(std::string_view message, std::string_view begins_with) {
  constexpr std::size_t longest = 400;
  if (message.empty()) return "an empty message";
  if (!message.starts_with(begins_with))
    return "a message that does not begin with its file: " + std::string(message);
  if (message.size() > longest + begins_with.size())
    return "a message too long for a line: " + std::string(message);
  if (!std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }))
    return "a message that is not one line of plain characters: " + std::string(message);
  return {};
}

}  // namespace condyle::test
