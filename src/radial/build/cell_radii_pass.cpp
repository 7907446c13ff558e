#include <algorithm>
#include <limits>

#include "radial/build/cube_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "radial/build/cell_radii_pass.cpp"
#include <hwy/foreach_target.h>
#include "simd/packed_intervals-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using simd::HWY_NAMESPACE::hull_of_lanes;

/// As many triangles at a time as most rows have, or half of them.
using D = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<D>;
using Floats = hn::Vec<D>;
using Ints = hn::Vec<DI>;
constexpr D d;
constexpr DI di;
constexpr std::size_t lanes = hn::MaxLanes(d);
constexpr std::size_t prefetch_ahead = 16;

/// First corner of a cell (u, w), and one over the lengths of the directions to that, and of those a width
/// further in u, in w, in both: of one cell in all lanes, or of another in each.
struct CornersInLanes {
  Floats u, w, inverse[4];
};

/// A cell: which coordinate is which on its face, and its corners there.
struct CellCorners {
  int axis, axis_u, axis_w;
  float sign, u, w, inverse[4];

  CellCorners(const RadiiView& view, int cell) {
    const int n = view.cells_per_side, row_of_all = cell / n, face = row_of_all / n;
    const int row = row_of_all - face * n, column = cell - row_of_all * n;
    axis = face % 3, axis_u = (face + 1) % 3, axis_w = (face + 2) % 3;
    sign = face < 3 ? 1.0f : -1.0f;
    const float width = 2.0f / static_cast<float>(n);
    u = static_cast<float>(column) * width - 1, w = static_cast<float>(row) * width - 1;
    const float* at = view.inverse_length + row * (n + 1) + column;
    inverse[0] = at[0], inverse[1] = at[1], inverse[2] = at[n + 1], inverse[3] = at[n + 2];
  }
  CornersInLanes in_lanes() const {
    const auto set = [](float value) { return hn::Set(d, value); };
    return {set(u), set(w), {set(inverse[0]), set(inverse[1]), set(inverse[2]), set(inverse[3])}};
  }
};

struct Bounds {
  Floats least, greatest;
};

/// Bounds of planes n . p = 1, within cells of the given width; least <= 0, or greatest < 0, if there is none. n is
/// along the face's normal.
HWY_INLINE Bounds view_planes(const CornersInLanes& cell, float width, float cosine, Floats n, Floats n_u,
                              Floats n_w) {
  const auto set = [](float value) { return hn::Set(d, value); };
  const auto margin = hn::Mul(set(0x1p-14f), hn::Add(hn::Abs(n), hn::Add(hn::Abs(n_u), hn::Abs(n_w))));
  const auto corner = hn::Add(n, hn::Add(hn::Mul(n_u, cell.u), hn::Mul(n_w, cell.w)));
  const auto to_u = hn::Mul(n_u, set(width)), to_w = hn::Mul(n_w, set(width));
  const auto further = hn::Add(corner, to_w);
  const auto a = hn::Mul(corner, cell.inverse[0]);
  const auto b = hn::Mul(hn::Add(corner, to_u), cell.inverse[1]);
  const auto c = hn::Mul(further, cell.inverse[2]);
  const auto e = hn::Mul(hn::Add(further, to_u), cell.inverse[3]);
  const auto low = hn::Min(hn::Min(a, b), hn::Min(c, e)), high = hn::Max(hn::Max(a, b), hn::Max(c, e));
  // The form is positive where rays leave the solid, negative where they enter.
  const auto enters = hn::Lt(hn::Add(high, low), hn::Zero(d));
  const auto least = hn::IfThenElse(enters, hn::Neg(high), low);
  const auto greatest = hn::IfThenElse(enters, hn::Neg(low), high);
  return {hn::Div(set(cosine), hn::Add(greatest, margin)), hn::Div(set(1), hn::Sub(least, margin))};
}

