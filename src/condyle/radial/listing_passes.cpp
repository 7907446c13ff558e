#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include <hwy/cache_control.h>

#include "condyle/radial/cube_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "condyle/radial/listing_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace condyle::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// How long before its turn a triangle's corners are fetched: they lie anywhere.
constexpr std::size_t triangles_ahead = 24;

/// octagon_in_cell() of a triangle in several cells.
template <class DI>
struct OctagonsInCells {
  using Ints = hn::Vec<DI>;
  hn::Mask<DI> meet;
  Ints box, slant;

  HWY_INLINE OctagonsInCells(const FaceParts& parts, int n, Ints column, Ints row) {
    constexpr DI di;
    const auto set = [](int value) { return hn::Set(DI(), value); };
    const auto within = [&](Ints value, int most) {
      return hn::Min(hn::Max(value, hn::Zero(di)), set(most));
    };
    const auto from = [&](int value, Ints start) { return hn::Sub(set(value), start); };
    const auto word = [&](Ints least_a, Ints greatest_a, Ints least_b, Ints greatest_b) {
      const auto a = hn::Or(least_a, hn::ShiftLeft<8>(hn::Sub(set(255), greatest_a)));
      const auto b = hn::Or(least_b, hn::ShiftLeft<8>(hn::Sub(set(255), greatest_b)));
      return hn::Or(a, hn::ShiftLeft<16>(b));
    };
    const auto u = hn::ShiftLeft<8>(column), w = hn::ShiftLeft<8>(row);
    const auto sum = hn::Add(u, w), difference = hn::Add(hn::Sub(u, w), set(parts_per_cell * n - 255));
    const auto least_sum = from(parts.least[2] - 2, sum), greatest_sum = from(parts.greatest[2] + 1, sum);
    const auto least_difference = from(parts.least[3] - 1, difference);
    const auto greatest_difference = from(parts.greatest[3] + 2, difference);
    const auto most = set(510);
    const auto before = hn::Or(hn::Lt(greatest_sum, hn::Zero(di)), hn::Lt(greatest_difference, hn::Zero(di)));
    meet = hn::Not(hn::Or(before, hn::Or(hn::Gt(least_sum, most), hn::Gt(least_difference, most))));
    box = word(within(from(parts.least[0], u), 255), within(from(parts.greatest[0], u), 255),
               within(from(parts.least[1], w), 255), within(from(parts.greatest[1], w), 255));
    const auto half = [&](Ints value) { return hn::ShiftRight<1>(within(value, 510)); };
    slant = word(half(least_sum), half(greatest_sum), half(least_difference), half(greatest_difference));
  }
};

