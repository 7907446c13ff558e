#include "io/joint/toml_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "condyle/error.hpp"
#include "core/near_name.hpp"
#include "core/one_line.hpp"
#include "io/file/plain_text.hpp"

namespace condyle::io {
namespace {

/// A node's type as people call it.
std::string_view kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

}  // namespace

TomlTable::TomlTable(const std::filesystem::path& path, const toml::table& table, std::string name)
    : path_(&path), table_(&table), name_(std::move(name)) {}

std::string TomlTable::full(std::string_view key) const {
  return name_.empty() ? std::string(key) : fmt::format("{}.{}", name_, key);
}

bool TomlTable::has(std::string_view key) const {
  return table_->contains(key);
}

bool TomlTable::is_text(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node && node->is_string();
}

bool TomlTable::is_list(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node && node->is_array();
}

void TomlTable::fail(std::string_view key, std::string_view what) const {
  const toml::node* node = table_->get(key);
  const auto line = (node ? *node : static_cast<const toml::node&>(*table_)).source().begin.line;
  const std::string said = core::one_line(full(key) + ": ", 100) + core::one_line(what, 300);
  throw FileError(line == 0 ? fmt::format("{}: {}", path_->string(), said)
                            : fmt::format("{}: line {}: {}", path_->string(), line, said));
}

const toml::node* TomlTable::find(std::string_view key) {
  known_.emplace(key);
  return table_->get(key);
}

double TomlTable::finite_number(const toml::node& node, std::string_view key) const {
  if (!node.is_number()) fail(key, fmt::format("must be a number, not {}", kind_of(node)));
  // toml++ gives nothing for a whole number that rounding would change.
  const std::optional<double> value = node.value<double>();
  if (!value) fail(key, "is a whole number beyond 2^53 that no double holds");
  if (!std::isfinite(*value)) fail(key, "must be a finite number");
  return *value;
}

std::string TomlTable::plain(const toml::node& node, std::string_view key) const {
  std::string text = *node.value<std::string>();
  if (has_control_character(text)) fail(key, "must have no control character, such as a line end or a tab");
  return text;
}

std::optional<std::string> TomlTable::text(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_string()) fail(key, fmt::format("must be a text in quotes, not {}", kind_of(*node)));
  return plain(*node, key);
}

std::optional<double> TomlTable::number(std::string_view key) {
  const toml::node* node = find(key);
  return node ? std::optional(finite_number(*node, key)) : std::nullopt;
}

std::optional<long long> TomlTable::integer(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_integer()) fail(key, fmt::format("must be a whole number, not {}", kind_of(*node)));
  return *node->value<std::int64_t>();
}

std::optional<bool> TomlTable::flag(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_boolean()) fail(key, fmt::format("must be true or false, not {}", kind_of(*node)));
  return *node->value<bool>();
}

template <std::size_t N>
std::optional<std::array<double, N>> TomlTable::numbers(std::string_view key, std::string_view count) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const toml::array* array = node->as_array();
  if (!array) fail(key, fmt::format("must be a list of {} numbers, not {}", count, kind_of(*node)));
  if (array->size() != N)
    fail(key, fmt::format("must be a list of {} numbers, not of {}", count, array->size()));
  std::array<double, N> out;
  for (std::size_t i = 0; i < N; ++i) out[i] = finite_number((*array)[i], key);
  return out;
}

std::optional<std::array<double, 2>> TomlTable::pair(std::string_view key) {
  return numbers<2>(key, "two");
}

std::optional<Vec3> TomlTable::triple(std::string_view key) {
  const auto values = numbers<3>(key, "three");
  return values ? std::optional(Vec3((*values)[0], (*values)[1], (*values)[2])) : std::nullopt;
}

std::optional<std::vector<Vec3>> TomlTable::triples(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const toml::array* array = node->as_array();
  if (!array || array->empty() || !array->front().is_array()) return std::vector<Vec3>{*triple(key)};
  std::vector<Vec3> out;
  for (const toml::node& element : *array) {
    const toml::array* point = element.as_array();
    if (!point || point->size() != 3) fail(key, "must be a point of three numbers, or a list of such");
    out.emplace_back(finite_number((*point)[0], key), finite_number((*point)[1], key),
                     finite_number((*point)[2], key));
  }
  return out;
}

std::optional<std::array<double, 16>> TomlTable::sixteen(std::string_view key) {
  return numbers<16>(key, "sixteen");
}

std::optional<std::vector<std::string>> TomlTable::texts(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const toml::array* array = node->as_array();
  if (!array) fail(key, fmt::format("must be a list of texts, not {}", kind_of(*node)));
  std::vector<std::string> out;
  for (const toml::node& element : *array) {
    if (!element.is_string())
      fail(key, fmt::format("must be a list of texts, not with {}", kind_of(element)));
    out.push_back(plain(element, key));
  }
  return out;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const toml::table* table = node->as_table();
  if (!table) fail(key, fmt::format("must be a table, not {}", kind_of(*node)));
  return TomlTable(*path_, *table, full(key));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return {};
  const toml::array* array = node->as_array();
  if (!array) fail(key, fmt::format("must be tables written as [[{}]], not {}", key, kind_of(*node)));
  std::vector<TomlTable> out;
  for (const toml::node& element : *array) {
    const toml::table* table = element.as_table();
    if (!table) fail(key, fmt::format("must be tables written as [[{}]], not {}", key, kind_of(element)));
    out.emplace_back(*path_, *table, fmt::format("{}[{}]", full(key), out.size()));
  }
  return out;
}

std::optional<std::size_t> TomlTable::word(std::string_view key,
                                           std::initializer_list<std::string_view> words) {
  const std::optional<std::string> given = text(key);
  if (!given) return std::nullopt;
  for (std::size_t i = 0; i < words.size(); ++i)
    if (*given == words.begin()[i]) return i;
  fail(key, fmt::format("must be \"{}\", not \"{}\"", fmt::join(words, "\" or \""), *given));
}

std::size_t TomlTable::required_word(std::string_view key, std::initializer_list<std::string_view> words) {
  return required(key, word(key, words));
}

void TomlTable::fail_missing(std::string_view key, std::string_view needed_for) const {
  std::vector<std::string> unread;
  for (const auto& [name, node] : *table_)
    if (!known_.contains(name.str())) unread.emplace_back(name.str());
  const std::string near = core::near_name(key, unread);
  if (near.empty()) fail(key, fmt::format("is missing{}{}", needed_for.empty() ? "" : ": ", needed_for));
  fail(key, fmt::format("is missing; there is \"{}\" (did you mean \"{}\"?)", near, key));
}

void TomlTable::finish() const {
  for (const auto& [key, node] : *table_)
    if (!known_.contains(key.str())) {
      const std::vector<std::string> names(known_.begin(), known_.end());
      fail(key.str(), fmt::format("unknown key{}; known here: {}", core::did_you_mean(key.str(), names),
                                  fmt::join(known_, ", ")));
    }
}

}  // namespace condyle::io
