// Included once for every instruction set, by sources that are compiled so.
#if defined(CONDYLE_TANGENTIAL_ARCTANGENT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_TANGENTIAL_ARCTANGENT_INL
#undef CONDYLE_TANGENTIAL_ARCTANGENT_INL
#else
#define CONDYLE_TANGENTIAL_ARCTANGENT_INL
#endif

#include "simd/prelude-inl.hpp"

#include <numbers>

#include "tangential/exact/arctangent.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::tangential::HWY_NAMESPACE {

/// As condyle::tangential::arctangent, the same bits; NaN for (0, 0).
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> arctangent(D d, hwy::HWY_NAMESPACE::Vec<D> y,
                                                 hwy::HWY_NAMESPACE::Vec<D> x) {
  namespace hn = hwy::HWY_NAMESPACE;
  constexpr double pi = std::numbers::pi;
  const auto ax = hn::Abs(x), ay = hn::Abs(y), low = hn::Min(ax, ay), high = hn::Max(ax, ay);
  const auto beyond_eighth = hn::Gt(low, hn::Mul(high, hn::Set(d, eighth_tangent)));
  const auto q = hn::Div(hn::IfThenElse(beyond_eighth, hn::Sub(low, high), low),
                         hn::IfThenElse(beyond_eighth, hn::Add(low, high), high));
  const auto s = hn::Mul(q, q);
  const auto s2 = hn::Mul(s, s), s4 = hn::Mul(s2, s2);
  const auto c = [&](std::size_t k) { return hn::Set(d, arctangent_coefficients[k]); };
  const auto two = [&](std::size_t k) { return hn::Add(c(k), hn::Mul(s, c(k + 1))); };
  const auto four = [&](std::size_t k) { return hn::Add(two(k), hn::Mul(s2, two(k + 2))); };
  const auto high_part = hn::Add(two(8), hn::Mul(s2, c(10)));
  const auto p = hn::Add(four(0), hn::Mul(s4, hn::Add(four(4), hn::Mul(s4, high_part))));
  const auto a = hn::Add(q, hn::Mul(q, hn::Mul(s, p)));
  const auto to_quarter = hn::Add(hn::IfThenElseZero(beyond_eighth, hn::Set(d, pi / 4)), a);
  const auto to_half = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(hn::Set(d, pi / 2), to_quarter), to_quarter);
  const auto angle = hn::IfThenElse(hn::Lt(x, hn::Zero(d)), hn::Sub(hn::Set(d, pi), to_half), to_half);
  return hn::IfThenElse(hn::Lt(y, hn::Zero(d)), hn::Neg(angle), angle);
}

}  // namespace condyle::tangential::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