void list_small_triangles_any(const MeshView& mesh, const PlacedVertices& vertices, std::size_t first,
                              std::size_t last, Listing& listing) {
  constexpr hn::CappedTag<float, 4> d4;
  constexpr hn::RebindToSigned<decltype(d4)> di4;
  constexpr hn::RebindToUnsigned<decltype(d4)> du4;
  alignas(16) constexpr std::int32_t column_step[4] = {0, 1, 0, 1}, row_step[4] = {0, 0, 1, 1};
  const int n = listing.cells_per_side;
  const int last_part = n * parts_per_cell - 1;
  const auto scale = hn::Set(d4, 0.5f * static_cast<float>(n * parts_per_cell));
  alignas(16) constexpr float low_shift[4] = {1 - list_margin, 1 - list_margin, 2 - 2 * list_margin,
                                              2 - 2 * list_margin};
  alignas(16) constexpr float high_shift[4] = {1 + list_margin, 1 + list_margin, 2 + 2 * list_margin,
                                               2 + 2 * list_margin};
  ListedTriangle* next = listing.entry + listing.count;
  for (std::size_t t = first; t < last; ++t) {
    const std::uint32_t* corner = mesh.corner + 3 * t;
    const std::uint32_t* later = mesh.corner + 3 * std::min(t + triangles_ahead, mesh.triangles - 1);
    for (int i = 0; i < 3; ++i) hwy::Prefetch(vertices.low + later[i]);
    alignas(16) FaceParts parts;
    for (std::size_t k = 0; k < 4; k += hn::Lanes(d4)) {
      const auto least = [&](int i) { return hn::Load(d4, vertices.low[corner[i]].at + k); };
      const auto greatest = [&](int i) { return hn::Load(d4, vertices.high[corner[i]].at + k); };
      const auto first_of_all = hn::Min(least(0), hn::Min(least(1), least(2)));
      const auto last_of_all = hn::Max(greatest(0), hn::Max(greatest(1), greatest(2)));
      const auto low = hn::Mul(hn::Add(first_of_all, hn::Load(d4, low_shift + k)), scale);
      const auto high = hn::Mul(hn::Add(last_of_all, hn::Load(d4, high_shift + k)), scale);
      hn::StoreU(hn::Max(hn::ConvertTo(di4, low), hn::Zero(di4)), di4, parts.least.data() + k);
      hn::StoreU(hn::ConvertTo(di4, high), di4, parts.greatest.data() + k);
    }
    const int face = vertices.face[corner[0]];
    const int i0 = parts.least[0] >> 8, j0 = parts.least[1] >> 8;
    const int i1 = parts.greatest[0] >> 8, j1 = parts.greatest[1] >> 8;
    // At the face's edge the widened triangle reaches the next face.
    const bool at_edge = parts.least[0] == 0 || parts.least[1] == 0 || parts.greatest[0] >= last_part ||
                         parts.greatest[1] >= last_part;
    const bool on_one_face = face == vertices.face[corner[1]] && face == vertices.face[corner[2]];
    if (!on_one_face || at_edge || i1 - i0 > 1 || j1 - j0 > 1) {
      listing.elsewhere[listing.elsewhere_count++] = static_cast<std::uint32_t>(t);
      continue;
    }
    // Up to four cells, always worked out: which of them there are is not to be foretold.
    alignas(16) std::uint32_t cell[4], met[4], entry[16];
    for (std::size_t k = 0; k < 4; k += hn::Lanes(d4)) {
      const auto i = hn::Add(hn::Set(di4, i0), hn::Load(di4, column_step + k));
      const auto j = hn::Add(hn::Set(di4, j0), hn::Load(di4, row_step + k));
      const auto spare = hn::Iota(di4, 6 * n * n + static_cast<std::int32_t>(k));
      const OctagonsInCells<decltype(di4)> octagons(parts, n, i, j);
      const auto in_box = hn::Not(hn::Or(hn::Gt(i, hn::Set(di4, i1)), hn::Gt(j, hn::Set(di4, j1))));
      const auto meets = hn::And(in_box, octagons.meet);
      const auto own = hn::Add(hn::Mul(hn::Add(hn::Set(di4, face * n), j), hn::Set(di4, n)), i);
      const auto cells = hn::BitCast(du4, hn::IfThenElse(meets, own, spare));
      hn::Store(cells, du4, cell + k);
      hn::Store(hn::And(hn::BitCast(du4, hn::VecFromMask(di4, meets)), hn::Set(du4, 1)), du4, met + k);
      hn::StoreInterleaved4(cells, hn::Set(du4, static_cast<std::uint32_t>(t)),
                            hn::BitCast(du4, octagons.box), hn::BitCast(du4, octagons.slant), du4,
                            entry + 4 * k);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      std::memcpy(next, entry + 4 * k, sizeof *next);
      next += met[k];
      listing.length[cell[k]] += met[k];
    }
  }
  listing.count = static_cast<std::size_t>(next - listing.entry);
}

/// An edge of a triangle on a face, over the cells of a tile: inside is where normal . (p - start) >= 0. The
/// point of a cell that is furthest inside is one of its corners, and its value moves by equal steps from
/// cell to cell. Where floats err by less than list_margin (|u| + |w|), the other half of the widening, a
/// cell is left out only if no point of it, widened, is inside.
struct EdgeOverCells {
  float first;  ///< of the cell (0, 0) of the face, less what counts as outside
  float to_next_column, to_next_row;

  EdgeOverCells(const FaceTriangle& triangle, std::size_t k, float sign, float cell) {
    const std::size_t next = k == 2 ? 0 : k + 1;
    const float u = sign * (triangle.w[k] - triangle.w[next]), w = sign * (triangle.u[next] - triangle.u[k]);
    const float slack = std::abs(u) * (2 * list_margin + triangle.slack_u) +
                        std::abs(w) * (2 * list_margin + triangle.slack_w);
    const float best_u = u > 0 ? cell - 1 : -1.0f, best_w = w > 0 ? cell - 1 : -1.0f;
    first = u * (best_u - triangle.u[k]) + w * (best_w - triangle.w[k]) + slack;
    to_next_column = u * cell, to_next_row = w * cell;
  }
};

/// Of a sliver the turn may be rounding: it keeps its octagon. Places err by up to 8 u, u = 2^-24.
struct TurnOnFace {
  float sign;
  bool is_known;

  explicit TurnOnFace(const FaceTriangle& t) {
    const float turn = (t.u[1] - t.u[0]) * (t.w[2] - t.w[0]) - (t.w[1] - t.w[0]) * (t.u[2] - t.u[0]);
    const auto extent = [](const float* x) {
      return std::max({x[0], x[1], x[2]}) - std::min({x[0], x[1], x[2]});
    };
    sign = turn < 0 ? -1.0f : 1.0f;
    is_known = std::abs(turn) > 16 * list_margin * std::max(extent(t.u), extent(t.w));
  }
};

