#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/recorded_motion.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {

/// Gathers the rows of a table, each cell checked as it comes.
class TableBuilder {
 public:
  explicit TableBuilder(const Source& source) : source_(source) {}

  /// The names of the columns, which stand in this line. Each must be there, once.
  void name_columns(std::vector<std::string> names, std::size_t line);
  /// One row of cells, without blanks around them; an empty cell is a gap.
  void add_row(std::span<const std::string_view> cells, std::size_t line);
  /// The whole table; checks that there are rows and that times increase.
  MotionTable finish();

  MotionTable table;  ///< header and processing are the reader's to fill

 private:
  double cell(std::string_view text, std::size_t column, std::size_t line) const;

  Source source_;
};

// One reader per format; each raises FileError only.
MotionTable read_opensim_table(const Source& source);
MotionTable read_csv_table(const Source& source);

/// The column that says when, by its place; `columns.size()` where there is none.
std::size_t time_column(const MotionTable& table);

}  // namespace condyle::io
