#pragma once

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <cstdint>
#include <limits>

namespace condyle::cli {

/// More than any file or machine has of anything that is counted.
inline constexpr std::uint64_t most_counted = std::numeric_limits<std::int32_t>::max();

/// Accepts a whole number in decimal digits from `least` to `most`, and refuses everything else in one line with both: CLI11 by itself
/// takes -1 for the largest number, 0x10 and 010 for 16 and 8, and a number too large for the largest one that it can hold. Bounds
/// of what is counted are the library's.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most = most_counted);

/// The same for seeds.
CLI::Validator seed_number();

}  // namespace condyle::cli
