#include "condyle/radial/direction_pyramid.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "condyle/radial/direction_pyramid.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace condyle::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Rows are as long as a power of two most of all, and short on the upper levels.
using Long = hn::CappedTag<std::uint32_t, 16>;
using Short = hn::CappedTag<std::uint32_t, 4>;

/// union_of(): the halves are numbers of their own.
template <class Words>
HWY_INLINE hn::Vec<Words> union_of_words(Words words, hn::Vec<Words> a, hn::Vec<Words> b) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(words, union_of(hn::GetLane(a), hn::GetLane(b)));
#else
  constexpr hn::Repartition<std::uint16_t, Words> halves;
  return hn::BitCast(words, hn::Min(hn::BitCast(halves, a), hn::BitCast(halves, b)));
#endif
}

/// Calls step(tag, i) for vectors of elements [0, n), long ones while they fit.
template <class Step>
HWY_INLINE void in_vectors(std::size_t n, const Step& step) {
  constexpr hn::CappedTag<std::uint32_t, 1> single;
  std::size_t i = 0;
  for (; i + hn::MaxLanes(Long()) <= n; i += hn::MaxLanes(Long())) step(Long(), i);
  for (; i + hn::MaxLanes(Short()) <= n; i += hn::MaxLanes(Short())) step(Short(), i);
  for (; i < n; ++i) step(single, i);
}

/// Columns with their neighbours above and below.
void unite_rows(const RadiusWord* above, const RadiusWord* middle, const RadiusWord* below, std::size_t n,
                RadiusWord* out) {
  in_vectors(n, [&](auto words, std::size_t i) {
    const auto both = union_of_words(words, hn::LoadU(words, above + i), hn::LoadU(words, below + i));
    hn::StoreU(union_of_words(words, both, hn::LoadU(words, middle + i)), words, out + i);
  });
}

/// Each with those up to `reach` before and after it; `in` starts so far before the first.
void unite_neighbours(const RadiusWord* in, std::size_t n, std::size_t reach, RadiusWord* out) {
  in_vectors(n, [&](auto words, std::size_t i) {
    auto all = hn::LoadU(words, in + i);
    for (std::size_t k = 1; k <= 2 * reach; ++k)
      all = union_of_words(words, all, hn::LoadU(words, in + i + k));
    hn::StoreU(all, words, out + i);
  });
}

std::size_t square(std::size_t n) noexcept {
  return n * n;
}

/// Borders within each face. `row` has room for a row and one word at either end.
void widen_faces(const RadiusWord* in, std::size_t n, RadiusWord* row, RadiusWord* out) {
  row[0] = row[n + 1] = no_radii;
  for (std::size_t face = 0; face < 6; ++face) {
    for (std::size_t j = 0; j < n; ++j) {
      const RadiusWord* middle = in + face * square(n) + j * n;
      unite_rows(j > 0 ? middle - n : middle, middle, j + 1 < n ? middle + n : middle, n, row + 1);
      unite_neighbours(row, n, 1, out + face * square(n) + j * n);
    }
  }
}

/// A line of pieces along an edge of a face, so many others away from it.
struct EdgeLine {
  std::size_t first, step;

  /// On the side of the face where the coordinate of the given axis is least or greatest. Columns run along
  /// the face's axis + 1, rows along axis + 2.
  EdgeLine(int face, int axis, bool is_greatest, std::size_t away, std::size_t n) {
    const std::size_t at = is_greatest ? n - 1 - away : away;
    const bool is_column = axis == (face + 1) % 3;
    first = static_cast<std::size_t>(face) * square(n) + (is_column ? at : at * n);
    step = is_column ? n : 1;
  }
};

constexpr std::size_t most_border = DirectionPyramid::most_border, most_reach = DirectionPyramid::most_reach;

/// Room for borders: rows with a margin of `most_reach` words at either end.
struct Room {
  std::array<RadiusWord*, most_border> beyond;
  RadiusWord *united, *widened;
};

/// Borders across the edges of the cube. A direction of a piece that q others part from an edge may be
/// displaced beyond it by d = border - q pieces. There a coordinate 1 + e is 1 / (1 + e), at least 1 - e: it
/// enters the neighbouring face by no more than d pieces. The other coordinate is divided by 1 + e too, which
/// brings it nearer to the middle by at most d pieces more than it is displaced by.
void widen_across_edges(const RadiusWord* in, std::size_t n, std::size_t border, const Room& room,
                        RadiusWord* out) {
  const std::size_t depths = std::min(border, n);
  for (int face = 0; face < 6; ++face) {
    for (const int axis : {(face + 1) % 3, (face + 2) % 3}) {
      for (const bool is_greatest : {false, true}) {
        // beyond[m]: the first m + 1 pieces beyond the edge.
        for (std::size_t m = 0; m < depths; ++m) {
          const EdgeLine line(is_greatest ? axis : axis + 3, face % 3, face < 3, m, n);
          RadiusWord* row = room.beyond[m];
          for (std::size_t k = 0; k < n; ++k) row[most_reach + k] = in[line.first + k * line.step];
          if (m > 0)
            unite_rows(row + most_reach, row + most_reach, room.beyond[m - 1] + most_reach, n,
                       row + most_reach);
        }
        for (std::size_t q = 0; q < depths; ++q) {
          const std::size_t depth = border - q, reach = border + depth;
          const RadiusWord* row = room.beyond[std::min(depth, n) - 1];
          unite_neighbours(row + most_reach - reach, n, reach, room.united);
          const EdgeLine own(face, axis, is_greatest, q, n);
          for (std::size_t k = 0; k < n; ++k) {
            RadiusWord& entry = out[own.first + k * own.step];
            entry = union_of(entry, room.united[k]);
          }
        }
      }
    }
  }
}

