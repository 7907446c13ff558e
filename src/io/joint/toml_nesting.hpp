#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace condyle::io {

/// Parts of a key, and lists and tables in each other, that a joint file may have: four are what its deepest key needs. The
/// parser goes down and up a file's levels by recursion, and as many as a file can have are more than a stack holds.
inline constexpr std::size_t most_toml_levels = 16;

/// The first line, from 1, where a key has more parts than that or brackets stand in more brackets; nothing if the whole file may be
/// parsed: its tables then are at most 18 x 16 deep. A text that is no TOML may pass.
std::optional<std::size_t> line_nested_too_deep(std::string_view text) noexcept;

}  // namespace condyle::io
