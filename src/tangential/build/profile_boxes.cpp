#include "tangential/build/profile_boxes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tangential/build/free_directions.hpp"

#ifndef CONDYLE_TANGENTIAL_SECTORS
#define CONDYLE_TANGENTIAL_SECTORS
namespace condyle::tangential {
namespace {

/// Eighths of a turn by the signs of x (1) and y (2) and which of them is larger (4: y).
struct Sectors {
  static constexpr int none = 8;
  /// In radii, least distance of a vertex in a sector from its borders. Along diagonals the distance is the
  /// square root of 2 too large; 3/2 covers that and all rounding.
  static constexpr float apart = static_cast<float>(1.5 * FreeDirections::clearance);
  /// A bit each, counter-clockwise from +x; none for `none`.
  static constexpr std::array<std::uint8_t, 9> bit = {1 << 0, 1 << 3, 1 << 7, 1 << 4, 1 << 1,
                                                      1 << 2, 1 << 6, 1 << 5, 0};
};

}  // namespace
}  // namespace condyle::tangential
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangential/build/profile_boxes.cpp"
#include <hwy/foreach_target.h>
#include "simd/prelude-inl.hpp"

#include "simd/axis_rotation-inl.hpp"
#include "simd/lane_numbers-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::tangential::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace simd = simd::HWY_NAMESPACE;

/// As many vertices as there are lanes, from `first` on.
template <class D>
HWY_INLINE void transform_some(D d, const PointsView& vertices, const AxisFrame& frame, std::size_t first,
                               AxisVertices& out) {
  const auto [x, y, z] = simd::to_axis(d, frame, vertices, first);
  hn::StoreInterleaved4(x, y, z, hn::Zero(d), d, out.exact[first].at.data());

  const hn::Rebind<float, D> df;
  const auto rounded = [&](hn::Vec<D> value) {
    return hn::DemoteTo(df, hn::Mul(value, hn::Set(d, out.units_per_mm)));
  };
  const auto fx = rounded(x), fy = rounded(y), fz = rounded(z);
  const auto rho = rounded(hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y))));
  hn::StoreInterleaved4(fx, fy, rho, fz, df, &out.rounded[first].x);

  const auto apart = hn::Mul(rho, hn::Set(df, Sectors::apart));
  const auto ax = hn::Abs(fx), ay = hn::Abs(fy);
  const auto near = hn::Or(hn::Le(hn::Min(ax, ay), apart), hn::Le(hn::Abs(hn::Sub(ax, ay)), apart));
  const hn::RebindToSigned<decltype(df)> di;
  const auto sign = [&](hn::Vec<decltype(df)> value) { return hn::ShiftRight<31>(hn::BitCast(di, value)); };
  const auto bit = [&](hn::Vec<decltype(di)> mask, int value) { return hn::And(mask, hn::Set(di, value)); };
  const auto steep = hn::VecFromMask(di, hn::RebindMask(di, hn::Gt(ay, ax)));
  const auto number = hn::Or(hn::Or(bit(sign(fx), 1), bit(sign(fy), 2)), bit(steep, 4));
  const auto sector = hn::IfThenElse(hn::RebindMask(di, near), hn::Set(di, Sectors::none), number);
  alignas(64) std::array<std::int32_t, hn::MaxLanes(di)> numbers;
  hn::Store(sector, di, numbers.data());
  for (std::size_t i = 0; i < hn::MaxLanes(di); ++i)
    out.sector[first + i] = Sectors::bit[static_cast<std::size_t>(numbers[i])];
}

/// Largest absolute value.
double largest_magnitude_any(std::span<const double> values) {
  constexpr hn::CappedTag<double, 8> d8;
  auto most = hn::Zero(d8);
  std::size_t i = 0;
  for (; i + hn::Lanes(d8) <= values.size(); i += hn::Lanes(d8))
    most = hn::Max(hn::Abs(hn::LoadU(d8, values.data() + i)), most);
  double reach = hn::GetLane(hn::MaxOfLanes(d8, most));
  for (; i < values.size(); ++i) reach = std::max(reach, std::abs(values[i]));
  return reach;
}

