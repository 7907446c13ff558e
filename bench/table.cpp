#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/file/csv_fields.hpp"

namespace bench {
namespace {

bool is_text(const Cell& cell) {
  return std::holds_alternative<std::string>(cell);
}

/// In digits that matter and without an exponent, where that is how people write the number.
std::string measured(double value, int digits) {
  const double size = std::abs(value);
  if (value == 0 || size < 1e-3 || size >= 1e7) return fmt::format("{:.{}g}", value, digits);
  const int before_point = static_cast<int>(std::floor(std::log10(size))) + 1;
  return fmt::format("{:.{}f}", value, std::max(0, digits - before_point));
}

}  // namespace

void Table::add(std::vector<Cell> row) {
  assert(row.size() == head.columns.size());
  rows.push_back(std::move(row));
}

Table& Report::table(const TableHead& head) {
  const auto found = std::find_if(tables.begin(), tables.end(),
                                  [&](const Table& table) { return table.head.name == head.name; });
  return found != tables.end() ? *found : tables.emplace_back(Table{head, {}});
}

std::string text(const Cell& cell, int digits) {
  if (const auto* words = std::get_if<std::string>(&cell)) return *words;
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *count);
  return measured(std::get<double>(cell), digits);
}

std::string terminal_text(const Table& table) {
  const auto& columns = table.head.columns;
  std::string out = table.head.title + "\n";
  std::vector<std::vector<std::string>> lines(table.rows.size() + 1);
  for (const Column& column : columns) lines[0].push_back(column.title);
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c)
      lines[r + 1].push_back(text(table.rows[r][c], columns[c].digits));
  for (const auto& line : lines) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      std::size_t width = 0;
      for (const auto& other : lines) width = std::max(width, other[c].size());
      const bool left = !table.rows.empty() && is_text(table.rows[0][c]);
      out += left ? fmt::format("  {:<{}}", line[c], width) : fmt::format("  {:>{}}", line[c], width);
    }
    out += "\n";
  }
  return out;
}

std::string csv_text(const Table& table) {
  const auto field = [](const Cell& cell) {
    if (const auto* words = std::get_if<std::string>(&cell)) return condyle::io::csv_field(*words);
    if (const auto* count = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *count);
    return fmt::format("{}", std::get<double>(cell));
  };
  std::string out;
  for (const Column& column : table.head.columns) out += (out.empty() ? "" : ",") + column.key;
  for (const auto& row : table.rows) {
    out += "\n";
    for (std::size_t c = 0; c < row.size(); ++c) out += (c == 0 ? "" : ",") + field(row[c]);
  }
  return out + "\n";
}

nlohmann::ordered_json to_json(const Report& report) {
  using json = nlohmann::ordered_json;
  json out;
  for (const auto& [name, words] : report.machine) out["machine"][name] = words;
  out["disagreements"] = report.disagreements;
  out["skipped"] = report.skipped;
  out["tables"] = json::array();
  for (const Table& table : report.tables) {
    json t;
    t["name"] = table.head.name;
    t["title"] = table.head.title;
    for (const Column& column : table.head.columns)
      t["columns"].push_back({{"key", column.key}, {"title", column.title}, {"digits", column.digits}});
    t["rows"] = json::array();
    for (const auto& row : table.rows) {
      json r, shown;
      for (std::size_t c = 0; c < row.size(); ++c) {
        const Column& column = table.head.columns[c];
        std::visit([&](const auto& value) { r[column.key] = value; }, row[c]);
        shown.push_back(text(row[c], column.digits));
      }
      t["rows"].push_back(r);
      t["shown"].push_back(shown);
    }
    out["tables"].push_back(t);
  }
  return out;
}

}  // namespace bench
