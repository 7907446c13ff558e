#pragma once

#include <string_view>

namespace condyle {

/// Major, minor and patch number of these headers and of the library they belong to. Until version 1 a new minor
/// number may change what a program has to say; a new patch number does not.
inline constexpr std::string_view version = "0.2.0";

}  // namespace condyle
