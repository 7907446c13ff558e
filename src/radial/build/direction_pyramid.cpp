#include "radial/build/direction_pyramid.hpp"

#include <algorithm>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "radial/build/direction_pyramid.cpp"
#include <hwy/foreach_target.h>
#include "simd/packed_intervals-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using simd::HWY_NAMESPACE::hull_of_lanes;

/// Rows are as long as a power of two most of all, and short where tiles are large.
using Long = hn::CappedTag<std::uint32_t, 16>;
using Short = hn::CappedTag<std::uint32_t, 4>;

/// Calls step(tag, i) for vectors of elements [0, n), long ones while they fit.
template <class Step>
HWY_INLINE void in_vectors(std::size_t n, const Step& step) {
  constexpr hn::CappedTag<std::uint32_t, 1> single;
  std::size_t i = 0;
  for (; i + hn::MaxLanes(Long()) <= n; i += hn::MaxLanes(Long())) step(Long(), i);
  for (; i + hn::MaxLanes(Short()) <= n; i += hn::MaxLanes(Short())) step(Short(), i);
  for (; i < n; ++i) step(single, i);
}

std::size_t square(std::size_t n) noexcept {
  return n * n;
}

constexpr std::size_t dilation = DirectionPyramid::most_dilation;

/// A face's tiles with those beyond its edges around them, row by row.
///
///        x 0   dilation         n + dilation
///          . . | beyond      | . .            corners hold nothing: a direction beyond two edges is
///          ----+-------------+----            on one of the two faces beyond them
///        beyond|  the face   |beyond
///
/// Rows end with padding for a vector that starts in them; the last one for another.
class DilatedFace {
 public:
  DilatedFace(PackedInterval* words, std::size_t n) : words_(words), stride_(stride(n)) {}
  static std::size_t words(std::size_t n) noexcept {
    return (n + 2 * dilation) * stride(n) + hn::MaxLanes(Long());
  }

  PackedInterval* at(std::size_t row, std::size_t column) const noexcept {
    return words_ + row * stride_ + column;
  }
  std::size_t stride() const noexcept { return stride_; }

 private:
  static std::size_t stride(std::size_t n) noexcept { return n + 2 * dilation + 2 * hn::MaxLanes(Long()); }

  PackedInterval* words_;
  std::size_t stride_;
};

void copy_words(const PackedInterval* in, std::size_t n, PackedInterval* out) {
  in_vectors(n, [&](auto words, std::size_t i) { hn::StoreU(hn::LoadU(words, in + i), words, out + i); });
}

/// An edge of a face: the side where the coordinate of `axis` is least or greatest. Columns run along the
/// face's axis + 1, rows along axis + 2.
struct FaceEdge {
  int face, axis;
  bool is_greatest;

  bool is_column() const noexcept { return axis == (face + 1) % 3; }
  /// The same edge of the other face that has it.
  FaceEdge other_side() const noexcept { return {is_greatest ? axis : axis + 3, face % 3, face < 3}; }
};

/// Lines of tiles along an edge, the nearest ones of its face, each into a row of its own.
void read_lines(const PackedInterval* tiles, std::size_t n, const FaceEdge& edge, const DilatedFace& out) {
  const std::size_t lines = std::min(dilation, n);
  const PackedInterval* own = tiles + static_cast<std::size_t>(edge.face) * square(n);
  const auto from_edge = [&](std::size_t m) { return edge.is_greatest ? n - 1 - m : m; };
  if (edge.is_column()) {
    for (std::size_t k = 0; k < n; ++k, own += n)
      for (std::size_t m = 0; m < lines; ++m) *out.at(m, dilation + k) = own[from_edge(m)];
  } else {
    for (std::size_t m = 0; m < lines; ++m) copy_words(own + from_edge(m) * n, n, out.at(m, dilation));
  }
  for (std::size_t m = lines; m < dilation; ++m) std::fill_n(out.at(m, dilation), n, no_radii);
}

/// Each word of a line with those up to `reach` before and after it.
template <std::size_t reach>
HWY_INLINE void spread_line(const PackedInterval* line, std::size_t n, PackedInterval* out) {
  in_vectors(n, [&](auto words, std::size_t i) {
    auto all = hn::LoadU(words, line + i);
    for (std::size_t by = 1; by <= reach; ++by) {
      const auto before = hn::LoadU(words, line + i - by), after = hn::LoadU(words, line + i + by);
      all = hull_of_lanes(words, all, hull_of_lanes(words, before, after));
    }
    hn::StoreU(all, words, out + i);
  });
}

