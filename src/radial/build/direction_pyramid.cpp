#include "radial/build/direction_pyramid.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "radial/build/direction_pyramid.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "radial/build/radius_words-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Rows are as long as a power of two most of all, and short on the upper levels.
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

constexpr std::size_t border = DirectionPyramid::most_border;

/// A face's pieces with those beyond its edges around them, row by row.
///
///        x 0   border         n + border
///          . . | beyond      | . .            corners hold nothing: a direction beyond two edges is
///          ----+-------------+----            on one of the two faces beyond them
///        beyond|  the face   |beyond
///
/// Rows end with room for a vector that starts in them; the last one for another.
class BorderedFace {
 public:
  BorderedFace(RadiusWord* words, std::size_t n) : words_(words), stride_(stride(n)) {}
  static std::size_t room(std::size_t n) noexcept {
    return (n + 2 * border) * stride(n) + hn::MaxLanes(Long());
  }

  RadiusWord* at(std::size_t row, std::size_t column) const noexcept {
    return words_ + row * stride_ + column;
  }
  std::size_t stride() const noexcept { return stride_; }

 private:
  static std::size_t stride(std::size_t n) noexcept { return n + 2 * border + 2 * hn::MaxLanes(Long()); }

  RadiusWord* words_;
  std::size_t stride_;
};

void copy_words(const RadiusWord* in, std::size_t n, RadiusWord* out) {
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

/// Lines of pieces along an edge, the nearest ones of its face, each into a row of its own.
void read_lines(const RadiusWord* pieces, std::size_t n, const FaceEdge& edge, const BorderedFace& out) {
  const std::size_t lines = std::min(border, n);
  const RadiusWord* own = pieces + static_cast<std::size_t>(edge.face) * square(n);
  const auto from_edge = [&](std::size_t m) { return edge.is_greatest ? n - 1 - m : m; };
  if (edge.is_column()) {
    for (std::size_t k = 0; k < n; ++k, own += n)
      for (std::size_t m = 0; m < lines; ++m) *out.at(m, border + k) = own[from_edge(m)];
  } else {
    for (std::size_t m = 0; m < lines; ++m) copy_words(own + from_edge(m) * n, n, out.at(m, border));
  }
  for (std::size_t m = lines; m < border; ++m) std::fill_n(out.at(m, border), n, no_radii);
}

/// Each word of a line with those up to `reach` before and after it.
template <std::size_t reach>
HWY_INLINE void spread_line(const RadiusWord* line, std::size_t n, RadiusWord* out) {
  in_vectors(n, [&](auto words, std::size_t i) {
    auto all = hn::LoadU(words, line + i);
    for (std::size_t by = 1; by <= reach; ++by) {
      const auto before = hn::LoadU(words, line + i - by), after = hn::LoadU(words, line + i + by);
      all = union_of_words(words, all, union_of_words(words, before, after));
    }
    hn::StoreU(all, words, out + i);
  });
}

/// What is beyond an edge. A direction displaced beyond it, to a coordinate 1 + e, is e / (1 + e) away from
/// the edge on the neighbouring face, less than e; the other coordinate is divided by 1 + e too, which brings
/// it nearer to the middle by no more than that. So the pieces m others away from the edge, which take
/// displacements of up to m + 1 pieces to be reached, are spread by so many along it.
///
/// Rows of `room` are free but for their margins, which hold nothing.
void add_beyond_edge(const RadiusWord* pieces, std::size_t n, const FaceEdge& edge, const BorderedFace& room,
                     const BorderedFace& out) {
  static_assert(border == 3);
  read_lines(pieces, n, edge.other_side(), room);
  const auto across = [&](std::size_t m) { return edge.is_greatest ? border + n + m : border - 1 - m; };
  const auto row = [&](std::size_t m) {
    return edge.is_column() ? room.at(border + m, border) : out.at(across(m), border);
  };
  spread_line<1>(room.at(0, border), n, row(0));
  spread_line<2>(room.at(1, border), n, row(1));
  spread_line<3>(room.at(2, border), n, row(2));
  if (!edge.is_column()) return;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t m = 0; m < border; ++m)
      *out.at(border + k, across(m)) = *room.at(border + m, border + k);
}

void add_borders(const RadiusWord* pieces, std::size_t n, int face, const BorderedFace& room,
                 const BorderedFace& out) {
  for (std::size_t row = 0; row < border; ++row) {
    for (const std::size_t first : {std::size_t{0}, border + n}) {
      std::fill_n(out.at(row, first), border, no_radii);
      std::fill_n(out.at(border + n + row, first), border, no_radii);
      std::fill_n(room.at(row, first), border, no_radii);
    }
  }
  const RadiusWord* own = pieces + static_cast<std::size_t>(face) * square(n);
  for (std::size_t row = 0; row < n; ++row) copy_words(own + row * n, n, out.at(border + row, border));
  for (const int axis : {(face + 1) % 3, (face + 2) % 3})
    for (const bool is_greatest : {false, true})
      add_beyond_edge(pieces, n, {face, axis, is_greatest}, room, out);
}

/// Columns of a vector's width, rows after each other: each word with its eight neighbours. `in` is where the
/// first of them is.
template <class Words>
HWY_INLINE void widen_columns(Words words, const RadiusWord* in, std::size_t stride, std::size_t rows,
                              RadiusWord* out, std::size_t out_stride) {
  const auto three = [&](const RadiusWord* middle) {
    const auto sides = union_of_words(words, hn::LoadU(words, middle - 1), hn::LoadU(words, middle + 1));
    return union_of_words(words, sides, hn::LoadU(words, middle));
  };
  auto above = three(in - stride), here = three(in);
  for (std::size_t row = 0; row < rows; ++row) {
    in += stride;
    const auto below = three(in);
    hn::StoreU(union_of_words(words, union_of_words(words, above, here), below), words, out);
    above = here, here = below;
    out += out_stride;
  }
}

