#include "condyle/tangential/box_cells.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "condyle/tangential/box_cells.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace condyle::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
constexpr D d;
constexpr hn::RebindToSigned<D> di;

/// A side of some boxes; `outwards` is -1 for the lower and 1 for the upper side. Reads whole vectors as far
/// as there are boxes, and the last ones one by one.
HWY_INLINE void sides_of(const BoxScale::Axis& axis, const float* from, std::size_t count, float outwards,
                         std::int32_t* to) {
  const auto side = [&](auto tag, std::size_t i) {
    const hn::RebindToSigned<decltype(tag)> whole;
    const auto steps =
        hn::Mul(hn::Sub(hn::LoadU(tag, from + i), hn::Set(tag, axis.origin)), hn::Set(tag, axis.per_unit));
    const auto moved = hn::Add(steps, hn::Set(tag, outwards * axis.slack));
    const auto within = hn::Min(hn::Max(moved, hn::Zero(tag)), hn::Set(tag, axis.last));
    hn::StoreU(hn::ConvertTo(whole, within), whole, to + i);
  };
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) side(d, i);
  for (; i < count; ++i) side(hn::CappedTag<float, 1>(), i);
}

void sides_any(const BoxScale::Axis& rho, const BoxScale::Axis& z, const ProfileBoxes& boxes,
               std::size_t first, std::size_t count, BoxSidesBatch& out) {
  sides_of(rho, boxes.rho_low.data() + first, count, -1, out.rho_low.data());
  sides_of(rho, boxes.rho_high.data() + first, count, 1, out.rho_high.data());
  sides_of(z, boxes.z_low.data() + first, count, -1, out.z_low.data());
  sides_of(z, boxes.z_high.data() + first, count, 1, out.z_high.data());
}

}  // namespace
}  // namespace condyle::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle {

HWY_EXPORT(sides_any);

namespace {

/// The difference, the scale and the product are each rounded once, to 2^-24 of at most 256 n: `slack` is
/// four times that, and the smallest number that counts.
BoxScale::Axis axis_of(double from, double cells_per_mm, Index cells, double units_per_mm) noexcept {
  const double parts = 256.0 * cells;
  return {static_cast<float>(from * units_per_mm), static_cast<float>(256 * cells_per_mm / units_per_mm),
          static_cast<float>(parts * 0x1p-22 + 0x1p-6), static_cast<float>(parts - 1)};
}

}  // namespace

BoxScale::BoxScale(const ProfileGrid& grid, double units_per_mm) noexcept
    : rho_(axis_of(grid.rho_min, grid.columns_per_mm, grid.columns, units_per_mm)),
      z_(axis_of(grid.z_min, grid.rows_per_mm, grid.rows, units_per_mm)) {}

void BoxScale::sides(const ProfileBoxes& boxes, std::size_t first, std::size_t count,
                     BoxSidesBatch& out) const {
  HWY_DYNAMIC_DISPATCH(sides_any)(rho_, z_, boxes, first, count, out);
}

BoxSides BoxScale::sides(const ProfileBoxes& boxes, std::size_t triangle) const {
  BoxSidesBatch one;
  sides(boxes, triangle, 1, one);
  return one[0];
}

}  // namespace condyle
#endif
