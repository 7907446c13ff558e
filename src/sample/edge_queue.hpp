#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <tuple>
#include <vector>

#include "condyle/pose.hpp"

namespace condyle::sample {

/// Edges, the shortest first; of equal lengths by their vertices. A heap of one narrow range of lengths at a
/// time: one of all edges of a fine mesh would not stay in the cache.
class EdgeQueue {
 public:
  /// Length and both vertices.
  using Edge = std::tuple<double, Index, Index>;

  /// Lengths up to `longest` > 0 are spread over the ranges; longer ones are in the last.
  explicit EdgeQueue(double longest) : ranges_per_length_(ranges / longest), later_(ranges) {}

  void push(const Edge& edge) {
    const double range = std::get<0>(edge) * ranges_per_length_;
    const std::size_t at = range < ranges - 1 ? static_cast<std::size_t>(range) : ranges - 1;
    if (at > now_) {
      later_[at].push_back(edge);
    } else {
      heap_.push_back(edge);
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
  }

  bool empty() {
    while (heap_.empty() && now_ + 1 < ranges) {
      heap_.swap(later_[++now_]);
      std::make_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
    return heap_.empty();
  }

  /// The queue must have been asked whether it is empty since the last one was taken.
  Edge pop() {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const Edge first = heap_.back();
    heap_.pop_back();
    return first;
  }

 private:
  static constexpr std::size_t ranges = 1024;

  double ranges_per_length_;
  std::size_t now_ = 0;
  std::vector<Edge> heap_;                ///< of ranges up to `now_`
  std::vector<std::vector<Edge>> later_;  ///< by range, unsorted
};

}  // namespace condyle::sample
