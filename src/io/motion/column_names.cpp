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

/// Whether a path ends in the joint and the coordinate of "knee_r/knee_flex_r", and in "/value".
bool is_path_of(std::string_view column, std::string_view joint_and_coordinate) {
  constexpr std::string_view ending = "/value";
  if (!column.ends_with(ending)) return false;
  column.remove_suffix(ending.size());
  if (!column.ends_with(joint_and_coordinate)) return false;
  column.remove_suffix(joint_and_coordinate.size());
  return column.empty() || column.ends_with('/');
}

}  // namespace

std::optional<std::size_t> find_column(const MotionTable& table, std::string_view name) {
  const auto& columns = table.columns;
  const auto exact = std::find(columns.begin(), columns.end(), name);
  if (exact != columns.end()) return static_cast<std::size_t>(exact - columns.begin());

  // A joint's coordinate has its plain name, or a path that ends with both names. A table that has both could mean either.
  const std::size_t slash = name.rfind('/');
  std::optional<std::size_t> found;
  if (slash != name.npos)
    if (const auto plain = std::find(columns.begin(), columns.end(), name.substr(slash + 1));
        plain != columns.end())
      found = static_cast<std::size_t>(plain - columns.begin());

  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (name.empty() ||
        !(slash == name.npos ? coordinate_of(columns[c]) == name : is_path_of(columns[c], name)))
      continue;
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
  throw FileError(fmt::format("{}: has no column {}{}{}", table.path.string(), in_quotes(name),
                              core::did_you_mean(name, known), those_there(table.columns)));
}

std::string those_there(const std::vector<std::string>& names) {
  constexpr std::size_t most = 20;  // a motion of a whole body has hundreds
  const std::size_t count = names.size(), named = std::min(count, most);
  std::string text = "; it has ";
  for (std::size_t c = 0; c < named; ++c) text += (c == 0 ? "" : ", ") + in_quotes(names[c]);
  return named == count ? text : text + fmt::format(" and {} more", count - named);
}

}  // namespace condyle::io
