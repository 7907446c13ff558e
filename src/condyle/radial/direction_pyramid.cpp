#include "condyle/radial/direction_pyramid.hpp"

#include <algorithm>
#include <cassert>

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

/// A line of pieces along an edge of a face.
struct EdgeLine {
  std::size_t first, step;

  /// On the side of the face where the coordinate of the given axis is least or greatest. Columns run along
  /// the face's axis + 1, rows along axis + 2.
  EdgeLine(int face, int axis, bool is_greatest, std::size_t n) {
    const std::size_t at = is_greatest ? n - 1 : 0;
    const bool is_column = axis == (face + 1) % 3;
    first = static_cast<std::size_t>(face) * square(n) + (is_column ? at : at * n);
    step = is_column ? n : 1;
  }
};

/// Borders across the edges of the cube; `row` and `united` have room for a row and two words at either end.
///
/// Beyond an edge the neighbouring face is entered by at most one piece: a coordinate 1 + d is 1 / (1 + d)
/// there, at least 1 - d. The other coordinate is divided by 1 + d too, which brings it nearer to the middle
/// by at most a piece more: two pieces to either side hold all of it.
void widen_across_edges(const RadiusWord* in, std::size_t n, RadiusWord* row, RadiusWord* united,
                        RadiusWord* out) {
  row[0] = row[1] = row[n + 2] = row[n + 3] = no_radii;
  for (int face = 0; face < 6; ++face) {
    for (const int axis : {(face + 1) % 3, (face + 2) % 3}) {
      for (const bool is_greatest : {false, true}) {
        const EdgeLine beyond(is_greatest ? axis : axis + 3, face % 3, face < 3, n);
        const EdgeLine own(face, axis, is_greatest, n);
        for (std::size_t k = 0; k < n; ++k) row[k + 2] = in[beyond.first + k * beyond.step];
        unite_neighbours(row, n, 2, united);
        for (std::size_t k = 0; k < n; ++k) {
          RadiusWord& entry = out[own.first + k * own.step];
          entry = union_of(entry, united[k]);
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

void fill_any(std::size_t cells_per_side, std::size_t levels, const RadiusWord* cells,
              std::span<RadiusWord> room, RadiusWord* entries) {
  const std::size_t row_room = cells_per_side + 4;
  RadiusWord *row = room.data(), *united = row + row_room;
  RadiusWord *piece = united + row_room, *coarser = piece + 6 * square(cells_per_side / 2);
  const RadiusWord* pieces = cells;
  for (std::size_t k = 0; k < levels; ++k) {
    const std::size_t n = cells_per_side >> k;
    RadiusWord* out = entries + 8 * (square(cells_per_side) - square(n));
    widen_faces(pieces, n, row, out);
    widen_across_edges(pieces, n, row, united, out);
    if (k + 1 == levels) break;
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

int DirectionPyramid::level_count(int cells_per_side) noexcept {
  int levels = 1;
  for (int n = cells_per_side; n % 2 == 0 && n / 2 >= 4; n /= 2) ++levels;
  return levels;
}

std::size_t DirectionPyramid::entry_count(int cells_per_side) noexcept {
  std::size_t count = 0;
  for (int k = 0; k < level_count(cells_per_side); ++k)
    count = 8 * (square(cells_per_side) - square(cells_per_side >> k)) + 6 * square(cells_per_side >> k);
  return count;
}

void DirectionPyramid::fill(int cells_per_side, std::span<const RadiusWord> cells) {
  assert(cells.size() == 6 * square(cells_per_side));
  const int levels = level_count(cells_per_side);
  entry_.resize(entry_count(cells_per_side));
  const auto n = static_cast<std::size_t>(cells_per_side);
  // Two rows with their borders, the pieces of a level and of the next.
  room_.resize(2 * (n + 4) + 12 * square(cells_per_side / 2));
  HWY_DYNAMIC_DISPATCH(fill_any)
  (n, static_cast<std::size_t>(levels), cells.data(), room_, entry_.data());
}

}  // namespace condyle
#endif