/// Data of as many triangles as there are lanes: normals, by axis or as a face has them, and radii.
struct Planes {
  Floats n[3];
  Ints radii;
};

/// Side by side, then turned into columns: gathering each column takes several times as long.
HWY_INLINE Planes load_planes(const TrianglePlane* planes, const std::uint32_t* triangle) {
  Planes out;
#if HWY_MAX_BYTES >= 64
  constexpr hn::Full128<float> d4;
  constexpr hn::Full256<float> d8;
  constexpr hn::Repartition<double, D> d64;
  const auto one = [&](std::size_t i) { return hn::Load(d4, planes[triangle[i]].n); };
  // Block b of row k holds triangle 4 b + k.
  const auto row = [&](std::size_t k) {
    return hn::Combine(d, hn::Combine(d8, one(k + 12), one(k + 8)), hn::Combine(d8, one(k + 4), one(k)));
  };
  const auto a = row(0), b = row(1), c = row(2), e = row(3);
  const auto ab_low = hn::BitCast(d64, hn::InterleaveLower(d, a, b));
  const auto ab_high = hn::BitCast(d64, hn::InterleaveUpper(d, a, b));
  const auto ce_low = hn::BitCast(d64, hn::InterleaveLower(d, c, e));
  const auto ce_high = hn::BitCast(d64, hn::InterleaveUpper(d, c, e));
  out.n[0] = hn::BitCast(d, hn::InterleaveLower(d64, ab_low, ce_low));
  out.n[1] = hn::BitCast(d, hn::InterleaveUpper(d64, ab_low, ce_low));
  out.n[2] = hn::BitCast(d, hn::InterleaveLower(d64, ab_high, ce_high));
  out.radii = hn::BitCast(di, hn::InterleaveUpper(d64, ab_high, ce_high));
#else
  alignas(64) TrianglePlane rows[lanes];
  for (std::size_t k = 0; k < lanes; ++k) rows[k] = planes[triangle[k]];
  Floats radii;
  hn::LoadInterleaved4(d, rows[0].n, out.n[0], out.n[1], out.n[2], radii);
  out.radii = hn::BitCast(di, radii);
#endif
  return out;
}

/// Squared radii of packed intervals.
HWY_INLINE Bounds view_words(const IntervalScale& scale, Ints words) {
  const auto most = hn::Set(di, greatest_radius_code);
  const auto least = hn::And(words, most);
  const auto greatest = hn::Sub(most, hn::And(hn::ShiftRight<16>(words), most));
  // The first number of a code, and the last one before the next.
  const auto bits = [&](Ints code) {
    return hn::Add(hn::Set(di, scale.base), hn::ShiftLeftSame(code, scale.shift));
  };
  const auto first = hn::BitCast(d, bits(least));
  const auto last = hn::BitCast(d, hn::Sub(bits(hn::Add(greatest, hn::Set(di, 1))), hn::Set(di, 1)));
  const auto has_least = hn::RebindMask(d, hn::Gt(least, hn::Zero(di)));
  const auto has_greatest = hn::RebindMask(d, hn::Lt(greatest, most));
  const float infinity = std::numeric_limits<float>::infinity();
  return {hn::IfThenElseZero(has_least, first), hn::IfThenElse(has_greatest, last, hn::Set(d, infinity))};
}

/// Packed intervals of squared radii.
HWY_INLINE Ints intervals_of_radii(const IntervalScale& scale, const Bounds& squared) {
  using simd::HWY_NAMESPACE::interval_codes;
  return simd::HWY_NAMESPACE::packed_intervals(di, interval_codes(d, scale, squared.least),
                                               interval_codes(d, scale, squared.greatest));
}

/// Results for entries: their radii, all together, and packed.
struct Results {
  Floats least = hn::Set(d, std::numeric_limits<float>::infinity()), greatest = hn::Zero(d);
  Ints words;

  explicit Results(PackedInterval start) : words(hn::Set(di, static_cast<std::int32_t>(start))) {}