/// The region beyond an edge. A direction displaced beyond it, to a coordinate 1 + e, is e / (1 + e) away from
/// the edge on the neighbouring face, less than e; the other coordinate is divided by 1 + e too, which brings
/// it nearer to the middle by no more than that. So the tiles m others away from the edge, which take
/// displacements of up to m + 1 tiles to be reached, are spread by so many along it.
///
/// Rows of `scratch` are free but for their margins, which hold nothing.
void add_beyond_edge(const PackedInterval* tiles, std::size_t n, const FaceEdge& edge,
                     const DilatedFace& scratch, const DilatedFace& out) {
  static_assert(dilation == 3);
  read_lines(tiles, n, edge.other_side(), scratch);
  const auto across = [&](std::size_t m) { return edge.is_greatest ? dilation + n + m : dilation - 1 - m; };
  const auto row = [&](std::size_t m) {
    return edge.is_column() ? scratch.at(dilation + m, dilation) : out.at(across(m), dilation);
  };
  spread_line<1>(scratch.at(0, dilation), n, row(0));
  spread_line<2>(scratch.at(1, dilation), n, row(1));
  spread_line<3>(scratch.at(2, dilation), n, row(2));
  if (!edge.is_column()) return;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t m = 0; m < dilation; ++m)
      *out.at(dilation + k, across(m)) = *scratch.at(dilation + m, dilation + k);
}

void add_neighbours(const PackedInterval* tiles, std::size_t n, int face, const DilatedFace& scratch,
                    const DilatedFace& out) {
  for (std::size_t row = 0; row < dilation; ++row) {
    for (const std::size_t first : {std::size_t{0}, dilation + n}) {
      std::fill_n(out.at(row, first), dilation, no_radii);
      std::fill_n(out.at(dilation + n + row, first), dilation, no_radii);
      std::fill_n(scratch.at(row, first), dilation, no_radii);
    }
  }
  const PackedInterval* own = tiles + static_cast<std::size_t>(face) * square(n);
  for (std::size_t row = 0; row < n; ++row) copy_words(own + row * n, n, out.at(dilation + row, dilation));
  for (const int axis : {(face + 1) % 3, (face + 2) % 3})
    for (const bool is_greatest : {false, true})
      add_beyond_edge(tiles, n, {face, axis, is_greatest}, scratch, out);
}

/// Columns of a vector's width, rows after each other: each word with its eight neighbours. `in` is where the
/// first of them is.
template <class Words>
HWY_INLINE void widen_columns(Words words, const PackedInterval* in, std::size_t stride, std::size_t rows,
                              PackedInterval* out, std::size_t out_stride) {
  const auto three = [&](const PackedInterval* middle) {
    const auto sides = hull_of_lanes(words, hn::LoadU(words, middle - 1), hn::LoadU(words, middle + 1));
    return hull_of_lanes(words, sides, hn::LoadU(words, middle));
  };
  auto above = three(in - stride), here = three(in);
  for (std::size_t row = 0; row < rows; ++row) {
    in += stride;
    const auto below = three(in);
    hn::StoreU(hull_of_lanes(words, hull_of_lanes(words, above, here), below), words, out);
    above = here, here = below;
    out += out_stride;
  }
}

/// Each word but the outermost `by` ones on every side, with its eight neighbours: one tile more of dilation.
void widen(const DilatedFace& in, std::size_t n, std::size_t by, const DilatedFace& out) {
  const std::size_t width = n + 2 * (dilation - by);
  for (std::size_t i = 0; i < width; i += hn::MaxLanes(Long()))
    widen_columns(Long(), in.at(by, by + i), in.stride(), width, out.at(by, by + i), out.stride());
}

/// Four tiles to one.
void halve(const PackedInterval* in, std::size_t n, PackedInterval* out) {
  const std::size_t half = n / 2;
  for (std::size_t row = 0; row < 6 * half; ++row, out += half) {
    const PackedInterval *upper = in + 2 * row * n, *lower = upper + n;
    in_vectors(half, [&](auto words, std::size_t i) {
      auto a = hn::Zero(words), b = a, c = a, e = a;
      hn::LoadInterleaved2(words, upper + 2 * i, a, b);
      hn::LoadInterleaved2(words, lower + 2 * i, c, e);
      const auto both = hull_of_lanes(words, hull_of_lanes(words, a, b), hull_of_lanes(words, c, e));
      hn::StoreU(both, words, out + i);
    });
  }
}

/// The entries of the levels with tiles of one size, of dilations 1 (if any), 2 and 3, on faces with set bits.
void fill_levels(const PackedInterval* tiles, std::size_t n, const DilatedFace& a, const DilatedFace& b,
                 PackedInterval* dilation_1, PackedInterval* dilation_2, PackedInterval* dilation_3,
                 unsigned faces) {
  const auto copy_face = [&](const DilatedFace& from, PackedInterval* to) {
    for (std::size_t row = 0; row < n; ++row) copy_words(from.at(dilation + row, dilation), n, to + row * n);
  };
  for (int face = 0; face < 6; ++face) {
    if ((faces >> face & 1) == 0) continue;
    const std::size_t first = static_cast<std::size_t>(face) * square(n);
    add_neighbours(tiles, n, face, b, a);
    widen(a, n, 1, b);
    if (dilation_1 != nullptr) copy_face(b, dilation_1 + first);
    widen(b, n, 2, a);
    copy_face(a, dilation_2 + first);
    in_vectors(n, [&](auto words, std::size_t i) {
      widen_columns(words, a.at(dilation, dilation + i), a.stride(), n, dilation_3 + first + i, n);
    });
  }
}

