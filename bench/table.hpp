#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace bench {

/// A text, a count, or a measured value.
using Cell = std::variant<std::string, std::int64_t, double>;

struct Column {
  std::string key;    ///< in JSON, with its unit
  std::string title;  ///< for people
  int digits = 3;     ///< that a measured value is shown with; JSON has all of them
};

struct TableHead {
  std::string name;  ///< in JSON, and of its place in the page
  std::string title;
  std::vector<Column> columns;
  bool is_long = false;  ///< For scripts: in the files, not on the terminal.
};

struct Table {
  TableHead head;
  std::vector<std::vector<Cell>> rows;

  /// One cell per column.
  void add(std::vector<Cell> row);
};

/// Results of a run.
struct Report {
  std::vector<std::pair<std::string, std::string>> machine;
  std::deque<Table> tables;  ///< references to them last
  std::vector<std::string> skipped;
  /// Ratios beside those of the experiment and of commands: times Condyle's time, as question/scene/method.
  std::map<std::string, double> ratios;
  /// Where an answer and a peer's do not agree: a table of times is worth nothing then.
  std::vector<std::string> disagreements;

  /// The table of that name, with the rows it has so far.
  Table& table(const TableHead& head);
};

/// A cell as people read it.
std::string text(const Cell& cell, int digits);

/// Columns aligned, numbers to the right.
std::string terminal_text(const Table& table);

/// One line per row after the one of the keys, commas between; texts with a comma in double quotes.
std::string csv_text(const Table& table);

/// Keys in the order of the columns; what a script needs to lay the tables out again is there too.
nlohmann::ordered_json to_json(const Report& report);

}  // namespace bench
