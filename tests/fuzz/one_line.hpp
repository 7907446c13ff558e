#pragma once

#include <string>
#include <string_view>

namespace condyle::test {

/// The fault of an error message, empty if there is none: it must begin as given, and be one line of plain characters
/// that a person reads, however much of an input it quotes.
std::string fault_of_message(std::string_view message, std::string_view begins_with = {});

}  // namespace condyle::test
