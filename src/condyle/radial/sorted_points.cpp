#include "condyle/radial/sorted_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace condyle {
namespace {

constexpr std::size_t per_block = SortedPoints::points_per_block;

/// Blocks are read sixteen at a time: columns are filled up to a multiple of that.
constexpr std::size_t blocks_read_together = 16;

/// Halves the longest side of the points' box until a block is left, at multiples of a block.
void sort_into_blocks(PointsView points, std::span<Index> range) {
  if (range.size() <= per_block) return;
  Vec3 low = points[range[0]], high = low;
  for (const Index i : range) low = low.cwiseMin(points[i]), high = high.cwiseMax(points[i]);
  int longest = 0;
  (high - low).maxCoeff(&longest);
  const auto along = longest == 0 ? points.x : longest == 1 ? points.y : points.z;
  const std::size_t half = (range.size() / 2 + per_block - 1) / per_block * per_block;
  std::nth_element(range.begin(), range.begin() + static_cast<std::ptrdiff_t>(half), range.end(),
                   [&](Index a, Index b) { return along[a] != along[b] ? along[a] < along[b] : a < b; });
  sort_into_blocks(points, range.first(half));
  sort_into_blocks(points, range.subspan(half));
}

float rounded_up(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

float rounded_down(double value) {
  return std::max(0.0f, std::nextafter(static_cast<float>(value), 0.0f));
}

}  // namespace

SortedPoints::SortedPoints(PointsView points, const Vec3& centre)
    : centre_(centre), block_count_((points.size() + per_block - 1) / per_block), points_(points.size()) {
  index_.resize(points.size());
  for (Index i = 0; i < points.size(); ++i) index_[i] = i;
  sort_into_blocks(points, index_);
  for (auto& column : rounded_) column.resize(block_count_ * per_block);
  for (std::size_t i = 0; i < block_count_ * per_block; ++i) {
    const Vec3 p = points[index_[std::min(i, size() - 1)]];
    if (i < size()) points_.set(i, p);
    const Vec3 about_centre = p - centre_;
    for (int k = 0; k < 3; ++k) {
      rounded_[static_cast<std::size_t>(k)][i] = static_cast<float>(about_centre[k]);
    }
    reach_ = std::max(reach_, about_centre.norm());
  }
  const std::size_t room = (block_count_ + blocks_read_together - 1) / blocks_read_together * blocks_read_together;
  for (auto& column : block_) column.assign(room, 0.0f);
  for (std::size_t block = 0; block < block_count_; ++block) describe_block(block);
}

void SortedPoints::describe_block(std::size_t block) {
  const std::size_t first = block * per_block, last = std::min(first + per_block, size());
  Vec3 sum = Vec3::Zero();
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (std::size_t i = first; i < last; ++i) {
    const Vec3 p = points_[i] - centre_;
    const double radius = p.norm();
    least = std::min(least, radius), greatest = std::max(greatest, radius);
    if (radius > 0) sum += p / radius;
  }
  // The axis is what its floats say, not what they were rounded from.
  const Vec3 unit = sum.norm() > 0 ? Vec3(sum.normalized()) : Vec3(1, 0, 0);
  const Vec3 axis = unit.cast<float>().cast<double>();
  double widest = least > 0 ? 0 : 2;
  for (std::size_t i = first; i < last && least > 0; ++i) {
    const Vec3 p = points_[i] - centre_;
    widest = std::max(widest, (p / p.norm() - axis).norm());
  }
  const auto set = [&](Column column, float value) { block_[column][block] = value; };
  for (int k = 0; k < 3; ++k) set(static_cast<Column>(axis_x + k), static_cast<float>(axis[k]));
  set(chord, rounded_up(widest));
  set(nearest, rounded_down(least));
  set(furthest, rounded_up(greatest));
  // 1 / |p| lies within mean_inverse +- spread; none of that where a point lies at the centre.
  const double infinity = std::numeric_limits<double>::infinity();
  const double mean = least > 0 ? (1 / least + 1 / greatest) / 2 : infinity;
  set(mean_inverse, static_cast<float>(mean));
  set(spread, least > 0 ? rounded_up((1 / least - 1 / greatest) / 2 + mean * 0x1p-23) : 0.0f);
}

}  // namespace condyle