  void add(const Bounds& squared) {
    least = hn::Min(least, squared.least), greatest = hn::Max(greatest, squared.greatest);
  }
  void add(Ints more) { words = hull_of_lanes(di, words, more); }
  SurfaceRadii radii() const {
    return {hn::GetLane(hn::MinOfLanes(d, least)), hn::GetLane(hn::MaxOfLanes(d, greatest))};
  }
  PackedInterval interval() const { return hull_of_all_lanes(di, words); }

 private:
  template <class Tag>
  static HWY_INLINE PackedInterval hull_of_all_lanes([[maybe_unused]] Tag tag, hn::Vec<Tag> all) {
#if HWY_TARGET != HWY_SCALAR
    if constexpr (hn::MaxLanes(tag) > 1) {
      constexpr hn::Half<Tag> half;
      return hull_of_all_lanes(half, hull_of_lanes(half, hn::LowerHalf(half, all), hn::UpperHalf(half, all)));
    }
#endif
    return static_cast<PackedInterval>(hn::GetLane(all));
  }
};

/// Squared radii of triangles in cells, whose planes are as the cells' faces have them; infinity and 0
/// for those that are not there, or not wanted.
HWY_INLINE Bounds radii_in_cells(const RadiiView& view, const CornersInLanes& cell, const Planes& planes,
                                 hn::Mask<D> is_wanted) {
  const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
  const float width = 2.0f / static_cast<float>(view.cells_per_side);
  const Bounds of_planes = view_planes(cell, width, view.cosine, planes.n[0], planes.n[1], planes.n[2]);
  const Bounds of_triangles = view_words(view.scale, planes.radii);
  const auto square = [](Floats radius, float widened) {
    return hn::Mul(hn::Mul(radius, radius), hn::Set(d, widened));
  };
  // Neither is so for a plane that floats do not know.
  const auto is_nearest = hn::Gt(of_planes.least, hn::Zero(d));
  const auto is_furthest = hn::Gt(of_planes.greatest, hn::Zero(d));
  const auto nearest = hn::IfThenElseZero(is_nearest, square(of_planes.least, 1 - 0x1p-16f));
  const auto furthest = hn::IfThenElse(is_furthest, square(of_planes.greatest, 1 + 0x1p-16f), infinity);
  const auto least = hn::Max(of_triangles.least, nearest),
             greatest = hn::Min(of_triangles.greatest, furthest);
  const auto is_there = hn::And(is_wanted, hn::Le(least, greatest));
  return {hn::IfThenElse(is_there, least, infinity), hn::IfThenElseZero(is_there, greatest)};
}

HWY_INLINE hn::Mask<D> first_lanes(std::uint32_t count) {
  return hn::RebindMask(d, hn::Lt(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(count))));
}

/// The upper half of the code of a triangle's least squared radius.
HWY_INLINE Ints nearest_of(const Planes& planes) {
  return hn::And(hn::ShiftRight<8>(planes.radii), hn::Set(di, 255));
}

/// Planes as a face has them: along its normal, and along its columns and rows.
HWY_INLINE Planes on_face(const Planes& planes, const CellCorners& cell) {
  return {{hn::Mul(planes.n[cell.axis], hn::Set(d, cell.sign)), planes.n[cell.axis_u], planes.n[cell.axis_w]},
          planes.radii};
}

