#include "fuzz/one_line.hpp"

#include "core/one_line.hpp"

namespace condyle::test {

std::string fault_of_message(std::string_view message, std::string_view begins_with) {
  constexpr std::size_t longest = 400;
  if (message.empty()) return "an empty message";
  if (!message.starts_with(begins_with))
    return "a message that does not begin with its file: " + std::string(message);
  if (core::one_line(message, longest + begins_with.size()).size() < message.size())
    return "a message too long for a line: " + std::string(message);
  if (core::one_line(message, message.size()) != message)
    return "a message that is not one line of characters that no terminal obeys: " + std::string(message);
  return {};
}

}  // namespace condyle::test
