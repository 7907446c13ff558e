#include "io/motion/column_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "condyle/error.hpp"
#include "core/near_name.hpp"
#include "io/file/in_quotes.hpp"

namespace condyle::io {
namespace {

/// The coordinate of a path that ends in "/value"; empty for every other name.
std::string_view coordinate_of(std::string_view column) {
  constexpr std::string_view ending = "/value";
  if (!column.ends_with(ending)) return {};
  column.remove_suffix(ending.size());
  return column.substr(column.rfind('/') + 1);
}

}  // namespace

std::optional<std::size_t> find_column(const MotionTable& table, std::string_view name) {
  const auto& columns = table.columns;
  const auto exact = std::find(columns.begin(), columns.end(), name);
  if (exact != columns.end()) return static_cast<std::size_t>(exact - columns.begin());

  std::optional<std::size_t> found;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (name.empty() || coordinate_of(columns[c]) != name) continue;
    if (found)
      throw FileError(fmt::format("{}: column {} could be {} or {}: give the whole name", table.path.string(),
                                  in_quotes(name), in_quotes(columns[*found]), in_quotes(columns[c])));
    found = c;
  }
  return found;
}

std::size_t column_named(const MotionTable& table, std::string_view name) {
  if (const auto found = find_column(table, name)) return *found;
  std::vector<std::string> known = table.columns;
  for (const std::string& column : table.columns)
    if (const std::string_view coordinate = coordinate_of(column); !coordinate.empty())
      known.emplace_back(coordinate);
  throw FileError(fmt::format("{}: has no column {}{}", table.path.string(), in_quotes(name),
                              core::did_you_mean(name, known)));
}

}  // namespace condyle::io
