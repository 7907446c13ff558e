#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
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

/// Parts of a face that triangles take, one in each lane or one in all.
template <class DI>
struct PartsInLanes {
  hn::Vec<DI> least[4], greatest[4];
};

/// Octagons of triangles in cells, lane by lane, and whether the triangle does not keep off the cell. A
/// point's parts are rounded down one by one: their sum may be 1 less than that of what it is rounded from,
/// their difference 1 more. One part more on either side is for points on the face's last edge.
template <class DI>
struct OctagonsInCells {
  using Ints = hn::Vec<DI>;
  hn::Mask<DI> meet;
  Ints box, slant;

  HWY_INLINE OctagonsInCells(const PartsInLanes<DI>& parts, int n, Ints column, Ints row) {
    constexpr DI di;
    const auto set = [](int value) { return hn::Set(DI(), value); };
    const auto within = [&](Ints value, int most) {
      return hn::Min(hn::Max(value, hn::Zero(di)), set(most));
    };
    const auto word = [&](Ints least_a, Ints greatest_a, Ints least_b, Ints greatest_b) {
      const auto a = hn::Or(least_a, hn::ShiftLeft<8>(hn::Sub(set(255), greatest_a)));
      const auto b = hn::Or(least_b, hn::ShiftLeft<8>(hn::Sub(set(255), greatest_b)));
      return hn::Or(a, hn::ShiftLeft<16>(b));
    };
    const auto u = hn::ShiftLeft<8>(column), w = hn::ShiftLeft<8>(row);
    const auto sum = hn::Add(u, w), difference = hn::Add(hn::Sub(u, w), set(parts_per_cell * n - 255));
    const auto least_sum = hn::Sub(parts.least[2], hn::Add(sum, set(2)));
    const auto greatest_sum = hn::Sub(parts.greatest[2], hn::Sub(sum, set(1)));
    const auto least_difference = hn::Sub(parts.least[3], hn::Add(difference, set(1)));
    const auto greatest_difference = hn::Sub(parts.greatest[3], hn::Sub(difference, set(2)));
    const auto most = set(510);
    const auto before = hn::Or(hn::Lt(greatest_sum, hn::Zero(di)), hn::Lt(greatest_difference, hn::Zero(di)));
    meet = hn::Not(hn::Or(before, hn::Or(hn::Gt(least_sum, most), hn::Gt(least_difference, most))));
    box = word(within(hn::Sub(parts.least[0], u), 255), within(hn::Sub(parts.greatest[0], u), 255),
               within(hn::Sub(parts.least[1], w), 255), within(hn::Sub(parts.greatest[1], w), 255));
    const auto half = [&](Ints value) { return hn::ShiftRight<1>(within(value, 510)); };
    slant = word(half(least_sum), half(greatest_sum), half(least_difference), half(greatest_difference));
  }
};

/// As many triangles, or cells of one, as are looked at together.
using Lanes = hn::CappedTag<std::int32_t, 16>;
using Words = hn::RebindToUnsigned<Lanes>;
using LaneFloats = hn::RebindToFloat<Lanes>;
constexpr std::size_t lanes = hn::MaxLanes(Lanes());

/// Triangles one after the other: least and greatest part of each that it takes of its face, and that face,
/// or -1 where it is on several.
struct TriangleBatch {
  alignas(64) std::int32_t least[lanes][4];
  alignas(64) std::int32_t greatest[lanes][4];
  alignas(64) std::int32_t face[lanes];
};

#if HWY_TARGET != HWY_SCALAR
constexpr hn::CappedTag<float, 4> four;

/// FaceRoom::lowest() and highest().
HWY_INLINE hn::Vec<decltype(four)> end_of_room(hn::Vec<decltype(four)> room, const std::int32_t* first,
                                               const std::int32_t* second) {
  constexpr hn::RebindToSigned<decltype(four)> words;
  alignas(16) constexpr std::int32_t is_added[4] = {0, 0, -1, -1};
  alignas(16) constexpr std::int32_t is_negative[4] = {0, 0, 0, std::numeric_limits<std::int32_t>::min()};
  const auto a = hn::TableLookupLanes(room, hn::SetTableIndices(four, first));
  const auto b = hn::And(hn::TableLookupLanes(room, hn::SetTableIndices(four, second)),
                         hn::BitCast(four, hn::Load(words, is_added)));
  return hn::Add(a, hn::Xor(b, hn::BitCast(four, hn::Load(words, is_negative))));
}
#endif

