// Included once for every instruction set, by sources that are compiled so.
#if defined(CONDYLE_SIMD_AXIS_ROTATION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_SIMD_AXIS_ROTATION_INL
#undef CONDYLE_SIMD_AXIS_ROTATION_INL
#else
#define CONDYLE_SIMD_AXIS_ROTATION_INL
#endif

#include "simd/prelude-inl.hpp"

#include <cstddef>
#include <span>

#include "condyle/pose.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::simd::HWY_NAMESPACE {

/// Points in the lanes of three vectors.
template <class D>
struct PointLanes {
  hwy::HWY_NAMESPACE::Vec<D> x, y, z;
};

/// As many points as there are lanes, from `first` on, in the axis frame: AxisFrame::to_axis, the same bits.
template <class D>
HWY_INLINE PointLanes<D> to_axis(D d, const AxisFrame& frame, const PointsView& points, std::size_t first) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto from_axis_point = [&](std::span<const double> values, double origin) {
    return hn::Sub(hn::LoadU(d, values.data() + first), hn::Set(d, origin));
  };
  const auto px = from_axis_point(points.x, frame.point().x());
  const auto py = from_axis_point(points.y, frame.point().y());
  const auto pz = from_axis_point(points.z, frame.point().z());
  const auto row = [&](int i) {
    const auto times = [&](hn::Vec<D> p, int k) { return hn::Mul(hn::Set(d, frame.rotation()(i, k)), p); };
    return hn::Add(hn::Add(times(px, 0), times(py, 1)), times(pz, 2));
  };
  return {row(0), row(1), row(2)};
}

}  // namespace condyle::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
