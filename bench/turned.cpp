#include "turned.hpp"

#include "radial/query/point_blocks.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "turned.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bench::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

float greatest_turned_any(const condyle::radial::SortedPoints& sorted, const condyle::Pose& X) {
  const condyle::radial::PointBlocks& points = sorted.blocks();
  constexpr hn::CappedTag<float, 16> d;
  const float *x = points.coordinate(0), *y = points.coordinate(1), *z = points.coordinate(2);
  const Eigen::Matrix<float, 3, 4> m = X.matrix().topRows<3>().cast<float>();
  auto greatest = hn::Set(d, m(0, 3));
  // Filled up to whole blocks of sixteen.
  for (std::size_t i = 0; i < points.size(); i += hn::Lanes(d)) {
    const auto px = hn::LoadU(d, x + i), py = hn::LoadU(d, y + i), pz = hn::LoadU(d, z + i);
    const auto row = [&](int r) {
      return hn::MulAdd(
          hn::Set(d, m(r, 0)), px,
          hn::MulAdd(hn::Set(d, m(r, 1)), py, hn::MulAdd(hn::Set(d, m(r, 2)), pz, hn::Set(d, m(r, 3)))));
    };
    greatest = hn::Max(greatest, hn::Max(row(0), hn::Max(row(1), row(2))));
  }
  return hn::GetLane(hn::MaxOfLanes(d, greatest));
}

}  // namespace
}  // namespace bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bench {

HWY_EXPORT(greatest_turned_any);

float greatest_turned(const condyle::radial::SortedPoints& points, const condyle::Pose& X) {
  return HWY_DYNAMIC_DISPATCH(greatest_turned_any)(points, X);
}

}  // namespace bench
#endif