/// Coordinates of a vertex's place from the given one on, as many as fit the tag: the least ones, or the
/// greatest.
template <bool has_rooms, bool is_least, class Tag>
HWY_INLINE hn::Vec<Tag> end_of_place(Tag tag, const PlacedVertices& vertices, std::uint32_t vertex,
                                     std::size_t coordinate) {
  if constexpr (!has_rooms) {
    return hn::Load(tag, vertices.place[vertex].at + coordinate);
  } else {
#if HWY_TARGET == HWY_SCALAR
    const FaceRoom& room = vertices.room[vertex];
    return hn::Set(tag, (is_least ? room.lowest() : room.highest()).at[coordinate]);
#else
    alignas(16) static constexpr std::int32_t first[2][4] = {{2, 3, 2, 2}, {0, 1, 0, 0}};
    alignas(16) static constexpr std::int32_t second[2][4] = {{3, 3, 3, 1}, {1, 1, 1, 3}};
    const auto room = hn::LoadU(tag, &vertices.room[vertex].low_u);
    return end_of_room(room, first[is_least], second[is_least]);
#endif
  }
}

/// Triangles from the given one on; the last one again where there are not as many.
template <bool has_rooms>
HWY_INLINE void read_triangles(const MeshView& mesh, const PlacedVertices& vertices, std::size_t first,
                               std::size_t count, int cells_per_side, TriangleBatch& batch) {
  constexpr hn::CappedTag<float, 4> d4;
  constexpr hn::RebindToSigned<decltype(d4)> di4;
  const auto scale = hn::Set(d4, 0.5f * static_cast<float>(cells_per_side * parts_per_cell));
  alignas(16) constexpr float low_shift[4] = {1 - list_margin, 1 - list_margin, 2 - 2 * list_margin,
                                              2 - 2 * list_margin};
  alignas(16) constexpr float high_shift[4] = {1 + list_margin, 1 + list_margin, 2 + 2 * list_margin,
                                               2 + 2 * list_margin};
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::size_t t = first + std::min(lane, count - 1);
    const std::uint32_t* corner = mesh.corner + 3 * t;
    const std::uint32_t* later = mesh.corner + 3 * std::min(t + triangles_ahead, mesh.triangles - 1);
    for (int i = 0; i < 3; ++i) {
      if constexpr (has_rooms) {
        hwy::Prefetch(vertices.room + later[i]);
      } else {
        hwy::Prefetch(vertices.place + later[i]);
      }
    }
    for (std::size_t k = 0; k < 4; k += hn::MaxLanes(d4)) {
      const auto least = [&](int i) { return end_of_place<has_rooms, true>(d4, vertices, corner[i], k); };
      const auto greatest = [&](int i) { return end_of_place<has_rooms, false>(d4, vertices, corner[i], k); };
      const auto first_of_all = hn::Min(least(0), hn::Min(least(1), least(2)));
      const auto last_of_all = hn::Max(greatest(0), hn::Max(greatest(1), greatest(2)));
      const auto low = hn::Mul(hn::Add(first_of_all, hn::Load(d4, low_shift + k)), scale);
      const auto high = hn::Mul(hn::Add(last_of_all, hn::Load(d4, high_shift + k)), scale);
      hn::Store(hn::ConvertTo(di4, low), di4, batch.least[lane] + k);
      hn::Store(hn::ConvertTo(di4, high), di4, batch.greatest[lane] + k);
    }
    const int face = vertices.face[corner[0]];
    const bool is_on_one = face == vertices.face[corner[1]] && face == vertices.face[corner[2]];
    batch.face[lane] = is_on_one ? face : -1;
  }
}

