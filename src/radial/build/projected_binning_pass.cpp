#include <algorithm>

#include "radial/build/cube_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "radial/build/projected_binning_pass.cpp"
#include <hwy/foreach_target.h>
#include "radial/build/dops-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {
namespace {

using simd::HWY_NAMESPACE::compacted;

/// Triangles projected on faces, one in each lane: the constants of their cells.
struct ProjectedBatch {
  /// Parts of the face that they take, widened: of u, w, u + w and u - w.
  alignas(64) std::int32_t least[4][lanes], greatest[4][lanes];
  /// Last column and row; -1 where the triangle is beside the face.
  alignas(64) std::int32_t last_column[lanes], last_row[lanes];
  /// Their edges over the face's cells: inside is where normal . (p - start) >= 0. The point of a cell that
  /// is furthest inside is one of its corners, and its value moves by equal steps from cell to cell; `first`
  /// is that in the cell (0, 0), and what counts as outside on top. Floats err by less than list_margin
  /// (|u| + |w|), the other half of the widening: a cell is left out only if no point of it, widened, is
  /// inside. All zero for slivers, of which the sense may be rounding: these keep their 8-DOPs.
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
struct ProjectedCorners {
  LaneVector u[3], w[3], slack_u, slack_w;
};

HWY_INLINE void find_parts(const ProjectedCorners& at, int cells_per_side, ProjectedBatch& batch) {
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
HWY_INLINE void find_last_cells(const ProjectedCorners& at, ProjectedBatch& batch) {
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

HWY_INLINE void find_edges(const ProjectedCorners& at, float cell, ProjectedBatch& batch) {
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

HWY_INLINE void read_projected(const ProjectedTriangles& projected, std::size_t first, int cells_per_side,
                               ProjectedBatch& batch) {
  constexpr LaneFloats d;
  ProjectedCorners at;
  hn::LoadInterleaved4(d, projected.u[first].at, at.u[0], at.u[1], at.u[2], at.slack_u);
  hn::LoadInterleaved4(d, projected.w[first].at, at.w[0], at.w[1], at.w[2], at.slack_w);
  find_parts(at, cells_per_side, batch);
  find_last_cells(at, batch);
  find_edges(at, 2.0f / static_cast<float>(cells_per_side), batch);
}

/// Cells that are processed together: four columns, and as many rows as fill a vector.
constexpr int tile_cells = static_cast<int>(lanes);
constexpr int tile_columns = std::min(4, tile_cells), tile_rows = tile_cells / tile_columns;

/// Entries of the cells that a triangle meets, one behind the other; returns how many they are. May write as
/// many as there are lanes. How many it meets cannot be predicted.
HWY_INLINE std::size_t store_met(hn::Mask<Lanes> meets, hn::Vec<Words> cell, std::uint32_t triangle,
                                 hn::Vec<Words> axis, hn::Vec<Words> diagonal, CellEntry* to) {
  constexpr Words du;
  static_assert(binning_padding >= lanes && sizeof *to == 4 * sizeof(std::uint32_t));
  const auto met = hn::RebindMask(du, meets);
  hn::StoreInterleaved4(compacted(du, cell, met), hn::Set(du, triangle), compacted(du, axis, met),
                        compacted(du, diagonal, met), du, &to->cell);
  return hn::CountTrue(du, met);
}

/// Lists one triangle of a batch.
HWY_INLINE CellEntry* bin_projected_triangle(const ProjectedBatch& batch, std::size_t lane, int face,
                                             std::uint32_t triangle, int n, CellEntry* next) {
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
      const DopsInCells<Lanes> dops(parts, n, i, j);
      const auto beyond = hn::Or(hn::Gt(i, hn::Set(di, last_column)), hn::Gt(j, hn::Set(di, last_row)));
      const auto at_column = hn::ConvertTo(d, i), at_row = hn::ConvertTo(d, j);
      const auto inside = [&](std::size_t k) {
        const auto in_column = hn::Mul(at_column, hn::Set(d, batch.to_next_column[k][lane]));
        const auto in_row = hn::Mul(at_row, hn::Set(d, batch.to_next_row[k][lane]));
        return hn::Add(hn::Add(hn::Set(d, batch.first[k][lane]), in_column), in_row);
      };
      const auto least = hn::Min(inside(0), hn::Min(inside(1), inside(2)));
      const auto is_inside = hn::RebindMask(di, hn::Ge(least, hn::Zero(d)));
      const auto meets = hn::And(hn::And(dops.meet, hn::Not(beyond)), is_inside);
      const auto own = hn::Add(hn::Mul(hn::Add(hn::Set(di, face * n), j), hn::Set(di, n)), i);
      next += store_met(meets, hn::BitCast(du, own), triangle, hn::BitCast(du, dops.axis),
                        hn::BitCast(du, dops.diagonal), next);
    }
  }
  return next;
}

std::size_t bin_projected_triangles_any(const ProjectedTriangles& projected, std::size_t first,
                                        Binning& binning) {
  ProjectedBatch batch;
  CellEntry* next = binning.entry + binning.count;
  std::size_t binned = first;
  const auto has_capacity = [&](std::size_t lane) {
    const int columns = batch.last_column[lane] - (batch.least[0][lane] >> 8) + 1;
    const int rows = batch.last_row[lane] - (batch.least[1][lane] >> 8) + 1;
    const auto made = static_cast<std::size_t>(next - binning.entry);
    const int cells = std::max(columns, 0) * std::max(rows, 0);
    return made + static_cast<std::size_t>(cells) + binning_padding <= binning.capacity;
  };
  for (std::size_t lane = lanes; binned < projected.count; ++binned, ++lane) {
    if (lane == lanes) {
      read_projected(projected, binned, binning.cells_per_side, batch);
      lane = 0;
    }
    if (!has_capacity(lane)) break;
    next = bin_projected_triangle(batch, lane, projected.face[binned], projected.triangle[binned],
                                  binning.cells_per_side, next);
  }
  for (const CellEntry* entry = binning.entry + binning.count; entry != next; ++entry)
    ++binning.length[entry->cell];
  binning.count = static_cast<std::size_t>(next - binning.entry);
  return binned;
}

}  // namespace
}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::radial {

HWY_EXPORT(bin_projected_triangles_any);

std::size_t bin_projected_triangles(const ProjectedTriangles& projected, std::size_t first,
                                    Binning& binning) {
  return HWY_DYNAMIC_DISPATCH(bin_projected_triangles_any)(projected, first, binning);
}

}  // namespace condyle::radial
#endif
