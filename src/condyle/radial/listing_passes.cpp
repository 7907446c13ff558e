#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

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

/// Triangles seen on faces, one in each lane: what is asked of their cells.
struct SeenBatch {
  /// Parts of the face that they take, widened: of u, w, u + w and u - w.
  alignas(64) std::int32_t least[4][lanes], greatest[4][lanes];
  /// Last column and row; -1 where the triangle is beside the face.
  alignas(64) std::int32_t last_column[lanes], last_row[lanes];
  /// Their edges over the face's cells: inside is where normal . (p - start) >= 0. The point of a cell that
  /// is furthest inside is one of its corners, and its value moves by equal steps from cell to cell; `first`
  /// is that in the cell (0, 0), and what counts as outside on top. Floats err by less than list_margin
  /// (|u| + |w|), the other half of the widening: a cell is left out only if no point of it, widened, is
  /// inside. All zero for slivers, of which the turn may be rounding: these keep their octagons.
  alignas(64) float first[3][lanes], to_next_column[3][lanes], to_next_row[3][lanes];
};

using LaneVector = hn::Vec<LaneFloats>;

HWY_INLINE LaneVector least_of(const LaneVector* at) {
  return hn::Min(at[0], hn::Min(at[1], at[2]));
}
HWY_INLINE LaneVector greatest_of(const LaneVector* at) {
  return hn::Max(at[0], hn::Max(at[1], at[2]));
}

/// Corners of as many triangles as there are lanes, and how far they may be from there.
struct SeenCorners {
  LaneVector u[3], w[3], slack_u, slack_w;
};

HWY_INLINE void find_parts(const SeenCorners& at, int cells_per_side, SeenBatch& batch) {
  constexpr LaneFloats d;
  constexpr Lanes di;
  const int last = cells_per_side * parts_per_cell - 1;
  const auto scale = hn::Set(d, 0.5f * static_cast<float>(cells_per_side * parts_per_cell));
  const auto margin_u = hn::Add(at.slack_u, hn::Set(d, list_margin));
  const auto margin_w = hn::Add(at.slack_w, hn::Set(d, list_margin));
  const auto store = [&](std::size_t k, const LaneVector* corner, LaneVector margin, float start, int most) {
    const auto part = [&](LaneVector value) {
      const auto whole = hn::ConvertTo(di, hn::Mul(hn::Add(value, hn::Set(d, start)), scale));
      return hn::Min(hn::Max(whole, hn::Zero(di)), hn::Set(di, most));
    };
    hn::Store(part(hn::Sub(least_of(corner), margin)), di, batch.least[k]);
    hn::Store(part(hn::Add(greatest_of(corner), margin)), di, batch.greatest[k]);
  };
  const LaneVector sum[3] = {hn::Add(at.u[0], at.w[0]), hn::Add(at.u[1], at.w[1]), hn::Add(at.u[2], at.w[2])};
  const LaneVector difference[3] = {hn::Sub(at.u[0], at.w[0]), hn::Sub(at.u[1], at.w[1]),
                                    hn::Sub(at.u[2], at.w[2])};
  store(0, at.u, margin_u, 1, last);
  store(1, at.w, margin_w, 1, last);
  store(2, sum, hn::Add(margin_u, margin_w), 2, 2 * last + 1);
  store(3, difference, hn::Add(margin_u, margin_w), 2, 2 * last + 1);
}

/// After the parts are found. Beside the face are triangles of which all corners are beyond the same edge.
HWY_INLINE void find_last_cells(const SeenCorners& at, SeenBatch& batch) {
  constexpr LaneFloats d;
  constexpr Lanes di;
  const auto is_beyond = [&](const LaneVector* corner, LaneVector slack) {
    const auto edge = hn::Add(hn::Set(d, 1 + 2 * list_margin), slack);
    return hn::Or(hn::Lt(greatest_of(corner), hn::Neg(edge)), hn::Gt(least_of(corner), edge));
  };
  const auto is_beside = hn::RebindMask(di, hn::Or(is_beyond(at.u, at.slack_u), is_beyond(at.w, at.slack_w)));
  const auto last = [&](std::size_t k) {
    return hn::IfThenElse(is_beside, hn::Set(di, -1), hn::ShiftRight<8>(hn::Load(di, batch.greatest[k])));
  };
  hn::Store(last(0), di, batch.last_column);
  hn::Store(last(1), di, batch.last_row);
}

HWY_INLINE void find_edges(const SeenCorners& at, float cell, SeenBatch& batch) {
  constexpr LaneFloats d;
  const auto set = [](float value) { return hn::Set(LaneFloats(), value); };
  const auto turn = hn::Sub(hn::Mul(hn::Sub(at.u[1], at.u[0]), hn::Sub(at.w[2], at.w[0])),
                            hn::Mul(hn::Sub(at.w[1], at.w[0]), hn::Sub(at.u[2], at.u[0])));
  // Places err by up to 8 u, u = 2^-24.
  const auto extent =
      hn::Max(hn::Sub(greatest_of(at.u), least_of(at.u)), hn::Sub(greatest_of(at.w), least_of(at.w)));
  const auto are_known = hn::Gt(hn::Abs(turn), hn::Mul(set(16 * list_margin), extent));
  const auto sign = hn::CopySign(set(1), turn), low = set(-1), width = set(cell);
  const auto slack_u = hn::Add(set(2 * list_margin), at.slack_u);
  const auto slack_w = hn::Add(set(2 * list_margin), at.slack_w);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = k == 2 ? 0 : k + 1;
    const auto u = hn::Mul(sign, hn::Sub(at.w[k], at.w[next])),
               w = hn::Mul(sign, hn::Sub(at.u[next], at.u[k]));
    const auto step_u = hn::Mul(u, width), step_w = hn::Mul(w, width);
    const auto at_u = hn::Mul(u, hn::Sub(low, at.u[k])), at_w = hn::Mul(w, hn::Sub(low, at.w[k]));
    const auto best =
        hn::Add(hn::Add(at_u, hn::Max(step_u, hn::Zero(d))), hn::Add(at_w, hn::Max(step_w, hn::Zero(d))));
    const auto slack = hn::Add(hn::Mul(hn::Abs(u), slack_u), hn::Mul(hn::Abs(w), slack_w));
    hn::Store(hn::IfThenElseZero(are_known, hn::Add(best, slack)), d, batch.first[k]);
    hn::Store(hn::IfThenElseZero(are_known, step_u), d, batch.to_next_column[k]);
    hn::Store(hn::IfThenElseZero(are_known, step_w), d, batch.to_next_row[k]);
  }
}

