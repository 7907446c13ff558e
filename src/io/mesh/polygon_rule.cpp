#include "io/mesh/polygon_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "condyle/error.hpp"
#include "core/counted.hpp"
#include "io/file/in_quotes.hpp"

namespace condyle::io {

namespace {

constexpr std::array<std::string_view, 3> rule_names{"refuse", "split", "guess"};

}  // namespace

std::vector<std::string> polygon_rules() {
  return {rule_names.begin(), rule_names.end()};
}

std::string_view name_of(PolygonRule rule) noexcept {
  return rule_names[static_cast<std::size_t>(rule)];
}

PolygonRule polygon_rule_named(std::string_view word) {
  const auto found = std::find(rule_names.begin(), rule_names.end(), word);
  if (found == rule_names.end())
    throw UsageError(fmt::format("polygons: {} is none; there are refuse, split and guess", in_quotes(word)));
  return static_cast<PolygonRule>(found - rule_names.begin());
}

std::string split_text(std::size_t split, std::size_t guessed, double guessed_within) {
  if (split == 0) return {};
  std::string text = fmt::format("split {} into triangles", core::counted(split, "polygon", "polygons"));
  if (guessed > 0)
    text += fmt::format(", {} of them by a guess: their corners are up to {:.2g} off one plane", guessed,
                        guessed_within);
  return text;
}

}  // namespace condyle::io
