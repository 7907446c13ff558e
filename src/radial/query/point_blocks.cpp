#include "radial/query/point_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace condyle::radial {
namespace {

constexpr std::size_t fan = PointBlocks::fan;

std::size_t rounded_up_to(std::size_t multiple, std::size_t count) {
  return (count + multiple - 1) / multiple * multiple;
}

/// Halves the longest side of the points' box until a block is left, at multiples of a block. A block is in the order of
/// numbers: how nth_element leaves it differs between standard libraries.
void sort_into_blocks(PointsView points, std::span<Index> range) {
  if (range.size() <= fan) {
    std::sort(range.begin(), range.end());
    return;
  }
  Vec3 low = points[range[0]], high = low;
  for (const Index i : range) low = low.cwiseMin(points[i]), high = high.cwiseMax(points[i]);
  int longest = 0;
  (high - low).maxCoeff(&longest);
  const auto along = longest == 0 ? points.x : longest == 1 ? points.y : points.z;
  const std::size_t half = rounded_up_to(range.size() > fan * fan ? fan * fan : fan, range.size() / 2);
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

PointBlocks::PointBlocks(PointsView points, const Vec3& centre) : centre_(centre), point_(points.size()) {
  index_.resize(points.size());
  for (Index i = 0; i < points.size(); ++i) index_[i] = i;
  sort_into_blocks(points, index_);
  for (auto& column : rounded_) column.resize(rounded_up_to(fan, size()));
  for (std::size_t i = 0; i < size(); ++i) point_[i] = points[index_[i]];
  for (std::size_t i = 0; i < rounded_[0].size(); ++i) round(i);
  for (const Vec3& p : point_) reach_ = std::max(reach_, (p - centre_).norm());
  std::size_t count = size();
  for (std::size_t level = 0; level < levels; ++level) {
    block_count_[level] = count = (count + fan - 1) / fan;
    for (auto& column : block_[level]) column.assign(rounded_up_to(fan, count), 0.0f);
    for (std::size_t block = 0; block < count; ++block) describe_block(level, block);
  }
}

void PointBlocks::round(std::size_t i) {
  const Vec3 about_centre = point_[std::min(i, size() - 1)] - centre_;
  for (int k = 0; k < 3; ++k) rounded_[static_cast<std::size_t>(k)][i] = static_cast<float>(about_centre[k]);
}

void PointBlocks::move(PointsView points, std::span<const char> is_moved) {
  const auto has_moved = [&](std::size_t i) { return is_moved.empty() || is_moved[index_[i]]; };
  const auto describe_moved = [&](std::size_t level, std::size_t points_per_block) {
    for (std::size_t block = 0; block < block_count_[level]; ++block) {
      const std::size_t first = block * points_per_block, last = std::min(first + points_per_block, size());
      std::size_t i = first;
      while (i < last && !has_moved(i)) ++i;
      if (i < last) describe_block(level, block);
    }
  };
  for (std::size_t i = 0; i < size(); ++i)
    if (has_moved(i)) point_[i] = points[index_[i]];
  for (std::size_t i = 0; i < rounded_[0].size(); ++i)
    if (has_moved(std::min(i, size() - 1))) round(i);
  reach_ = 0;
  for (const Vec3& p : point_) reach_ = std::max(reach_, (p - centre_).norm());
  describe_moved(0, fan);
  describe_moved(1, fan * fan);
}

void PointBlocks::describe_block(std::size_t level, std::size_t block) {
  const std::size_t points_per_block = level == 0 ? fan : fan * fan;
  const std::size_t first = block * points_per_block, last = std::min(first + points_per_block, size());
  Vec3 sum = Vec3::Zero();
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  std::array<Vec3, fan * fan> direction;
  for (std::size_t i = first; i < last; ++i) {
    const Vec3 p = point_[i] - centre_;
    const double radius = p.norm();
    least = std::min(least, radius), greatest = std::max(greatest, radius);
    if (radius > 0) sum += direction[i - first] = p / radius;
  }
  const Vec3 axis = sum.norm() > 0 ? Vec3(sum.normalized()) : Vec3(1, 0, 0);
  double widest = least > 0 ? 0 : 2;
  if (least > 0)
    for (std::size_t i = 0; i < last - first; ++i) widest = std::max(widest, (direction[i] - axis).norm());
  const auto set = [&](Column column, float value) { block_[level][column][block] = value; };
  for (int k = 0; k < 3; ++k) set(static_cast<Column>(axis_x + k), static_cast<float>(axis[k]));
  // The axis as floats is off by up to 2^-25 in each coordinate.
  set(chord, rounded_up(widest + 0x1p-24));
  set(nearest, rounded_down(least));
  set(furthest, rounded_up(greatest));
  // With a point at the centre there is no cap and no such interval: `nearest` is zero.
  const double infinity = std::numeric_limits<double>::infinity();
  const double mean = least > 0 ? (1 / least + 1 / greatest) / 2 : infinity;
  set(mean_inverse, static_cast<float>(mean));
  set(spread, least > 0 ? rounded_up((1 / least - 1 / greatest) / 2 + mean * 0x1p-23) : 0.0f);
}

}  // namespace condyle::radial