HWY_INLINE void read_seen(const SeenTriangles& seen, std::size_t first, int cells_per_side,
                          SeenBatch& batch) {
  constexpr LaneFloats d;
  SeenCorners at;
  hn::LoadInterleaved4(d, seen.u[first].at, at.u[0], at.u[1], at.u[2], at.slack_u);
  hn::LoadInterleaved4(d, seen.w[first].at, at.w[0], at.w[1], at.w[2], at.slack_w);
  find_parts(at, cells_per_side, batch);
  find_last_cells(at, batch);
  find_edges(at, 2.0f / static_cast<float>(cells_per_side), batch);
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

/// Lists one triangle of a batch.
HWY_INLINE ListedTriangle* list_seen_triangle(const SeenBatch& batch, std::size_t lane, int face,
                                              std::uint32_t triangle, int n, ListedTriangle* next) {
  constexpr LaneFloats d;
  constexpr Lanes di;
  constexpr Words du;
  const auto in_tile = hn::Iota(di, 0);
  const auto column_step = hn::And(in_tile, hn::Set(di, tile_columns - 1));
  const auto row_step = tile_columns == 4 ? hn::ShiftRight<2>(in_tile) : hn::Zero(di);
  PartsInLanes<Lanes> parts;
  for (std::size_t k = 0; k < 4; ++k) {
    parts.least[k] = hn::Set(di, batch.least[k][lane]),
    parts.greatest[k] = hn::Set(di, batch.greatest[k][lane]);
  }
  const int first_column = batch.least[0][lane] >> 8, first_row = batch.least[1][lane] >> 8;
  const int last_column = batch.last_column[lane], last_row = batch.last_row[lane];
  for (int row = first_row; row <= last_row; row += tile_rows) {
    for (int column = first_column; column <= last_column; column += tile_columns) {
      const auto i = hn::Add(hn::Set(di, column), column_step), j = hn::Add(hn::Set(di, row), row_step);
      const OctagonsInCells<Lanes> octagons(parts, n, i, j);
      const auto beyond = hn::Or(hn::Gt(i, hn::Set(di, last_column)), hn::Gt(j, hn::Set(di, last_row)));
      const auto at_column = hn::ConvertTo(d, i), at_row = hn::ConvertTo(d, j);
      const auto inside = [&](std::size_t k) {
        const auto in_column = hn::Mul(at_column, hn::Set(d, batch.to_next_column[k][lane]));
        const auto in_row = hn::Mul(at_row, hn::Set(d, batch.to_next_row[k][lane]));
        return hn::Add(hn::Add(hn::Set(d, batch.first[k][lane]), in_column), in_row);
      };
      const auto least = hn::Min(inside(0), hn::Min(inside(1), inside(2)));
      const auto is_inside = hn::RebindMask(di, hn::Ge(least, hn::Zero(d)));
      const auto meets = hn::And(hn::And(octagons.meet, hn::Not(beyond)), is_inside);
      const auto own = hn::Add(hn::Mul(hn::Add(hn::Set(di, face * n), j), hn::Set(di, n)), i);
      next += store_met(meets, hn::BitCast(du, own), triangle, hn::BitCast(du, octagons.box),
                        hn::BitCast(du, octagons.slant), next);
    }
  }
  return next;
}

std::size_t list_seen_triangles_any(const SeenTriangles& seen, std::size_t first, Listing& listing) {
  SeenBatch batch;
  ListedTriangle* next = listing.entry + listing.count;
  std::size_t listed = first;
  const auto has_room = [&](std::size_t lane) {
    const int columns = batch.last_column[lane] - (batch.least[0][lane] >> 8) + 1;
    const int rows = batch.last_row[lane] - (batch.least[1][lane] >> 8) + 1;
    const auto made = static_cast<std::size_t>(next - listing.entry);
    const int cells = std::max(columns, 0) * std::max(rows, 0);
    return made + static_cast<std::size_t>(cells) + listing_room <= listing.room;
  };
  for (std::size_t lane = lanes; listed < seen.count; ++listed, ++lane) {
    if (lane == lanes) {
      read_seen(seen, listed, listing.cells_per_side, batch);
      lane = 0;
    }
    if (!has_room(lane)) break;
    next = list_seen_triangle(batch, lane, seen.face[listed], seen.triangle[listed], listing.cells_per_side,
                              next);
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
HWY_EXPORT(list_seen_triangles_any);

void list_small_triangles(const MeshView& mesh, const PlacedVertices& vertices, std::size_t first,
                          std::size_t last, Listing& listing) {
  HWY_DYNAMIC_DISPATCH(list_small_triangles_any)(mesh, vertices, first, last, listing);
}

std::size_t list_seen_triangles(const SeenTriangles& seen, std::size_t first, Listing& listing) {
  return HWY_DYNAMIC_DISPATCH(list_seen_triangles_any)(seen, first, listing);
}

}  // namespace condyle
#endif