/// Four pieces to one.
void halve(const RadiusWord* in, std::size_t n, RadiusWord* out) {
  const std::size_t half = n / 2;
  for (std::size_t row = 0; row < 6 * half; ++row, out += half) {
    const RadiusWord *upper = in + 2 * row * n, *lower = upper + n;
    in_vectors(half, [&](auto words, std::size_t i) {
      auto a = hn::Zero(words), b = a, c = a, e = a;
      hn::LoadInterleaved2(words, upper + 2 * i, a, b);
      hn::LoadInterleaved2(words, lower + 2 * i, c, e);
      const auto both = union_of_words(words, union_of_words(words, a, b), union_of_words(words, c, e));
      hn::StoreU(both, words, out + i);
    });
  }
}

void fill_any(int cells_per_side, const RadiusWord* cells, std::span<RadiusWord> words, RadiusWord* entries) {
  const auto finest = static_cast<std::size_t>(cells_per_side);
  const std::size_t row_room = finest + 2 * most_reach;
  Room room{};
  RadiusWord* next = words.data();
  const auto take = [&](std::size_t count) {
    RadiusWord* start = next;
    next += count;
    return start;
  };
  for (RadiusWord*& row : room.beyond) row = take(row_room);
  room.united = take(row_room), room.widened = take(row_room);
  RadiusWord *bordered = take(6 * square(finest / 2)), *piece = take(6 * square(finest / 2)),
             *coarser = take(6 * square(finest / 2));
  const RadiusWord* pieces = cells;
  const int steps = DirectionPyramid::step_count(cells_per_side);
  for (int step = 1; step < steps; step += 2) {
    const std::size_t n = finest >> DirectionPyramid::level_of(step);
    for (RadiusWord* row : room.beyond) {
      std::fill_n(row, most_reach, no_radii), std::fill_n(row + most_reach + n, most_reach, no_radii);
    }
    const auto at = [&](int of) { return entries + DirectionPyramid::start_of(of, cells_per_side); };
    RadiusWord* const one = step == 1 ? at(0) : bordered;
    // Within the faces all of them first: what is beyond an edge is not to be widened again.
    widen_faces(pieces, n, room.widened, one);
    widen_faces(one, n, room.widened, at(step));
    widen_faces(at(step), n, room.widened, at(step + 1));
    if (step == 1) widen_across_edges(pieces, n, 1, room, one);
    widen_across_edges(pieces, n, 2, room, at(step));
    widen_across_edges(pieces, n, 3, room, at(step + 1));
    if (step + 2 >= steps) break;
    halve(pieces, n, coarser);
    std::swap(piece, coarser);
    pieces = piece;
  }
}

}  // namespace
}  // namespace condyle::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle {
namespace {

std::size_t square(int n) noexcept {
  return static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
}

HWY_EXPORT(fill_any);

}  // namespace

int DirectionPyramid::step_count(int cells_per_side) noexcept {
  int levels = 1;
  for (int n = cells_per_side; n % 2 == 0 && n / 2 >= 4; n /= 2) ++levels;
  return 1 + 2 * levels;
}

std::size_t DirectionPyramid::start_of(int step, int cells_per_side) noexcept {
  if (step == 0) return 0;
  // Two steps of each level are 12 n^2 entries; those before level k, with the first step, a geometric
  // series.
  const std::size_t finest = square(cells_per_side), own = square(cells_per_side >> level_of(step));
  return 6 * finest + 16 * (finest - own) + (border_of(step) == 3 ? 6 * own : 0);
}

std::size_t DirectionPyramid::entry_count(int cells_per_side) noexcept {
  const int last = step_count(cells_per_side) - 1;
  return start_of(last, cells_per_side) + 6 * square(cells_per_side >> level_of(last));
}

void DirectionPyramid::fill(int cells_per_side, std::span<const RadiusWord> cells) {
  assert(cells.size() == 6 * square(cells_per_side));
  entry_.resize(entry_count(cells_per_side));
  const auto n = static_cast<std::size_t>(cells_per_side);
  // Five rows with their margins, and of one level after the first its pieces, those with a border, and the
  // next ones.
  room_.resize((most_border + 2) * (n + 2 * most_reach) + 3 * 6 * square(cells_per_side / 2));
  HWY_DYNAMIC_DISPATCH(fill_any)(cells_per_side, cells.data(), room_, entry_.data());
  // The last step has the fewest entries, and every cell is in one of them.
  const auto last_step =
      entry_.begin() + static_cast<std::ptrdiff_t>(start_of(step_count(cells_per_side) - 1, cells_per_side));
  all_ = std::accumulate(last_step, entry_.end(), no_radii, union_of);
}

}  // namespace condyle
#endif