void list_small_triangles_any(const MeshView& mesh, const PlacedVertices& vertices, std::size_t first,
                              std::size_t last, Listing& listing) {
  constexpr Lanes di;
  constexpr Words du;
  const int n = listing.cells_per_side;
  const auto last_part = hn::Set(di, n * parts_per_cell - 1), one = hn::Set(di, 1), zero = hn::Zero(di);
  TriangleBatch batch;
  // Up to four cells of each, always worked out: which of them there are is not to be foretold.
  alignas(64) std::uint32_t entry[4][4 * lanes], cell[4][lanes], met[4][lanes];
  ListedTriangle* next = listing.entry + listing.count;
  for (std::size_t t = first; t < last; t += lanes) {
    const std::size_t count = std::min(lanes, last - t);
    if (vertices.room != nullptr) {
      read_triangles<true>(mesh, vertices, t, count, n, batch);
    } else {
      read_triangles<false>(mesh, vertices, t, count, n, batch);
    }
    PartsInLanes<Lanes> parts;
    hn::LoadInterleaved4(di, batch.least[0], parts.least[0], parts.least[1], parts.least[2], parts.least[3]);
    hn::LoadInterleaved4(di, batch.greatest[0], parts.greatest[0], parts.greatest[1], parts.greatest[2],
                         parts.greatest[3]);
    const auto face = hn::Load(di, batch.face);
    const auto i0 = hn::ShiftRight<8>(parts.least[0]), j0 = hn::ShiftRight<8>(parts.least[1]);
    const auto i1 = hn::ShiftRight<8>(parts.greatest[0]), j1 = hn::ShiftRight<8>(parts.greatest[1]);
    // At the face's edge the widened triangle reaches the next face.
    const auto is_off_edges =
        hn::And(hn::And(hn::Gt(parts.least[0], zero), hn::Gt(parts.least[1], zero)),
                hn::And(hn::Lt(parts.greatest[0], last_part), hn::Lt(parts.greatest[1], last_part)));
    const auto is_larger = hn::Or(hn::Gt(hn::Sub(i1, i0), one), hn::Gt(hn::Sub(j1, j0), one));
    const auto is_small = hn::And(hn::And(is_off_edges, hn::Not(hn::Lt(face, zero))), hn::Not(is_larger));
    if (!hn::AllTrue(di, is_small)) {
      alignas(64) std::int32_t is_here[lanes];
      hn::Store(hn::VecFromMask(di, is_small), di, is_here);
      for (std::size_t k = 0; k < count; ++k) {
        listing.elsewhere[listing.elsewhere_count] = static_cast<std::uint32_t>(t + k);
        listing.elsewhere_count += is_here[k] == 0 ? 1 : 0;
      }
    }
    const auto triangle = hn::Iota(du, static_cast<std::uint32_t>(t));
    for (int q = 0; q < 4; ++q) {
      const auto i = hn::Add(i0, hn::Set(di, q & 1)), j = hn::Add(j0, hn::Set(di, q >> 1));
      const OctagonsInCells<Lanes> octagons(parts, n, i, j);
      const auto beyond = hn::Or(hn::Gt(i, i1), hn::Gt(j, j1));
      const auto meets = hn::And(hn::And(is_small, octagons.meet), hn::Not(beyond));
      const auto row = hn::Add(hn::Mul(face, hn::Set(di, n)), j);
      const auto own = hn::Add(hn::Mul(row, hn::Set(di, n)), i);
      const auto cells = hn::BitCast(du, hn::IfThenElse(meets, own, hn::Set(di, 6 * n * n + q)));
      hn::Store(cells, du, cell[q]);
      hn::Store(hn::And(hn::BitCast(du, hn::VecFromMask(di, meets)), hn::Set(du, 1)), du, met[q]);
      hn::StoreInterleaved4(cells, triangle, hn::BitCast(du, octagons.box), hn::BitCast(du, octagons.slant),
                            du, entry[q]);
    }
    for (std::size_t k = 0; k < count; ++k) {
      for (int q = 0; q < 4; ++q) {
        std::memcpy(next, entry[q] + 4 * k, sizeof *next);
        next += met[q][k];
        listing.length[cell[q][k]] += met[q][k];
      }
    }
  }
  listing.count = static_cast<std::size_t>(next - listing.entry);
}

/// The edges of a triangle on a face, over its cells: inside is where normal . (p - start) >= 0. The point of
/// a cell that is furthest inside is one of its corners, and its value moves by equal steps from cell to
/// cell. Floats err by less than list_margin (|u| + |w|), the other half of the widening: a cell is left out
/// only if no point of it, widened, is inside.
struct EdgesOverCells {
  alignas(16) float first[4];  ///< in the cell (0, 0) of the face, and what counts as outside on top
  alignas(16) float to_next_column[4];
  alignas(16) float to_next_row[4];
  bool are_known;