std::size_t scratch_needed_any(std::size_t cells_per_side) {
  return 2 * DilatedFace::words(cells_per_side) + 2 * 6 * square(cells_per_side / 2);
}

void fill_any(int cells_per_side, const PackedInterval* cells, const std::uint8_t* faces,
              PackedInterval* scratch, PackedInterval* entries) {
  const auto finest = static_cast<std::size_t>(cells_per_side);
  PackedInterval *const first = scratch, *const second = first + DilatedFace::words(finest);
  PackedInterval *tile = second + DilatedFace::words(finest), *coarser = tile + 6 * square(finest / 2);
  const PackedInterval* tiles = cells;
  const int levels = DirectionPyramid::level_count(cells_per_side);
  for (int level = 1; level < levels; level += 2) {
    const std::size_t n = finest >> DirectionPyramid::halvings_of(level);
    const auto at = [&](int of) { return entries + DirectionPyramid::start_of(of, cells_per_side); };
    fill_levels(tiles, n, {first, n}, {second, n}, level == 1 ? at(0) : nullptr, at(level), at(level + 1),
                faces[DirectionPyramid::halvings_of(level)]);
    if (level + 2 >= levels) break;
    halve(tiles, n, coarser);
    std::swap(tile, coarser);
    tiles = tile;
  }
}

}  // namespace
}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::radial {
namespace {

std::size_t square(int n) noexcept {
  return static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
}

HWY_EXPORT(fill_any);
HWY_EXPORT(scratch_needed_any);

}  // namespace

int DirectionPyramid::level_count(int cells_per_side) noexcept {
  int sizes = 1;
  for (int n = cells_per_side; n % 2 == 0 && n / 2 >= 4; n /= 2) ++sizes;
  return 1 + 2 * sizes;
}

std::size_t DirectionPyramid::start_of(int level, int cells_per_side) noexcept {
  if (level == 0) return 0;
  // Two levels with tiles of one size are 12 n^2 entries; those before them, with level 0, a geometric
  // series.
  const std::size_t finest = square(cells_per_side), own = square(cells_per_side >> halvings_of(level));
  return 6 * finest + 16 * (finest - own) + (dilation_of(level) == 3 ? 6 * own : 0);
}

std::size_t DirectionPyramid::entry_count(int cells_per_side) noexcept {
  const int last = level_count(cells_per_side) - 1;
  return start_of(last, cells_per_side) + 6 * square(cells_per_side >> halvings_of(last));
}

void DirectionPyramid::fill(int cells_per_side, std::span<const PackedInterval> cells) {
  FacesOfSizes faces;
  faces.fill(all_faces);
  entry_.resize(entry_count(cells_per_side));
  fill_faces(cells_per_side, cells, faces);
}

void DirectionPyramid::refill(int cells_per_side, std::span<const PackedInterval> cells,
                              std::span<const Index> changed) {
  if (changed.empty()) return;
  assert(entry_.size() == entry_count(cells_per_side));
  FacesOfSizes faces{};
  const auto finest = static_cast<Index>(cells_per_side);
  const int sizes = halvings_of(level_count(cells_per_side) - 1) + 1;
  for (const Index cell : changed) {
    const Index face = cell / (finest * finest), axis_u = (face + 1) % 3, axis_w = (face + 2) % 3;
    const Index row = cell / finest % finest, column = cell % finest;
    for (int k = 0; k < sizes; ++k) {
      const Index n = finest >> k, u = column >> k, w = row >> k;
      unsigned bits = 1u << face;
      if (u < most_dilation) bits |= 1u << (axis_u + 3);
      if (u + most_dilation >= n) bits |= 1u << axis_u;
      if (w < most_dilation) bits |= 1u << (axis_w + 3);
      if (w + most_dilation >= n) bits |= 1u << axis_w;
      faces[static_cast<std::size_t>(k)] |= static_cast<std::uint8_t>(bits);
    }
  }
  fill_faces(cells_per_side, cells, faces);
}

void DirectionPyramid::fill_faces(int cells_per_side, std::span<const PackedInterval> cells,
                                  const FacesOfSizes& faces) {
  assert(cells.size() == 6 * square(cells_per_side));
  scratch_.resize(HWY_DYNAMIC_DISPATCH(scratch_needed_any)(static_cast<std::size_t>(cells_per_side)));
  HWY_DYNAMIC_DISPATCH(fill_any)(cells_per_side, cells.data(), faces.data(), scratch_.data(), entry_.data());
}

}  // namespace condyle::radial
#endif
