#include "condyle/tangential/ring_lists.hpp"

#include <algorithm>
#include <utility>

#include "condyle/tangential/box_cells.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "condyle/tangential/ring_lists.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace condyle::HWY_NAMESPACE {
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

/// `offset` has one entry per cell, plus one; beyond the last triangle and box there is room for a vector.
std::size_t find_any(const Index* offset, const Index* triangle, const CellBox* box,
                     std::span<const CirclePlace> circles, std::size_t first, CirclePairs& pairs) {
  const std::size_t room = pairs.triangle.size();
  std::size_t count = 0, c = first;
  for (; c < circles.size(); ++c) {
    const Index begin = offset[circles[c].cell], end = offset[circles[c].cell + 1];
    if (count + (end - begin) + hn::MaxLanes(d) > room) break;
    const auto at = hn::Set(d, circles[c].at), number = hn::Set(d, static_cast<Index>(c));
    for (Index i = begin; i < end; i += static_cast<Index>(hn::MaxLanes(d))) {
      const auto held = hn::And(holding(hn::LoadU(d, box + i), at), hn::FirstN(d, end - i));
      hn::StoreU(number, d, pairs.circle.data() + count);
      count += store_some(hn::LoadU(d, triangle + i), held, pairs.triangle.data() + count);
    }
  }
  pairs.triangle.resize(count), pairs.circle.resize(count);
  return c;
}

}  // namespace
}  // namespace condyle::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle {

HWY_EXPORT(find_any);

namespace {

/// Room beyond the last entry, for a vector that starts on it.
constexpr std::size_t vector_room = 16;

/// The part of the box within a cell, as a CellBox.
CellBox box_in_cell(const BoxSides& sides, Index row, Index column) noexcept {
  const auto low = [](std::int32_t side, bool here) { return here ? static_cast<CellBox>(side & 0xff) : 0; };
  const auto high = [](std::int32_t side, bool here) {
    return here ? static_cast<CellBox>(~side & 0xff) : 0;
  };
  return low(sides.z_low, row == sides.first_row()) | high(sides.z_high, row == sides.last_row()) << 8 |
         low(sides.rho_low, column == sides.first_column()) << 16 |
         high(sides.rho_high, column == sides.last_column()) << 24;
}

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
    for_each(
        [&](const BoxSides& sides, Index) {
          const Four cells = four_cells(sides);
          ++counts[cells.cell[0]], counts[cells.cell[1]] += cells.two_columns;
          counts[cells.cell[2]] += cells.two_rows,
              counts[cells.cell[3]] += cells.two_columns & cells.two_rows;
        },
        [&](Index row, Index column, const BoxSides&, Index) { ++counts[grid_.cell(row, column)]; });
  }

  /// Lists each triangle; `next` has for each cell where its next entry goes.
  ///
  /// Four cells without a branch, the lower left one last: a cell that is none of its own is one of those
  /// that follow, which then takes the place that was written to.
  void list(Index* next, Index* triangle, CellBox* box) const {
    for_each(
        [&](const BoxSides& sides, Index t) {
          const Four cells = four_cells(sides);
          const auto put = [&](std::size_t k, Index own, Index row, Index column) {
            Index& at = next[cells.cell[k]];
            triangle[at] = t, box[at] = box_in_cell(sides, row, column);
            at += own;
          };
          const Index top = sides.last_row(), right = sides.last_column();
          put(3, cells.two_columns & cells.two_rows, top, right);
          put(2, cells.two_rows, top, sides.first_column());
          put(1, cells.two_columns, sides.first_row(), right);
          put(0, 1, sides.first_row(), sides.first_column());
        },
        [&](Index row, Index column, const BoxSides& sides, Index t) {
          const Index at = next[grid_.cell(row, column)]++;
          triangle[at] = t, box[at] = box_in_cell(sides, row, column);
        });
  }

 private:
  /// Cells at the corners of a box of at most two by two: lower left, lower right, upper left, upper right.
  struct Four {
    std::array<std::size_t, 4> cell;
    Index two_columns, two_rows;  ///< 1 where there are two, else 0
  };
  Four four_cells(const BoxSides& s) const noexcept {
    const std::size_t lower = grid_.cell(s.first_row(), s.first_column());
    const Index two_columns = s.last_column() - s.first_column(), two_rows = s.last_row() - s.first_row();
    const std::size_t upper = lower + (two_rows != 0 ? grid_.columns : 0);
    return {{lower, lower + two_columns, upper, upper + two_columns}, two_columns, two_rows};
  }

  /// small(sides, triangle) where a box meets at most two by two cells, else large(row, column, sides,
  /// triangle) for each cell.
  template <class Small, class Large>
  void for_each(const Small& small, const Large& large) const {
    BoxSidesBatch batch;
    for (std::size_t first = 0; first < triangles_.size(); first += batch.most) {
      const std::size_t count = std::min(batch.most, triangles_.size() - first);
      scale_.sides(boxes_, first, count, batch);
      for (std::size_t i = 0; i < count; ++i) {
        const BoxSides sides = batch[i];
        const auto t = static_cast<Index>(first + i);
        const Index wide = sides.last_column() - sides.first_column();
        const Index high = sides.last_row() - sides.first_row();
        if ((wide | high) <= 1) {
          small(sides, t);
        } else {
          for_each_cell(sides, t, large);
        }
      }
    }
  }

  /// Of a box of many cells those that the triangle meets.
  template <class Visit>
  void for_each_cell(const BoxSides& sides, Index t, const Visit& visit) const {
    constexpr std::size_t many = 16;
    const Index first = sides.first_column(), last = sides.last_column();
    if (std::size_t{last - first + 1} * (sides.last_row() - sides.first_row() + 1) <= many) {
      for (Index row = sides.first_row(); row <= sides.last_row(); ++row) {
        for (Index column = first; column <= last; ++column) visit(row, column, sides, t);
      }
      return;
    }
    const auto& [a, b, c] = triangles_[t];
    for_each_profile_run(grid_, vertices_[a].at, vertices_[b].at, vertices_[c].at,
                         [&](Index row, Index from, Index to) {
                           for (Index column = std::max(from, first); column <= std::min(to, last); ++column)
                             visit(row, column, sides, t);
                         });
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
  triangle_.resize(sum + vector_room), box_.resize(sum + vector_room);
  std::fill(triangle_.end() - vector_room, triangle_.end(), no_index);
  std::fill(box_.end() - vector_room, box_.end(), 0);
  listing.list(next, triangle_.data(), box_.data());
}

std::size_t RingLists::find(std::span<const CirclePlace> circles, std::size_t first,
                            CirclePairs& pairs) const {
  constexpr std::size_t usual = 4096;
  const std::size_t room = std::max(usual, longest_ + vector_room);
  pairs.triangle.resize(room), pairs.circle.resize(room);
  return HWY_DYNAMIC_DISPATCH(find_any)(offset_.data(), triangle_.data(), box_.data(), circles, first, pairs);
}

}  // namespace condyle
#endif
