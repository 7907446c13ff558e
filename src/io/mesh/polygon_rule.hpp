#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/mesh_file.hpp"

namespace condyle::io {

/// "refuse", "split" and "guess": the words of the rule in joint files, on the command line and in Python, in the order of its values.
std::vector<std::string> polygon_rules();

std::string_view name_of(PolygonRule rule) noexcept;

/// The rule of one of these words. Throws UsageError that lists them for every other.
PolygonRule polygon_rule_named(std::string_view word);

/// "split 12 polygons into triangles, 3 of them by a guess: their corners are up to 0.4 off one plane", in the file's unit; empty
/// if none was split.
std::string split_text(std::size_t split, std::size_t guessed, double guessed_within);

}  // namespace condyle::io