void transform_any(const PointsView& vertices, const AxisFrame& frame, AxisVertices& out) {
  constexpr hn::CappedTag<double, 8> d8;
  std::size_t i = 0;
  for (; i + hn::Lanes(d8) <= vertices.size(); i += hn::Lanes(d8))
    transform_some(d8, vertices, frame, i, out);
  for (; i < vertices.size(); ++i) transform_some(hn::CappedTag<double, 1>(), vertices, frame, i, out);
}

using D = hn::CappedTag<float, 16>;
using Floats = hn::Vec<D>;
constexpr D d;
constexpr std::size_t most_lanes = hn::MaxLanes(d);

/// Least and greatest of the corners of as many triangles as a vector has lanes, value by value.
struct Extents {
  Floats x_low, y_low, rho_low, z_low, x_high, y_high, rho_high, z_high;
};

HWY_INLINE Extents extents_of(const ProfileVertex* vertices, const Triangle* triangles, std::size_t count) {
  constexpr hn::CappedTag<float, 4> d4;
  alignas(64) std::array<float, 4 * most_lanes> low, high;
  for (std::size_t i = 0; i < most_lanes; ++i) {
    // Lanes beyond the last triangle repeat it.
    const auto& [a, b, c] = triangles[std::min(i, count - 1)];
    for (std::size_t k = 0; k < 4; k += hn::Lanes(d4)) {
      const auto at = [&](Index v) { return hn::Load(d4, &vertices[v].x + k); };
      const auto va = at(a), vb = at(b), vc = at(c);
      hn::Store(hn::Min(hn::Min(va, vb), vc), d4, low.data() + 4 * i + k);
      hn::Store(hn::Max(hn::Max(va, vb), vc), d4, high.data() + 4 * i + k);
    }
  }
  Extents out;
  hn::LoadInterleaved4(d, low.data(), out.x_low, out.y_low, out.rho_low, out.z_low);
  hn::LoadInterleaved4(d, high.data(), out.x_high, out.y_high, out.rho_high, out.z_high);
  return out;
}

/// Extents that lie within one sector, apart from its borders: each corner then does, by the same floats.
HWY_INLINE hn::Mask<D> within_sector(const Extents& e) {
  const auto apart = hn::Mul(e.rho_high, hn::Set(d, Sectors::apart));
  // The least and the greatest |x| where x keeps its sign; the least is negative where it does not.
  const auto least_x = hn::Max(e.x_low, hn::Neg(e.x_high)), least_y = hn::Max(e.y_low, hn::Neg(e.y_high));
  const auto most_x = hn::Max(hn::Neg(e.x_low), e.x_high), most_y = hn::Max(hn::Neg(e.y_low), e.y_high);
  const auto off_diagonal = hn::Max(hn::Sub(least_x, most_y), hn::Sub(least_y, most_x));
  return hn::Gt(hn::Min(hn::Min(least_x, least_y), off_diagonal), apart);
}

