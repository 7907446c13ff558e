#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "condyle/pose.hpp"

namespace bench {

/// Where a line through a cell of an image crosses a surface.
struct Layer {
  float position;     ///< along the line, mm
  std::int32_t step;  ///< of the winding number there, going forwards: +1 into the solid, -1 out of it
  condyle::Index triangle;
};

/// If two lie at one place, because a line touches an edge of the solid's outline, the entry comes first.
inline bool nearer(const Layer& a, const Layer& b) noexcept {
  return a.position < b.position || (a.position == b.position && a.step > b.step);
}

/// The layers of every cell of an image, each cell's from near to far. Filled by `add` in any order, then
/// `sort`ed once; cleared to be filled again without giving its memory back.
class LayeredImage {
 public:
  void clear(std::size_t cells) {
    offset_.assign(cells + 1, 0);
    added_.clear();
  }

  void add(condyle::Index cell, const Layer& layer) {
    ++offset_[cell + 1];
    added_.push_back({cell, layer});
  }

  void sort() {
    for (std::size_t cell = 1; cell < offset_.size(); ++cell) offset_[cell] += offset_[cell - 1];
    layers_.resize(added_.size());
    next_.assign(offset_.begin(), offset_.end() - 1);
    for (const auto& [cell, layer] : added_) layers_[next_[cell]++] = layer;
    for (std::size_t cell = 0; cell + 1 < offset_.size(); ++cell) {
      std::sort(layers_.begin() + offset_[cell], layers_.begin() + offset_[cell + 1], nearer);
    }
  }

  std::span<const Layer> at(condyle::Index cell) const noexcept {
    return std::span(layers_).subspan(offset_[cell], offset_[cell + 1] - offset_[cell]);
  }
  std::size_t cells() const noexcept { return offset_.size() - 1; }
  std::size_t layers() const noexcept { return layers_.size(); }
  std::size_t bytes() const noexcept {
    return offset_.size() * sizeof(offset_[0]) + layers_.size() * sizeof(Layer);
  }

 private:
  struct Added {
    condyle::Index cell;
    Layer layer;
  };
  std::vector<std::uint32_t> offset_, next_;
  std::vector<Added> added_;
  std::vector<Layer> layers_;
};

/// Winding number behind the layers before `position`; 0 in front of all.
inline int winding_at(std::span<const Layer> layers, double position) noexcept {
  int winding = 0;
  for (const Layer& layer : layers) {
    if (layer.position >= position) break;
    winding += layer.step;
  }
  return winding;
}

/// Which side of an edge a line goes by: the sign of `side`, and where that is zero, of the first of
/// `shifted` that is not: how `side` grows when the line is shifted by an infinitesimal step, the same for
/// all edges, so that a line through an edge or a vertex is counted in one triangle and only one. All change
/// their signs, bit for bit, with the edge's direction.
inline bool is_left(double side, std::initializer_list<double> shifted) noexcept {
  for (const double growth : shifted) {
    if (side != 0) break;
    side = growth;
  }
  return side > 0;
}

}  // namespace bench
