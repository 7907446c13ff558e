#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace condyle::io {

/// Numbers labels in the order in which they first appear.
class LabelIndices {
 public:
  static constexpr std::uint16_t none = std::numeric_limits<std::uint16_t>::max();
  /// As many as there are numbers beside none.
  static constexpr std::size_t most = none;

  /// The number of a label, none if all numbers are taken.
  std::uint16_t index_of(std::uint32_t label) {
    if (label < small_.size()) {
      auto& index = small_[label];
      if (index == none) index = next(label);
      return index;
    }
    const auto [found, is_new] = large_.try_emplace(label, none);
    if (is_new) found->second = next(label);
    return found->second;
  }

  /// In the order of their numbers.
  const std::vector<std::uint32_t>& labels() const noexcept { return labels_; }

 private:
  std::uint16_t next(std::uint32_t label) {
    if (labels_.size() == most) return none;
    labels_.push_back(label);
    return static_cast<std::uint16_t>(labels_.size() - 1);
  }

  std::vector<std::uint16_t> small_ = std::vector<std::uint16_t>(std::size_t{1} << 16, none);
  /// In order: a hash of labels takes the square of their number if a file chooses them for it.
  std::map<std::uint32_t, std::uint16_t> large_;
  std::vector<std::uint32_t> labels_;
};

}  // namespace condyle::io