/// Each word but the outermost `by` ones on every side, with its eight neighbours: one piece more of border.
void widen(const BorderedFace& in, std::size_t n, std::size_t by, const BorderedFace& out) {
  const std::size_t width = n + 2 * (border - by);
  for (std::size_t i = 0; i < width; i += hn::MaxLanes(Long()))
    widen_columns(Long(), in.at(by, by + i), in.stride(), width, out.at(by, by + i), out.stride());
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

/// The entries of one level, of borders 1 (where asked for), 2 and 3, on the faces whose bits are set.
void fill_level(const RadiusWord* pieces, std::size_t n, const BorderedFace& a, const BorderedFace& b,
                RadiusWord* border_1, RadiusWord* border_2, RadiusWord* border_3, unsigned faces) {
  const auto copy_face = [&](const BorderedFace& from, RadiusWord* to) {
    for (std::size_t row = 0; row < n; ++row) copy_words(from.at(border + row, border), n, to + row * n);
  };
  for (int face = 0; face < 6; ++face) {
    if ((faces >> face & 1) == 0) continue;
    const std::size_t first = static_cast<std::size_t>(face) * square(n);
    add_borders(pieces, n, face, b, a);
    widen(a, n, 1, b);
    if (border_1 != nullptr) copy_face(b, border_1 + first);
    widen(b, n, 2, a);
    copy_face(a, border_2 + first);
    in_vectors(n, [&](auto words, std::size_t i) {
      widen_columns(words, a.at(border, border + i), a.stride(), n, border_3 + first + i, n);
    });
  }
}

std::size_t room_needed_any(std::size_t cells_per_side) {
  return 2 * BorderedFace::room(cells_per_side) + 2 * 6 * square(cells_per_side / 2);
}

void fill_any(int cells_per_side, const RadiusWord* cells, const std::uint8_t* faces, RadiusWord* room,
              RadiusWord* entries) {
  const auto finest = static_cast<std::size_t>(cells_per_side);
  RadiusWord *const first = room, *const second = first + BorderedFace::room(finest);
  RadiusWord *piece = second + BorderedFace::room(finest), *coarser = piece + 6 * square(finest / 2);
  const RadiusWord* pieces = cells;
  const int steps = DirectionPyramid::step_count(cells_per_side);
  for (int step = 1; step < steps; step += 2) {
    const std::size_t n = finest >> DirectionPyramid::level_of(step);
    const auto at = [&](int of) { return entries + DirectionPyramid::start_of(of, cells_per_side); };
    fill_level(pieces, n, {first, n}, {second, n}, step == 1 ? at(0) : nullptr, at(step), at(step + 1),
               faces[DirectionPyramid::level_of(step)]);
    if (step + 2 >= steps) break;
    halve(pieces, n, coarser);
    std::swap(piece, coarser);
    pieces = piece;
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
HWY_EXPORT(room_needed_any);

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
  FacesOfLevels faces;
  faces.fill(all_faces);
  entry_.resize(entry_count(cells_per_side));
  fill_faces(cells_per_side, cells, faces);
}

void DirectionPyramid::refill(int cells_per_side, std::span<const RadiusWord> cells,
                              std::span<const Index> changed) {
  if (changed.empty()) return;
  assert(entry_.size() == entry_count(cells_per_side));
  FacesOfLevels faces{};
  const auto finest = static_cast<Index>(cells_per_side);
  const int levels = level_of(step_count(cells_per_side) - 1) + 1;
  for (const Index cell : changed) {
    const Index face = cell / (finest * finest), axis_u = (face + 1) % 3, axis_w = (face + 2) % 3;
    const Index row = cell / finest % finest, column = cell % finest;
    for (int level = 0; level < levels; ++level) {
      const Index n = finest >> level, u = column >> level, w = row >> level;
      unsigned bits = 1u << face;
      if (u < most_border) bits |= 1u << (axis_u + 3);
      if (u + most_border >= n) bits |= 1u << axis_u;
      if (w < most_border) bits |= 1u << (axis_w + 3);
      if (w + most_border >= n) bits |= 1u << axis_w;
      faces[static_cast<std::size_t>(level)] |= static_cast<std::uint8_t>(bits);
    }
  }
  fill_faces(cells_per_side, cells, faces);
}

void DirectionPyramid::fill_faces(int cells_per_side, std::span<const RadiusWord> cells,
                                  const FacesOfLevels& faces) {
  assert(cells.size() == 6 * square(cells_per_side));
  room_.resize(HWY_DYNAMIC_DISPATCH(room_needed_any)(static_cast<std::size_t>(cells_per_side)));
  HWY_DYNAMIC_DISPATCH(fill_any)(cells_per_side, cells.data(), faces.data(), room_.data(), entry_.data());
  // The last step has the fewest entries, and every cell is in one of them.
  const auto last_step =
      entry_.begin() + static_cast<std::ptrdiff_t>(start_of(step_count(cells_per_side) - 1, cells_per_side));
  all_ = std::accumulate(last_step, entry_.end(), no_radii, union_of);
}

}  // namespace condyle::radial
#endif
