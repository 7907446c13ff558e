#include <limits>

#include "radial/query/penetration_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "radial/query/gap_pass.cpp"
#include <hwy/foreach_target.h>
#include "radial/exact/double_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr DD d;

void gaps_to_planes_any(const Pose& X_FM, GapColumns& columns) {
  const auto& m = X_FM.matrix();
  const auto one = hn::Set(d, 1.0), half = hn::Set(d, 0.5);
  const auto nan = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < columns.count; i += hn::Lanes(d)) {
    const auto at = [&](const double(&of)[3][GapColumns::size]) {
      return Vectors{hn::Load(d, of[0] + i), hn::Load(d, of[1] + i), hn::Load(d, of[2] + i)};
    };
    const Vectors p = at(columns.point);
    const auto row = [&](int r) {
      const Vectors of{hn::Set(d, m(r, 0)), hn::Set(d, m(r, 1)), hn::Set(d, m(r, 2))};
      return hn::Add(dot(of, p), hn::Set(d, m(r, 3)));
    };
    const Vectors v{row(0), row(1), row(2)};
    const auto fraction = hn::Abs(dot(v, at(columns.normal)));
    const auto way = hn::Mul(hn::Div(hn::Sub(one, fraction), fraction), hn::Sqrt(dot(v, v)));
    hn::Store(hn::IfThenElse(hn::Ge(fraction, half), way, nan), d, columns.gap + i);
  }
}

}  // namespace
}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::radial {

HWY_EXPORT(gaps_to_planes_any);

void gaps_to_planes(const Pose& X_FM, GapColumns& columns) {
  HWY_DYNAMIC_DISPATCH(gaps_to_planes_any)(X_FM, columns);
}

}  // namespace condyle::radial
#endif
