#include "direction_order.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace bench {
namespace {

using condyle::Index;
using condyle::Vec3;

/// Fine enough that a cell holds few vertices of the largest mesh: 6 * 64 * 64 cells.
constexpr int bits_per_side = 6;

/// The bits of v, a zero between each two.
std::uint32_t spread(std::uint32_t v) noexcept {
  std::uint32_t out = 0;
  for (int bit = 0; bit < bits_per_side; ++bit) out |= (v >> bit & 1) << 2 * bit;
  return out;
}

std::uint32_t cell_along_curve(const Vec3& v) noexcept {
  Index axis = 0;
  const double largest = v.cwiseAbs().maxCoeff(&axis);
  if (largest == 0) return 0;
  const auto step = [&](double s) {
    constexpr int side = 1 << bits_per_side;
    return static_cast<std::uint32_t>(std::min(side - 1, static_cast<int>((s / largest + 1) * 0.5 * side)));
  };
  const std::uint32_t face = v[axis] < 0 ? axis + 3 : axis;
  return face << 2 * bits_per_side | spread(step(v[(axis + 1) % 3])) | spread(step(v[(axis + 2) % 3])) << 1;
}

}  // namespace

std::vector<Index> by_direction(condyle::PointsView points) {
  struct Key {
    std::uint32_t cell;
    double squared_radius;
    Index vertex;
    auto order() const { return std::tie(cell, squared_radius, vertex); }
  };
  std::vector<Key> keys;
  keys.reserve(points.size());
  for (Index v = 0; v < points.size(); ++v)
    keys.push_back({cell_along_curve(points[v]), points[v].squaredNorm(), v});
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.order() < b.order(); });
  std::vector<Index> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const Key& key) { return key.vertex; });
  return order;
}

}  // namespace bench
