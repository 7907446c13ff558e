#include <algorithm>
#include <limits>

#include <hwy/cache_control.h>

#include "condyle/radial/cube_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "condyle/radial/cell_radii_pass.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace condyle::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// As many triangles at a time as most rows have, or half of them.
using D = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<D>;
using Floats = hn::Vec<D>;
using Ints = hn::Vec<DI>;
constexpr D d;
constexpr DI di;
constexpr std::size_t lanes = hn::MaxLanes(d);
constexpr std::size_t prefetch_ahead = 16;

/// A cell of a face, for the forms of planes: which coordinate is which there, and its corners.
struct CellCorners {
  int axis, axis_u, axis_w;
  float sign, u, w, width;
  float
      inverse[4];  ///< one over the lengths of (sign, u, w), and of those a width further in u, in w, in both

  CellCorners(const ListedRadii& lists, int face, int row, int column)
      : axis(face % 3), axis_u((face + 1) % 3), axis_w((face + 2) % 3), sign(face < 3 ? 1.0f : -1.0f) {
    const int n = lists.cells_per_side;
    width = 2.0f / static_cast<float>(n);
    u = static_cast<float>(column) * width - 1, w = static_cast<float>(row) * width - 1;
    const float* at = lists.inverse_length + row * (n + 1) + column;
    inverse[0] = at[0], inverse[1] = at[1], inverse[2] = at[n + 1], inverse[3] = at[n + 2];
  }
};

struct Bounds {
  Floats least, greatest;
};

/// Of planes n . p = 1, within the cell; least <= 0, or greatest < 0, where there is none.
HWY_INLINE Bounds radii_of_planes(const CellCorners& cell, float cosine, Floats forms_n, Floats n_u,
                                  Floats n_w) {
  const auto set = [](float value) { return hn::Set(d, value); };
  const auto n = hn::Mul(forms_n, set(cell.sign));
  const auto margin = hn::Mul(set(0x1p-14f), hn::Add(hn::Abs(n), hn::Add(hn::Abs(n_u), hn::Abs(n_w))));
  const auto corner = hn::Add(n, hn::Add(hn::Mul(n_u, set(cell.u)), hn::Mul(n_w, set(cell.w))));
  const auto to_u = hn::Mul(n_u, set(cell.width)), to_w = hn::Mul(n_w, set(cell.width));
  const auto further = hn::Add(corner, to_w);
  const auto a = hn::Mul(corner, set(cell.inverse[0]));
  const auto b = hn::Mul(hn::Add(corner, to_u), set(cell.inverse[1]));
  const auto c = hn::Mul(further, set(cell.inverse[2]));
  const auto e = hn::Mul(hn::Add(further, to_u), set(cell.inverse[3]));
  const auto low = hn::Min(hn::Min(a, b), hn::Min(c, e)), high = hn::Max(hn::Max(a, b), hn::Max(c, e));
  // The form is positive where rays leave the solid, negative where they enter.
  const auto enters = hn::Lt(hn::Add(high, low), hn::Zero(d));
  const auto least = hn::IfThenElse(enters, hn::Neg(high), low);
  const auto greatest = hn::IfThenElse(enters, hn::Neg(low), high);
  return {hn::Div(set(cosine), hn::Add(greatest, margin)), hn::Div(set(1), hn::Sub(least, margin))};
}

/// What is known of as many triangles as there are lanes.
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

/// Squared radii of a RadiusWord.
HWY_INLINE Bounds radii_of_words(const RadiusScale& scale, Ints words) {
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

HWY_INLINE CellRadii radii_of_row(const ListedRadii& lists, const CellCorners& cell, CellRow row) {
  const float infinity = std::numeric_limits<float>::infinity();
  auto all_least = hn::Set(d, infinity), all_greatest = hn::Zero(d);
  for (std::uint32_t i = row.first; i < row.last; i += lanes) {
    const std::uint32_t* triangle = lists.triangle + i;
    for (std::size_t k = 0; k < lanes; ++k) hwy::Prefetch(lists.plane + triangle[k + prefetch_ahead]);
    const Planes planes = load_planes(lists.plane, triangle);
    const auto is_listed =
        hn::RebindMask(d, hn::Lt(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(row.last - i))));
    const Bounds of_planes = radii_of_planes(cell, lists.cosine, planes.n[cell.axis], planes.n[cell.axis_u],
                                             planes.n[cell.axis_w]);
    // What follows the row is written too: entries of the next one, rightly, or room.
    const auto upper_half = hn::And(hn::ShiftRight<8>(planes.radii), hn::Set(di, 255));
    hn::StoreU(hn::DemoteTo(hn::Rebind<std::uint8_t, DI>(), upper_half), hn::Rebind<std::uint8_t, DI>(),
               lists.nearest + i);
    const Bounds of_triangles = radii_of_words(lists.scale, planes.radii);
    const auto square = [](Floats radius, float widened) {
      return hn::Mul(hn::Mul(radius, radius), hn::Set(d, widened));
    };
    // Neither is so for a plane that floats do not know.
    const auto is_nearest = hn::Gt(of_planes.least, hn::Zero(d));
    const auto is_furthest = hn::Gt(of_planes.greatest, hn::Zero(d));
    const auto nearest = hn::IfThenElseZero(is_nearest, square(of_planes.least, 1 - 0x1p-16f));
    const auto furthest =
        hn::IfThenElse(is_furthest, square(of_planes.greatest, 1 + 0x1p-16f), hn::Set(d, infinity));
    const auto least = hn::Max(of_triangles.least, nearest),
               greatest = hn::Min(of_triangles.greatest, furthest);
    all_least = hn::Min(all_least, hn::IfThenElse(is_listed, least, hn::Set(d, infinity)));
    all_greatest = hn::Max(all_greatest, hn::IfThenElseZero(is_listed, greatest));
  }
  return {hn::GetLane(hn::MinOfLanes(d, all_least)), hn::GetLane(hn::MaxOfLanes(d, all_greatest))};
}

CellRadii measure_row_any(const ListedRadii& lists, std::size_t cell, CellRow row) {
  const auto n = static_cast<std::size_t>(lists.cells_per_side);
  const CellCorners corners(lists, static_cast<int>(cell / (n * n)), static_cast<int>(cell / n % n),
                            static_cast<int>(cell % n));
  return radii_of_row(lists, corners, row);
}

void measure_rows_any(const ListedRadii& lists, std::span<const CellRow> rows, CellRadii* out) {
  for (std::size_t cell = 0; cell < rows.size(); ++cell) out[cell] = measure_row_any(lists, cell, rows[cell]);
}

}  // namespace
}  // namespace condyle::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle {

HWY_EXPORT(measure_row_any);
HWY_EXPORT(measure_rows_any);

CellRadii measure_row(const ListedRadii& lists, std::size_t cell, CellRow row) {
  return HWY_DYNAMIC_DISPATCH(measure_row_any)(lists, cell, row);
}

void measure_rows(const ListedRadii& lists, std::span<const CellRow> rows, CellRadii* out) {
  HWY_DYNAMIC_DISPATCH(measure_rows_any)(lists, rows, out);
}

}  // namespace condyle
#endif
