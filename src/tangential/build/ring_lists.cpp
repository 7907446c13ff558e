#include "tangential/build/ring_lists.hpp"

#include <algorithm>
#include <utility>

#include "tangential/build/box_cells.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangential/build/ring_lists.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace condyle::tangential::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<std::uint32_t, 16>;
constexpr D d;

/// Which of the boxes have no byte above the circle's.
HWY_INLINE hn::Mask<D> holding(hn::Vec<D> boxes, hn::Vec<D> circle) {
#if HWY_TARGET == HWY_SCALAR
  const CellBox box = hn::GetLane(boxes), at = hn::GetLane(circle);
  bool held = true;
  for (int byte = 0; byte < 32; byte += 8) held &= (box >> byte & 0xff) <= (at >> byte & 0xff);
  return hn::MaskFromVec(hn::Set(d, held ? ~0u : 0u));
#else
  constexpr hn::Repartition<std::uint8_t, D> bytes;
  const auto excess = hn::SaturatedSub(hn::BitCast(bytes, boxes), hn::BitCast(bytes, circle));
  return hn::Eq(hn::BitCast(d, excess), hn::Zero(d));
#endif
}

/// Stores those lanes of which the mask is set, one behind the other, and returns how many; may write a whole
/// vector.
HWY_INLINE std::size_t store_some(hn::Vec<D> values, hn::Mask<D> mask, Index* to) {
  if constexpr (hn::MaxLanes(d) == 16) {
    hn::StoreU(hn::Compress(values, mask), d, to);
    return hn::CountTrue(d, mask);
  } else {
    // For fewer lanes Highway 1.0.3 permutes by a table, which GCC 12 copies to the stack each time.
    alignas(64) Index lanes[hn::MaxLanes(d)];
    hn::Store(values, d, lanes);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    std::size_t count = 0;
    for (unsigned left = bits[0]; left != 0; left &= left - 1)
      to[count++] = lanes[hwy::Num0BitsBelowLS1Bit_Nonzero32(left)];
    return count;
  }
}

/// `offset` has one entry per cell, plus one; beyond the last entry there is room for two vectors.
std::size_t find_any(const Index* offset, const RingEntry* entries, std::span<const CirclePlace> circles,
                     std::size_t first, CirclePairs& pairs) {
  const std::size_t room = pairs.triangle.size();
  std::size_t count = 0, c = first;
  for (; c < circles.size(); ++c) {
    const Index begin = offset[circles[c].cell], end = offset[circles[c].cell + 1];
    if (count + (end - begin) + hn::MaxLanes(d) > room) break;
    const auto at = hn::Set(d, circles[c].at), number = hn::Set(d, static_cast<Index>(c));
    for (Index i = begin; i < end; i += static_cast<Index>(hn::MaxLanes(d))) {
      hn::Vec<D> triangles, boxes;
      hn::LoadInterleaved2(d, &entries[i].triangle, triangles, boxes);
      const auto held = hn::And(holding(boxes, at), hn::FirstN(d, end - i));
      hn::StoreU(number, d, pairs.circle.data() + count);
      count += store_some(triangles, held, pairs.triangle.data() + count);
    }
  }
  pairs.triangle.resize(count), pairs.circle.resize(count);
  return c;
}

}  // namespace
}  // namespace condyle::tangential::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::tangential {

HWY_EXPORT(find_any);

namespace {

/// Room beyond the last entry, for a vector that starts on it.
constexpr std::size_t room = 16;

/// Puts triangles into the cells of their boxes: first to count them, then to list them.
class Listing {
 public:
  Listing(const ProfileGrid& grid, const AxisVertices& vertices, std::span<const Triangle> triangles,
          const ProfileBoxes& boxes)
      : grid_(grid),
        vertices_(vertices.exact),
        triangles_(triangles),
        boxes_(boxes),
        scale_(grid, vertices.units_per_mm) {}

  /// Adds to the count of each cell how many triangles it lists.
  void count(Index* counts) const {
    for_each_batch([&](const BoxCells& batch, std::size_t first) {
      for (const BoxCells::Column& column : batch.column) {
        for (const Index place : std::span(column.own).first(column.count)) ++counts[column.cell[place]];
      }
      for_each_of_large(batch, first, [&](std::size_t cell, CellBox, Index) { ++counts[cell]; });
    });
  }

  /// Lists each triangle; `next` has for each cell where its next entry goes.
  void list(Index* next, RingEntry* entries) const {
    for_each_batch([&](const BoxCells& batch, std::size_t first) {
      for (const BoxCells::Column& column : batch.column) {
        for (const Index place : std::span(column.own).first(column.count))
          entries[next[column.cell[place]]++] = {static_cast<Index>(first + place), column.box[place]};
      }
      for_each_of_large(batch, first, [&](std::size_t cell, CellBox part, Index t) {
        entries[next[cell]++] = {t, part};
      });
    });
  }

 private:
  template <class Visit>
  void for_each_batch(const Visit& visit) const {
    BoxCells batch;
    for (std::size_t first = 0; first < triangles_.size(); first += batch.most) {
      scale_.cells(boxes_, first, std::min(batch.most, triangles_.size() - first), batch);
      visit(batch, first);
    }
  }

  /// visit(cell, box, triangle) for the cells of the large boxes of a batch.
  template <class Visit>
  void for_each_of_large(const BoxCells& batch, std::size_t first, const Visit& visit) const {
    for (std::size_t k = 0; k < batch.large_count; ++k) {
      const auto t = static_cast<Index>(first + batch.large[k]);
      const BoxSides sides = scale_.sides(boxes_, t);
      const auto& [a, b, c] = triangles_[t];
      for_each_cell(
          grid_, sides, vertices_[a].at, vertices_[b].at, vertices_[c].at,
          [&](Index row, Index column) { visit(grid_.cell(row, column), sides.in_cell(row, column), t); });
    }
  }

  const ProfileGrid& grid_;
  std::span<const AxisVertex> vertices_;
  std::span<const Triangle> triangles_;
  const ProfileBoxes& boxes_;
  BoxScale scale_;
};

}  // namespace

RingLists::RingLists(const AxisVertices& vertices, std::span<const Triangle> triangles,
                     const ProfileBoxes& boxes, std::size_t cells) {
  if (!triangles.empty()) {
    const double mm = 1 / vertices.units_per_mm;
    grid_ = ProfileGrid::over({boxes.rho_min * mm, boxes.rho_max * mm, boxes.z_min * mm, boxes.z_max * mm},
                              cells);
  }
  offset_.resize(grid_.cells() + 1);
  std::fill(offset_.begin(), offset_.end(), 0);
  const Listing listing(grid_, vertices, triangles, boxes);
  // While triangles are listed, each cell's offset stands one to the right, and moves to its end.
  Index* const next = offset_.data() + 1;
  listing.count(next);
  Index sum = 0;
  for (std::size_t cell = 0; cell < grid_.cells(); ++cell) {
    longest_ = std::max<std::size_t>(longest_, next[cell]);
    sum += std::exchange(next[cell], sum);
  }
  entry_.resize(sum + room);
  listing.list(next, entry_.data());
}

std::size_t RingLists::find(std::span<const CirclePlace> circles, std::size_t first,
                            CirclePairs& pairs) const {
  constexpr std::size_t usual = 4096;
  const std::size_t size = std::max(usual, longest_ + room);
  pairs.triangle.resize(size), pairs.circle.resize(size);
  return HWY_DYNAMIC_DISPATCH(find_any)(offset_.data(), entry_.data(), circles, first, pairs);
}

}  // namespace condyle::tangential
#endif
