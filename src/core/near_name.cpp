#include "core/near_name.hpp"

#include <algorithm>
#include <vector>

#include "core/one_line.hpp"

namespace condyle::core {
namespace {

constexpr std::size_t most_changes = 2, longest_name = 100;

/// Changes that make one word of the other, an exchange of neighbours being one (optimal string alignment).
std::size_t changes(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] =
          std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string near_name(std::string_view word, std::span<const std::string> names) {
  std::string nearest;
  std::size_t least = most_changes + 1;
  for (const std::string& name : names) {
    // Names of a file may be of any length, and two long ones compared take the square of it.
    if (name.size() > word.size() + most_changes || word.size() > name.size() + most_changes) continue;
    if (name.size() > longest_name) continue;
    const std::size_t by = changes(word, name);
    if (by < least && 3 * by <= name.size()) least = by, nearest = name;
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> names) {
  const std::string name = near_name(word, names);
  return name.empty() ? name : " (did you mean \"" + one_line(name) + "\"?)";
}

}  // namespace condyle::core
