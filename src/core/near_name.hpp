#pragma once

#include <span>
#include <string>
#include <string_view>

namespace condyle::core {

/// The name that a mistyped one was most likely meant to be: at most two letters put in, left out, changed or exchanged
/// with their neighbour, and no more than a third of them; the first of those as near. Empty if none is, and for words of more
/// than a hundred letters. Case counts.
std::string near_name(std::string_view word, std::span<const std::string> names);

/// " (did you mean "centre"?)" in plain characters, or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string> names);

}  // namespace condyle::core