  HWY_INLINE EdgesOverCells(const FaceTriangle& t, float cell) {
    constexpr hn::CappedTag<float, 4> d4;
    const float turn = (t.u[1] - t.u[0]) * (t.w[2] - t.w[0]) - (t.w[1] - t.w[0]) * (t.u[2] - t.u[0]);
    // Of a sliver the turn may be rounding: it keeps its octagon. Places err by up to 8 u, u = 2^-24.
    const auto extent = [](const float* x) {
      return std::max({x[0], x[1], x[2]}) - std::min({x[0], x[1], x[2]});
    };
    are_known = std::abs(turn) > 16 * list_margin * std::max(extent(t.u), extent(t.w));
    const auto sign = hn::Set(d4, std::copysign(1.0f, turn)), low = hn::Set(d4, -1.0f);
    const auto width = hn::Set(d4, cell), slack_u = hn::Set(d4, 2 * list_margin + t.slack_u);
    const auto slack_w = hn::Set(d4, 2 * list_margin + t.slack_w);
    for (std::size_t k = 0; k < 3; k += hn::MaxLanes(d4)) {
      const auto start_u = hn::LoadU(d4, t.u + k), start_w = hn::LoadU(d4, t.w + k);
      const auto u = hn::Mul(sign, hn::Sub(start_w, hn::LoadU(d4, t.w + k + 1)));
      const auto w = hn::Mul(sign, hn::Sub(hn::LoadU(d4, t.u + k + 1), start_u));
      const auto step_u = hn::Mul(u, width), step_w = hn::Mul(w, width);
      const auto at_u = hn::Mul(u, hn::Sub(low, start_u)), at_w = hn::Mul(w, hn::Sub(low, start_w));
      const auto best =
          hn::Add(hn::Add(at_u, hn::Max(step_u, hn::Zero(d4))), hn::Add(at_w, hn::Max(step_w, hn::Zero(d4))));
      const auto slack = hn::Add(hn::Mul(hn::Abs(u), slack_u), hn::Mul(hn::Abs(w), slack_w));
      hn::Store(hn::Add(best, slack), d4, first + k);
      hn::Store(step_u, d4, to_next_column + k);
      hn::Store(step_w, d4, to_next_row + k);
    }
  }
};

/// Parts of the face that the triangle takes, widened. Corners may lie off the face.
HWY_INLINE FaceParts parts_of(const FaceTriangle& t, int cells_per_side) {
  constexpr hn::CappedTag<float, 4> d4;
  constexpr hn::RebindToSigned<decltype(d4)> di4;
  const float margin_u = t.slack_u + list_margin, margin_w = t.slack_w + list_margin;
  alignas(16) const float margin[4] = {margin_u, margin_w, margin_u + margin_w, margin_u + margin_w};
  alignas(16) constexpr float start[4] = {1, 1, 2, 2};
  const int last = cells_per_side * parts_per_cell - 1;
  alignas(16) const std::int32_t most[4] = {last, last, 2 * last + 1, 2 * last + 1};
  const auto scale = hn::Set(d4, 0.5f * static_cast<float>(cells_per_side * parts_per_cell));
  FaceParts parts;
  for (std::size_t k = 0; k < 4; k += hn::MaxLanes(d4)) {
    const auto a = hn::Load(d4, t.corner[0].at + k), b = hn::Load(d4, t.corner[1].at + k);
    const auto c = hn::Load(d4, t.corner[2].at + k), by = hn::Load(d4, margin + k);
    const auto from = hn::Load(d4, start + k);
    const auto low = hn::Sub(hn::Min(a, hn::Min(b, c)), by), high = hn::Add(hn::Max(a, hn::Max(b, c)), by);
    const auto part = [&](auto at) {
      const auto whole = hn::ConvertTo(di4, hn::Mul(hn::Add(at, from), scale));
      return hn::Min(hn::Max(whole, hn::Zero(di4)), hn::Load(di4, most + k));
    };
    hn::StoreU(part(low), di4, parts.least.data() + k);
    hn::StoreU(part(high), di4, parts.greatest.data() + k);
  }
  return parts;
}

/// Whether all corners are beyond the same edge of the face.
HWY_INLINE bool is_beside_face(const FaceTriangle& t) {
  const auto is_beyond = [](const float* at, float slack) {
    const float edge = 1 + 2 * list_margin + slack;
    return std::max({at[0], at[1], at[2]}) < -edge || std::min({at[0], at[1], at[2]}) > edge;
  };
  return is_beyond(t.u, t.slack_u) || is_beyond(t.w, t.slack_w);
}

/// Cells that are looked at together: four columns, and as many rows as fill a vector.
constexpr int tile_cells = static_cast<int>(lanes);
constexpr int tile_columns = std::min(4, tile_cells), tile_rows = tile_cells / tile_columns;

