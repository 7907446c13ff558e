#include "tangential/query/circle_cells.hpp"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangential/query/circle_cells.cpp"
#include <hwy/foreach_target.h>
#include "simd/prelude-inl.hpp"

#include "simd/axis_rotation-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::tangential::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace simd = simd::HWY_NAMESPACE;

/// Along one axis of the profile: the cell, and the byte in it, as doubles.
template <class V>
struct Coordinate {
  V cell, part;
};

/// Cells of values that are measured in cells from the grid's border.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Coordinate<V> coordinate(D d, V cells, Index count) {
  const auto zero = hn::Zero(d);
  const auto cell = hn::Min(hn::Max(hn::Trunc(cells), zero), hn::Set(d, static_cast<double>(count - 1)));
  const auto part = hn::Trunc(hn::Mul(hn::Sub(cells, cell), hn::Set(d, 256.0)));
  return {cell, hn::Min(hn::Max(part, zero), hn::Set(d, 255.0))};
}

/// Cells of as many points as there are lanes, from `first` on; returns how many circles there are then.
template <class D>
HWY_INLINE std::size_t locate_some(D d, const AxisFrame& frame, const ProfileGrid& grid,
                                   const PointsView& points, std::size_t first, std::size_t circles,
                                   LocatedCircles& out) {
  constexpr std::size_t lanes = hn::MaxLanes(d);
  const auto [x, y, z] = simd::to_axis(d, frame, points, first);
  const auto squared_radius = hn::Add(hn::Mul(x, x), hn::Mul(y, y)), rho = hn::Sqrt(squared_radius);
  const auto set = [&](double value) { return hn::Set(d, value); };
  const auto within = hn::And(hn::And(hn::Ge(rho, set(grid.rho_min)), hn::Le(rho, set(grid.rho_max))),
                              hn::And(hn::Ge(z, set(grid.z_min)), hn::Le(z, set(grid.z_max))));
  const auto at_rho =
      coordinate(d, hn::Mul(hn::Sub(rho, set(grid.rho_min)), set(grid.columns_per_mm)), grid.columns);
  const auto at_z = coordinate(d, hn::Mul(hn::Sub(z, set(grid.z_min)), set(grid.rows_per_mm)), grid.rows);
  const auto cell = hn::Add(hn::Mul(at_z.cell, set(grid.columns)), at_rho.cell);
  // Bytes z, 255 - z, rho, 255 - rho as one whole number, less 2^31, to be converted as a signed one.
  const auto bytes = [&](hn::Vec<D> part) {
    return hn::Add(part, hn::Mul(set(256), hn::Sub(set(255), part)));
  };
  const auto all_bytes = hn::Add(bytes(at_z.part), hn::Mul(set(65536), bytes(at_rho.part)));
  const hn::Rebind<std::int32_t, D> whole;
  alignas(64) std::array<double, 4 * lanes> fours;
  alignas(64) std::array<std::int32_t, lanes> cells, boxes;
  hn::StoreInterleaved4(x, y, z, squared_radius, d, fours.data());
  hn::Store(hn::DemoteTo(whole, cell), whole, cells.data());
  hn::Store(hn::DemoteTo(whole, hn::Sub(all_bytes, set(0x1p31))), whole, boxes.data());
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, within, bits);
  for (unsigned left = bits[0]; left != 0; left &= left - 1) {
    const std::size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero32(left);
    out.point[circles] = {fours[4 * i], fours[4 * i + 1], fours[4 * i + 2], fours[4 * i + 3]};
    out.cell[circles] = {static_cast<Index>(cells[i]), static_cast<CellBox>(boxes[i]) ^ 0x80000000u};
    out.number[circles++] = static_cast<Index>(first + i);
  }
  return circles;
}

std::size_t locate_any(const AxisFrame& frame, const ProfileGrid& grid, const PointsView& points,
                       LocatedCircles& out) {
  constexpr hn::CappedTag<double, 8> d;
  std::size_t i = 0, circles = 0;
  for (; i + hn::Lanes(d) <= points.size(); i += hn::Lanes(d))
    circles = locate_some(d, frame, grid, points, i, circles, out);
  for (; i < points.size(); ++i)
    circles = locate_some(hn::CappedTag<double, 1>(), frame, grid, points, i, circles, out);
  return circles;
}

}  // namespace
}  // namespace condyle::tangential::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::tangential {

HWY_EXPORT(locate_any);

void locate_circles(const AxisFrame& frame, const ProfileGrid& grid, PointsView points, LocatedCircles& out) {
  const auto resize = [&](std::size_t count) {
    out.point.resize(count), out.cell.resize(count), out.number.resize(count);
  };
  resize(points.size());
  resize(HWY_DYNAMIC_DISPATCH(locate_any)(frame, grid, points, out));
}

}  // namespace condyle::tangential
#endif