SurfaceRadii measure_rows_any(const RadiiView& view, std::span<const CellRow> rows, PackedInterval* out) {
  constexpr hn::Rebind<std::uint8_t, DI> d8;
  Results all(no_radii);
  for (std::size_t cell = 0; cell < rows.size(); ++cell) {
    const CellCorners at(view, static_cast<int>(cell));
    const CornersInLanes corners = at.in_lanes();
    const CellRow row = rows[cell];
    Results here(view.of_every_cell);
    for (std::uint32_t i = row.first; i < row.last; i += lanes) {
      const std::uint32_t* triangle = view.triangle + i;
      for (std::size_t k = 0; k < lanes; ++k) hwy::Prefetch(view.plane + triangle[k + prefetch_ahead]);
      const Planes planes = load_planes(view.plane, triangle);
      // Bytes after the row are written too: entries of the next one, rightly, or padding.
      hn::StoreU(hn::DemoteTo(d8, nearest_of(planes)), d8, view.nearest + i);
      const auto is_entry = first_lanes(row.last - i);
      const Bounds squared = radii_in_cells(view, corners, on_face(planes, at), is_entry);
      const Ints words = intervals_of_radii(view.scale, squared);
      if (view.entry_radii != nullptr) {
        auto* const to = reinterpret_cast<std::int32_t*>(view.entry_radii + i);
        hn::BlendedStore(words, hn::RebindMask(di, is_entry), di, to);
      }
      all.add(squared);
      here.add(words);
    }
    out[cell] = here.interval();
  }
  return all.radii();
}

/// Entries of several cells, one in each lane, with their planes as the cells' faces have them.
struct EntryBatch {
  alignas(64) float u[lanes], w[lanes], inverse[4][lanes], n[3][lanes];
  alignas(64) std::int32_t radii[lanes];

  HWY_INLINE void set(std::size_t lane, const CellCorners& cell, const TrianglePlane& plane) {
    u[lane] = cell.u, w[lane] = cell.w;
    for (std::size_t k = 0; k < 4; ++k) inverse[k][lane] = cell.inverse[k];
    n[0][lane] = cell.sign * plane.n[cell.axis];
    n[1][lane] = plane.n[cell.axis_u], n[2][lane] = plane.n[cell.axis_w];
    radii[lane] = static_cast<std::int32_t>(plane.radii);
  }
  CornersInLanes corners() const {
    return {
        hn::Load(d, u),
        hn::Load(d, w),
        {hn::Load(d, inverse[0]), hn::Load(d, inverse[1]), hn::Load(d, inverse[2]), hn::Load(d, inverse[3])}};
  }
  Planes planes() const {
    return {{hn::Load(d, n[0]), hn::Load(d, n[1]), hn::Load(d, n[2])}, hn::Load(di, radii)};
  }
};

/// Entries on their way to their rows, as many at a time as there are lanes.
class ChangedEntries {
 public:
  ChangedEntries(const RadiiView& view, ChangedEntry* out) : lists_(view), out_(out) {}

  HWY_INLINE void add(const CellCorners& cell, std::uint32_t triangle, const TrianglePlane& plane) {
    out_[lane_].triangle = triangle;
    batch_.set(lane_, cell, plane);
    if (++lane_ == lanes) measure();
  }
  SurfaceRadii finish() {
    measure();
    return all_.radii();
  }

 private:
  HWY_INLINE void measure() {
    const Planes planes = batch_.planes();
    const Bounds squared =
        radii_in_cells(lists_, batch_.corners(), planes, first_lanes(static_cast<std::uint32_t>(lane_)));
    all_.add(squared);
    alignas(64) std::int32_t word[lanes], nearest[lanes];
    hn::Store(intervals_of_radii(lists_.scale, squared), di, word);
    hn::Store(nearest_of(planes), di, nearest);
    for (std::size_t k = 0; k < lane_; ++k) {
      out_[k].radii = static_cast<PackedInterval>(word[k]), out_[k].nearest = nearest[k];
    }
    out_ += lane_;
    lane_ = 0;
  }

  const RadiiView& lists_;
  ChangedEntry* out_;
  std::size_t lane_ = 0;
  EntryBatch batch_{};
  Results all_{no_radii};
};

