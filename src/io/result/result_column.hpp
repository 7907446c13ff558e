#pragma once

#include <string>

namespace condyle::io {

enum class ColumnKind { text, number };
inline constexpr ColumnKind text_column = ColumnKind::text, number_column = ColumnKind::number;

/// A column of a table of results.
struct ResultColumn {
  std::string name;
  std::string unit;  ///< empty if it has none
  ColumnKind kind;
  std::string meaning;
};

}  // namespace condyle::io
