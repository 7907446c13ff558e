#pragma once

#include <string>
#include <string_view>

namespace condyle::test {

/// What is wrong with the message of an error, empty if nothing is: it begins as told, and is one line of plain characters
/// that a person reads, however much of an input it quotes.
std::string fault_of_message(std::string_view message, std::string_view begins_with = {});

}  // namespace condyle::test
