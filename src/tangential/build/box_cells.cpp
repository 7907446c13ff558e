#include "tangential/build/box_cells.hpp"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangential/build/box_cells.cpp"
#include <hwy/foreach_target.h>
#include "simd/prelude-inl.hpp"

#include "simd/lane_numbers-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::tangential::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace simd = simd::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
constexpr D d;
constexpr hn::RebindToSigned<D> di;
constexpr hn::RebindToUnsigned<D> du;
using Words = hn::Vec<decltype(du)>;
using Chosen = hn::Mask<decltype(du)>;

/// Sides of some boxes, as BoxScale::sides computes them; `outwards` is -1 for the lower one, 1 for the
/// upper.
HWY_INLINE Words side(const BoxScale::Axis& axis, const float* from, float outwards) {
  const auto steps = hn::Mul(hn::Sub(hn::LoadU(d, from), hn::Set(d, axis.origin)), hn::Set(d, axis.per_unit));
  const auto moved = hn::Add(steps, hn::Set(d, outwards * axis.slack));
  const auto within = hn::Min(hn::Max(moved, hn::Zero(d)), hn::Set(d, axis.last));
  return hn::BitCast(du, hn::ConvertTo(di, within));
}

/// Along one axis: the first cell, how many more there are, and half a CellBox in the first and in the last.
struct Span {
  Words first, more, box_in_first, box_in_last;
};

HWY_INLINE Span span_of(const BoxScale::Axis& axis, const float* low, const float* high) {
  const auto byte = hn::Set(du, 0xff);
  const auto from = side(axis, low, -1), to = side(axis, high, 1);
  const auto first = hn::ShiftRight<8>(from), more = hn::Sub(hn::ShiftRight<8>(to), first);
  const auto low_byte = hn::And(from, byte), high_byte = hn::ShiftLeft<8>(hn::AndNot(to, byte));
  const auto only = hn::IfThenElseZero(hn::Eq(more, hn::Zero(du)), high_byte);
  return {.first = first, .more = more, .box_in_first = hn::Or(low_byte, only), .box_in_last = high_byte};
}

void cells_any(const BoxScale::Axis& rho, const BoxScale::Axis& z, Index columns, const ProfileBoxes& boxes,
               std::size_t first, std::size_t count, BoxCells& out) {
  const auto one = hn::Set(du, 1);
  std::array<std::size_t, 4> counts{};
  std::size_t large_count = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const std::size_t at = first + i;
    const Span across = span_of(rho, boxes.rho_low.data() + at, boxes.rho_high.data() + at);
    const Span up = span_of(z, boxes.z_low.data() + at, boxes.z_high.data() + at);
    const auto there = hn::FirstN(du, count - i);
    const auto is_large = hn::And(there, hn::Gt(hn::Or(across.more, up.more), one));
    const auto is_small = hn::AndNot(is_large, there);
    const auto two_columns = hn::And(is_small, hn::Eq(across.more, one));
    const auto two_rows = hn::And(is_small, hn::Eq(up.more, one));
    const auto lower = hn::Add(hn::Mul(up.first, hn::Set(du, columns)), across.first);
    const auto upper = hn::Add(lower, hn::Set(du, columns));
    const auto put = [&](std::size_t k, Chosen in_use, Words cell, Words box_rho, Words box_z) {
      BoxCells::Corner& corner = out.corner[k];
      hn::Store(cell, du, corner.cell.data() + i);
      hn::Store(hn::Or(box_z, hn::ShiftLeft<16>(box_rho)), du, corner.box.data() + i);
      counts[k] += simd::store_lane_numbers(du, in_use, i, corner.in_use.data() + counts[k]);
    };
    put(0, is_small, lower, across.box_in_first, up.box_in_first);
    put(1, two_columns, hn::Add(lower, one), across.box_in_last, up.box_in_first);
    put(2, two_rows, upper, across.box_in_first, up.box_in_last);
    put(3, hn::And(two_columns, two_rows), hn::Add(upper, one), across.box_in_last, up.box_in_last);
    large_count += simd::store_lane_numbers(du, is_large, i, out.large.data() + large_count);
  }
  for (std::size_t k = 0; k < counts.size(); ++k) out.corner[k].count = counts[k];
  out.large_count = large_count;
}

}  // namespace
}  // namespace condyle::tangential::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::tangential {

HWY_EXPORT(cells_any);

namespace {

/// The difference, the scale and the product are each rounded once, to 2^-24 of at most 256 n: `slack` is
/// four times that, and the smallest number that counts.
BoxScale::Axis axis_of(double from, double cells_per_mm, Index cells, double units_per_mm) noexcept {
  const double parts = 256.0 * cells, per_unit = 256 * cells_per_mm / units_per_mm;
  // Cells that floats cannot distinguish, as of a mesh that lies in the axis: every box meets all of them.
  if (per_unit > std::numeric_limits<float>::max())
    return {.origin = 0,
            .per_unit = 0,
            .slack = static_cast<float>(parts),
            .last = static_cast<float>(parts - 1)};
  return {.origin = static_cast<float>(from * units_per_mm),
          .per_unit = static_cast<float>(per_unit),
          .slack = static_cast<float>(parts * 0x1p-22 + 0x1p-6),
          .last = static_cast<float>(parts - 1)};
}

}  // namespace

BoxScale::BoxScale(const ProfileGrid& grid, double units_per_mm) noexcept
    : rho_(axis_of(grid.rho_min, grid.columns_per_mm, grid.columns, units_per_mm)),
      z_(axis_of(grid.z_min, grid.rows_per_mm, grid.rows, units_per_mm)),
      columns_(grid.columns) {}

void BoxScale::cells(const ProfileBoxes& boxes, std::size_t first, std::size_t count, BoxCells& out) const {
  HWY_DYNAMIC_DISPATCH(cells_any)(rho_, z_, columns_, boxes, first, count, out);
}

}  // namespace condyle::tangential
#endif
