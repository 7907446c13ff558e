#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Answers as a terminal shows them: lines that are not too long, and tables.

namespace condyle::io {

/// Lines of more than a terminal's width are broken between words, what comes after indented.
std::string wrapped(std::string_view lines);

enum class Align { left, right };

struct TextColumn {
  Align align;
  std::vector<std::string> cells;  ///< its heading first
};

/// A line for each row; all columns have as many cells.
std::string table_text(std::span<const TextColumn> columns);

}  // namespace condyle::io
