#pragma once

#include <string>

namespace condyle::io {

enum class ColumnKind { text, number };

/// A column of a table of results.
struct ResultColumn {
  std::string name;
  std::string unit;  ///< empty if it has none
  ColumnKind kind;
  std::string meaning;
};

}  // namespace condyle::io
