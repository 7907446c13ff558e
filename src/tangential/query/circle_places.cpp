#include "tangential/query/circle_places.hpp"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangential/query/circle_places.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace condyle::tangential::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Number of the cell, and the byte in it, of values in cells from the grid's border: as doubles.
template <class V>
struct Steps {
  V cell, part;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE Steps<V> steps(D d, V cells, Index count) {
  const auto zero = hn::Zero(d);
  const auto cell = hn::Min(hn::Max(hn::Trunc(cells), zero), hn::Set(d, static_cast<double>(count - 1)));
  const auto part = hn::Trunc(hn::Mul(hn::Sub(cells, cell), hn::Set(d, 256.0)));
  return {cell, hn::Min(hn::Max(part, zero), hn::Set(d, 255.0))};
}

/// Places as many points as there are lanes, from `first` on; returns how many circles there are then.
template <class D>
HWY_INLINE std::size_t place_some(D d, const AxisFrame& frame, const ProfileGrid& grid,
                                  const PointsView& points, std::size_t first, std::size_t circles,
                                  PlacedCircles& out) {
  constexpr std::size_t lanes = hn::MaxLanes(d);
  const auto from_axis_point = [&](std::span<const double> values, double origin) {
    return hn::Sub(hn::LoadU(d, values.data() + first), hn::Set(d, origin));
  };
  const auto px = from_axis_point(points.x, frame.point().x()),
             py = from_axis_point(points.y, frame.point().y()),
             pz = from_axis_point(points.z, frame.point().z());
  // As AxisFrame::to_axis.
  const auto row = [&](int i) {
    const auto times = [&](hn::Vec<D> p, int k) { return hn::Mul(hn::Set(d, frame.rotation()(i, k)), p); };
    return hn::Add(hn::Add(times(px, 0), times(py, 1)), times(pz, 2));
  };
  const auto x = row(0), y = row(1), z = row(2);
  const auto squared_radius = hn::Add(hn::Mul(x, x), hn::Mul(y, y)), rho = hn::Sqrt(squared_radius);
  const auto set = [&](double value) { return hn::Set(d, value); };
  const auto within = hn::And(hn::And(hn::Ge(rho, set(grid.rho_min)), hn::Le(rho, set(grid.rho_max))),
                              hn::And(hn::Ge(z, set(grid.z_min)), hn::Le(z, set(grid.z_max))));
  const auto at_rho =
      steps(d, hn::Mul(hn::Sub(rho, set(grid.rho_min)), set(grid.columns_per_mm)), grid.columns);
  const auto at_z = steps(d, hn::Mul(hn::Sub(z, set(grid.z_min)), set(grid.rows_per_mm)), grid.rows);
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
    out.place[circles] = {static_cast<Index>(cells[i]), static_cast<CellBox>(boxes[i]) ^ 0x80000000u};
    out.number[circles++] = static_cast<Index>(first + i);
  }
  return circles;
}

std::size_t place_any(const AxisFrame& frame, const ProfileGrid& grid, const PointsView& points,
                      PlacedCircles& out) {
  constexpr hn::CappedTag<double, 8> d;
  std::size_t i = 0, circles = 0;
  for (; i + hn::Lanes(d) <= points.size(); i += hn::Lanes(d))
    circles = place_some(d, frame, grid, points, i, circles, out);
  for (; i < points.size(); ++i)
    circles = place_some(hn::CappedTag<double, 1>(), frame, grid, points, i, circles, out);
  return circles;
}

}  // namespace
}  // namespace condyle::tangential::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::tangential {

HWY_EXPORT(place_any);

void place_circles(const AxisFrame& frame, const ProfileGrid& grid, PointsView points, PlacedCircles& out) {
  const auto resize = [&](std::size_t count) {
    out.point.resize(count), out.place.resize(count), out.number.resize(count);
  };
  resize(points.size());
  resize(HWY_DYNAMIC_DISPATCH(place_any)(frame, grid, points, out));
}

}  // namespace condyle::tangential
#endif