/// Writes entries into their row. Each is held against all entries, a vector of them at a time: where it is
/// cannot be predicted. What its entries are together.
HWY_INLINE PackedInterval write_entries(const RadiiView& view, CellRow row,
                                        std::span<const ChangedEntry> entries) {
  constexpr hn::Rebind<std::uint8_t, DI> d8;
  Results found(view.of_every_cell);
  for (std::uint32_t i = row.first; i < row.last; i += lanes) {
    const auto triangle = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(view.triangle + i));
    auto* const at = reinterpret_cast<std::int32_t*>(view.entry_radii + i);
    auto words = hn::LoadU(di, at), nearest = hn::PromoteTo(di, hn::LoadU(d8, view.nearest + i));
    for (const ChangedEntry& entry : entries) {
      const auto is_it = hn::Eq(triangle, hn::Set(di, static_cast<std::int32_t>(entry.triangle)));
      words = hn::IfThenElse(is_it, hn::Set(di, static_cast<std::int32_t>(entry.radii)), words);
      nearest = hn::IfThenElse(is_it, hn::Set(di, entry.nearest), nearest);
    }
    const auto is_entry = hn::RebindMask(di, first_lanes(row.last - i));
    hn::BlendedStore(words, is_entry, di, at);
    // The nearest one of a triangle is the same in all its cells.
    hn::StoreU(hn::DemoteTo(d8, nearest), d8, view.nearest + i);
    found.add(hn::IfThenElse(is_entry, words, hn::Set(di, -1)));
  }
  return found.interval();
}

/// How many cells before its turn the entries of a cell are fetched.
constexpr std::size_t cells_ahead = 8;

void prefetch_entries(const RadiiView& view, CellRow row) {
  constexpr std::uint32_t words_per_line = 16, bytes_per_line = 64;
  for (std::uint32_t i = row.first; i < row.last; i += words_per_line)
    hwy::Prefetch(view.triangle + i), hwy::Prefetch(view.entry_radii + i);
  for (std::uint32_t i = row.first; i < row.last; i += bytes_per_line) hwy::Prefetch(view.nearest + i);
}

std::size_t measure_changed_any(const RadiiView& view, const CellRow* rows, const ChangedTriangles& triangles,
                                ChangedEntry* scratch, PackedInterval* radii, SurfaceRadii& surface,
                                Index* changed) {
  ChangedEntries entries(view, scratch);
  for (std::size_t i = 0; i < triangles.cells.size(); ++i) {
    const CellCorners corners(view, static_cast<int>(triangles.cells[i]));
    for (const std::uint32_t place : triangles.in_cell(i))
      entries.add(corners, triangles.number[place], triangles.plane[place]);
  }
  const SurfaceRadii found = entries.finish();
  surface = {std::min(surface.least, found.least), std::max(surface.greatest, found.greatest)};
  std::size_t count = 0;
  for (std::size_t i = 0; i < triangles.cells.size(); ++i) {
    const std::uint32_t cell = triangles.cells[i];
    prefetch_entries(view, rows[triangles.cells[std::min(i + cells_ahead, triangles.cells.size() - 1)]]);
    const PackedInterval word =
        write_entries(view, rows[cell], {scratch + triangles.first[i], scratch + triangles.first[i + 1]});
    changed[count] = cell;
    count += word != radii[cell];
    radii[cell] = word;
  }
  return count;
}

}  // namespace
}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::radial {

HWY_EXPORT(measure_rows_any);
HWY_EXPORT(measure_changed_any);

SurfaceRadii measure_rows(const RadiiView& view, std::span<const CellRow> rows, PackedInterval* out) {
  return HWY_DYNAMIC_DISPATCH(measure_rows_any)(view, rows, out);
}

std::size_t measure_changed(const RadiiView& view, const CellRow* rows, const ChangedTriangles& triangles,
                            ChangedEntry* scratch, PackedInterval* radii, SurfaceRadii& surface,
                            Index* changed) {
  return HWY_DYNAMIC_DISPATCH(measure_changed_any)(view, rows, triangles, scratch, radii, surface, changed);
}

}  // namespace condyle::radial
#endif