/// Entries of the cells that a triangle meets, one behind the other; returns how many they are. May write as
/// many as there are lanes. How many it meets is not to be foretold: sixteen lanes have an instruction for
/// that.
HWY_INLINE std::size_t store_met(hn::Mask<Lanes> meets, hn::Vec<Words> cell, std::uint32_t triangle,
                                 hn::Vec<Words> box, hn::Vec<Words> slant, ListedTriangle* to) {
  constexpr Lanes di;
  constexpr Words du;
  const auto all = hn::Set(du, triangle);
  if constexpr (lanes == 16) {
    static_assert(listing_room >= lanes && sizeof *to == 4 * sizeof(std::uint32_t));
    const auto met = hn::RebindMask(du, meets);
    hn::StoreInterleaved4(hn::Compress(cell, met), all, hn::Compress(box, met), hn::Compress(slant, met), du,
                          &to->cell);
    return hn::CountTrue(di, meets);
  } else {
    alignas(64) std::uint32_t entry[4 * lanes];
    hn::StoreInterleaved4(cell, all, box, slant, du, entry);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(di, meets, bits);
    std::size_t count = 0;
    for (unsigned left = bits[0]; left != 0; left &= left - 1)
      std::memcpy(to + count++, entry + 4 * hwy::Num0BitsBelowLS1Bit_Nonzero32(left), sizeof *to);
    return count;
  }
}

std::size_t list_face_triangles_any(std::span<const FaceTriangle> triangles, Listing& listing) {
  constexpr LaneFloats d;
  constexpr Lanes di;
  constexpr Words du;
  const int n = listing.cells_per_side;
  const auto lane = hn::Iota(di, 0);
  const auto column_step = hn::And(lane, hn::Set(di, tile_columns - 1));
  const auto row_step = tile_columns == 4 ? hn::ShiftRight<2>(lane) : hn::Zero(di);
  ListedTriangle* next = listing.entry + listing.count;
  std::size_t listed = 0;
  for (; listed < triangles.size(); ++listed) {
    const FaceTriangle& t = triangles[listed];
    if (is_beside_face(t)) continue;
    const FaceParts taken = parts_of(t, n);
    const int first_column = taken.least[0] >> 8, last_column = taken.greatest[0] >> 8;
    const int first_row = taken.least[1] >> 8, last_row = taken.greatest[1] >> 8;
    const auto cells_in_box =
        static_cast<std::size_t>((last_column - first_column + 1) * (last_row - first_row + 1));
    const auto made = static_cast<std::size_t>(next - listing.entry);
    if (made + cells_in_box + listing_room > listing.room) break;
    PartsInLanes<Lanes> parts;
    for (std::size_t k = 0; k < 4; ++k) {
      parts.least[k] = hn::Set(di, taken.least[k]), parts.greatest[k] = hn::Set(di, taken.greatest[k]);
    }
    const EdgesOverCells edges(t, 2.0f / static_cast<float>(n));
    for (int row = first_row; row <= last_row; row += tile_rows) {
      for (int column = first_column; column <= last_column; column += tile_columns) {
        const auto i = hn::Add(hn::Set(di, column), column_step), j = hn::Add(hn::Set(di, row), row_step);
        const OctagonsInCells<Lanes> octagons(parts, n, i, j);
        const auto beyond = hn::Or(hn::Gt(i, hn::Set(di, last_column)), hn::Gt(j, hn::Set(di, last_row)));
        auto meets = hn::And(octagons.meet, hn::Not(beyond));
        if (edges.are_known) {
          const auto at_column = hn::ConvertTo(d, i), at_row = hn::ConvertTo(d, j);
          const auto inside = [&](std::size_t k) {
            const auto in_column = hn::Mul(at_column, hn::Set(d, edges.to_next_column[k]));
            const auto in_row = hn::Mul(at_row, hn::Set(d, edges.to_next_row[k]));
            return hn::Add(hn::Add(hn::Set(d, edges.first[k]), in_column), in_row);
          };
          const auto least = hn::Min(inside(0), hn::Min(inside(1), inside(2)));
          meets = hn::And(meets, hn::RebindMask(di, hn::Ge(least, hn::Zero(d))));
        }
        const auto own = hn::Add(hn::Mul(hn::Add(hn::Set(di, t.face * n), j), hn::Set(di, n)), i);
        next += store_met(meets, hn::BitCast(du, own), t.triangle, hn::BitCast(du, octagons.box),
                          hn::BitCast(du, octagons.slant), next);
      }
    }
  }
  for (const ListedTriangle* entry = listing.entry + listing.count; entry != next; ++entry)
    ++listing.length[entry->cell];
  listing.count = static_cast<std::size_t>(next - listing.entry);
  return listed;
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

std::size_t list_face_triangles(std::span<const FaceTriangle> triangles, Listing& listing) {
  return HWY_DYNAMIC_DISPATCH(list_face_triangles_any)(triangles, listing);
}

}  // namespace condyle
#endif