/// Squares of radii fall short of the nearest corner's by L^2 / 3 at most, L being the longest edge seen
/// along the axis: the nearest point is a corner, or the foot on an edge whose nearer end is at most L / 2
/// away, or the axis itself, at most L / sqrt(3) from the nearest corner.
///
/// Coordinates carry u' = 2^-24 of themselves. 8u' of the largest radius, added to each side of the extents
/// in x and y, covers their roundings and that of the difference; 16u' those of the squares; 8u' those of the
/// root and of any radius computed in double. What underflows is far below `least`.
void boxes_any(std::span<const ProfileVertex> vertices, std::span<const Triangle> triangles,
               ProfileBoxes& out) {
  const auto least = hn::Set(d, 0x1p-120f);
  const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
  auto rho_min = infinity, rho_max = hn::Zero(d), z_min = infinity, z_max = hn::Neg(infinity),
       scale = hn::Zero(d);
  std::size_t across_count = 0;
  const auto store = [&](Floats values, core::UninitialisedVector<float>& to, std::size_t first) {
    hn::StoreU(values, d, to.data() + first);
  };
  for (std::size_t first = 0; first < triangles.size(); first += most_lanes) {
    const std::size_t count = std::min(most_lanes, triangles.size() - first);
    const Extents e = extents_of(vertices.data(), triangles.data() + first, count);
    const auto error = hn::Mul(e.rho_high, hn::Set(d, 0x1p-21f));
    const auto dx = hn::Add(hn::Sub(e.x_high, e.x_low), error),
               dy = hn::Add(hn::Sub(e.y_high, e.y_low), error);
    const auto sag = hn::Mul(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Set(d, (1 + 0x1p-20f) / 3));
    const auto nearest2 = hn::Mul(hn::Mul(e.rho_low, e.rho_low), hn::Set(d, 1 - 0x1p-20f));
    const auto low2 = hn::Sub(hn::Sub(nearest2, sag), least);
    const auto rho_low = hn::Max(hn::Sub(hn::Sqrt(hn::Max(low2, hn::Zero(d))), error), hn::Zero(d));
    const auto rho_high = hn::Add(hn::Add(e.rho_high, error), least);
    const auto z_error =
        hn::Add(hn::Mul(hn::Max(hn::Abs(e.z_low), hn::Abs(e.z_high)), hn::Set(d, 0x1p-22f)), least);
    const auto z_low = hn::Sub(e.z_low, z_error), z_high = hn::Add(e.z_high, z_error);
    store(rho_low, out.rho_low, first), store(rho_high, out.rho_high, first);
    store(z_low, out.z_low, first), store(z_high, out.z_high, first);
    rho_min = hn::Min(rho_min, rho_low), rho_max = hn::Max(rho_max, rho_high);
    z_min = hn::Min(z_min, z_low), z_max = hn::Max(z_max, z_high);
    const auto reach = [&](Floats low, Floats high) {
      return hn::Add(hn::Max(hn::Abs(low), hn::Abs(high)), error);
    };
    scale = hn::Max(scale, hn::Max(reach(e.x_low, e.x_high), reach(e.y_low, e.y_high)));
    const auto across = hn::AndNot(within_sector(e), hn::FirstN(d, count));
    across_count += simd::store_lane_numbers(d, across, first, out.across_sectors.data() + across_count);
  }
  out.across_sectors.resize(across_count);
  out.rho_min = hn::GetLane(hn::MinOfLanes(d, rho_min)),
  out.rho_max = hn::GetLane(hn::MaxOfLanes(d, rho_max));
  out.z_min = hn::GetLane(hn::MinOfLanes(d, z_min)), out.z_max = hn::GetLane(hn::MaxOfLanes(d, z_max));
  out.scale = hn::GetLane(hn::MaxOfLanes(d, scale));
}

}  // namespace
}  // namespace condyle::tangential::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::tangential {

HWY_EXPORT(largest_magnitude_any);
HWY_EXPORT(transform_any);
HWY_EXPORT(boxes_any);

AxisVertices vertices_in_axis_frame(PointsView vertices, const AxisFrame& frame) {
  AxisVertices out;
  const std::size_t count = vertices.size();
  out.exact.resize(count), out.rounded.resize(count), out.sector.resize(count);
  const auto reach_of = [](std::span<const double> values) {
    return HWY_DYNAMIC_DISPATCH(largest_magnitude_any)(values);
  };
  const double reach =
      reach_of(vertices.x) + reach_of(vertices.y) + reach_of(vertices.z) + frame.point().cwiseAbs().sum();
  out.units_per_mm = reach > 0 ? std::exp2(std::min(-std::ilogb(reach), 1000)) : 1;
  HWY_DYNAMIC_DISPATCH(transform_any)(vertices, frame, out);
  return out;
}

ProfileBoxes profile_boxes(std::span<const ProfileVertex> vertices, std::span<const Triangle> triangles) {
  ProfileBoxes out;
  for (auto* side : {&out.rho_low, &out.rho_high, &out.z_low, &out.z_high})
    side->resize((triangles.size() + 15) / 16 * 16);
  // A vector is written whole.
  out.across_sectors.resize(triangles.size() + 16);
  HWY_DYNAMIC_DISPATCH(boxes_any)(vertices, triangles, out);
  return out;
}

}  // namespace condyle::tangential
#endif