/// Cells that are looked at together: four columns, and as many rows as fill a vector.
using TileFloats = hn::CappedTag<float, 16>;
using TileInts = hn::RebindToSigned<TileFloats>;
using TileWords = hn::RebindToUnsigned<TileFloats>;
constexpr int tile_cells = static_cast<int>(hn::MaxLanes(TileFloats()));
constexpr int tile_columns = std::min(4, tile_cells), tile_rows = tile_cells / tile_columns;

void list_face_triangles_any(const FaceTriangle* triangles, std::size_t count, Listing& listing) {
  constexpr TileFloats d;
  constexpr TileInts di;
  constexpr TileWords du;
  const int n = listing.cells_per_side;
  const float cell = 2.0f / static_cast<float>(n);
  const auto lane = hn::Iota(di, 0);
  const auto column_step = hn::And(lane, hn::Set(di, tile_columns - 1));
  const auto row_step = tile_columns == 4 ? hn::ShiftRight<2>(lane) : hn::Zero(di);
  alignas(64) std::uint32_t cell_of_lane[tile_cells];
  alignas(64) std::uint32_t entry[4 * tile_cells];
  ListedTriangle* next = listing.entry + listing.count;
  for (const FaceTriangle& t : std::span(triangles, count)) {
    const int last_column = t.parts.greatest[0] >> 8, last_row = t.parts.greatest[1] >> 8;
    const TurnOnFace turn(t);
    const EdgeOverCells edge[3] = {EdgeOverCells(t, 0, turn.sign, cell), EdgeOverCells(t, 1, turn.sign, cell),
                                   EdgeOverCells(t, 2, turn.sign, cell)};
    for (int row = t.parts.least[1] >> 8; row <= last_row; row += tile_rows) {
      for (int column = t.parts.least[0] >> 8; column <= last_column; column += tile_columns) {
        const auto i = hn::Add(hn::Set(di, column), column_step), j = hn::Add(hn::Set(di, row), row_step);
        const OctagonsInCells<TileInts> octagons(t.parts, n, i, j);
        const auto beyond = hn::Or(hn::Gt(i, hn::Set(di, last_column)), hn::Gt(j, hn::Set(di, last_row)));
        auto meets = hn::And(octagons.meet, hn::Not(beyond));
        if (turn.is_known) {
          const auto at_column = hn::ConvertTo(d, i), at_row = hn::ConvertTo(d, j);
          const auto least = [&](const EdgeOverCells& e) {
            return hn::Add(hn::Add(hn::Set(d, e.first), hn::Mul(at_column, hn::Set(d, e.to_next_column))),
                           hn::Mul(at_row, hn::Set(d, e.to_next_row)));
          };
          const auto worst = hn::Min(least(edge[0]), hn::Min(least(edge[1]), least(edge[2])));
          meets = hn::And(meets, hn::RebindMask(di, hn::Ge(worst, hn::Zero(d))));
        }
        const auto own = hn::Add(hn::Mul(hn::Add(hn::Set(di, t.face * n), j), hn::Set(di, n)), i);
        const auto cells = hn::BitCast(du, own);
        hn::Store(cells, du, cell_of_lane);
        hn::StoreInterleaved4(cells, hn::Set(du, t.triangle), hn::BitCast(du, octagons.box),
                              hn::BitCast(du, octagons.slant), du, entry);
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(di, meets, bytes);
        for (unsigned left = bytes[0] | static_cast<unsigned>(bytes[1]) << 8; left != 0; left &= left - 1) {
          const std::size_t k = hwy::Num0BitsBelowLS1Bit_Nonzero32(left);
          std::memcpy(next++, entry + 4 * k, sizeof *next);
          ++listing.length[cell_of_lane[k]];
        }
      }
    }
  }
  listing.count = static_cast<std::size_t>(next - listing.entry);
}

}  // namespace
}  // namespace condyle::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle {

HWY_EXPORT(list_small_triangles_any);
HWY_EXPORT(list_face_triangles_any);

void list_small_triangles(const MeshView& mesh, const PlacedVertices& vertices, std::size_t first,
                          std::size_t last, Listing& listing) {
  HWY_DYNAMIC_DISPATCH(list_small_triangles_any)(mesh, vertices, first, last, listing);
}

void list_face_triangles(const FaceTriangle* triangles, std::size_t count, Listing& listing) {
  HWY_DYNAMIC_DISPATCH(list_face_triangles_any)(triangles, count, listing);
}

}  // namespace condyle
#endif
