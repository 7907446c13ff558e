#include "whole_number.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <string>

#include "io/file/in_quotes.hpp"

namespace condyle::cli {

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  return CLI::Validator(
      [least, most](std::string& text) {
        std::uint64_t value = 0;
        const char* const last = text.data() + text.size();
        const auto [end, error] = std::from_chars(text.data(), last, value);
        if (error != std::errc() || end != last || value < least || value > most)
          return fmt::format("{} is no whole number from {} to {}", io::in_quotes(text), least, most);
        text = std::to_string(value);  // zeros before it would make it octal
        return std::string();
      },
      "");
}

CLI::Validator seed_number() {
  return whole_number(0, std::numeric_limits<std::uint64_t>::max());
}

}  // namespace condyle::cli
