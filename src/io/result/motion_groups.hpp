#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace condyle::io {

/// Names of motions under a heading each, in the order of their first ones: a line per heading.
class MotionGroups {
 public:
  void add(const std::string& heading, std::string motion) {
    const auto same = std::find_if(groups_.begin(), groups_.end(),
                                   [&](const auto& group) { return group.first == heading; });
    (same == groups_.end() ? groups_.emplace_back(heading, std::vector<std::string>()) : *same)
        .second.push_back(std::move(motion));
  }
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const auto& [heading, motions] : groups_)
      text += fmt::format("    {}: {}\n", heading, fmt::join(motions, ", "));
    return text;
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> groups_;
};

}  // namespace condyle::io
