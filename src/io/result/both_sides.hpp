#pragma once

#include <string>

#include "io/result/rom_result.hpp"

/// The limits of a left and a right joint of one body, beside each other.

namespace condyle::io {

/// A line for each motion that both have, with both limits and how much farther the left one turns; then the total arcs.
std::string both_sides_text(const RomResult& left, const RomResult& right);
/// The same as a table, numbers to the last bit: empty where no contact of bones ends a motion.
std::string both_sides_csv(const RomResult& left, const RomResult& right);

}  // namespace condyle::io
