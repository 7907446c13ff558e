// Included once for every instruction set, by sources that are compiled so.
#if defined(CONDYLE_SIMD_PACKED_INTERVALS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_SIMD_PACKED_INTERVALS_INL
#undef CONDYLE_SIMD_PACKED_INTERVALS_INL
#else
#define CONDYLE_SIMD_PACKED_INTERVALS_INL
#endif

#include "simd/packed_interval.hpp"
#include "simd/prelude-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::simd::HWY_NAMESPACE {

/// hull() of packed intervals, in lanes of 32 bits: the halves are numbers of their own.
template <class Tag>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<Tag> hull_of_lanes(Tag tag, hwy::HWY_NAMESPACE::Vec<Tag> a,
                                                      hwy::HWY_NAMESPACE::Vec<Tag> b) {
  namespace hn = hwy::HWY_NAMESPACE;
#if HWY_TARGET == HWY_SCALAR
  using Lane = hn::TFromD<Tag>;
  const PackedInterval both =
      hull(static_cast<PackedInterval>(hn::GetLane(a)), static_cast<PackedInterval>(hn::GetLane(b)));
  return hn::Set(tag, static_cast<Lane>(both));
#else
  constexpr hn::Repartition<std::uint16_t, Tag> halves;
  return hn::BitCast(tag, hn::Min(hn::BitCast(halves, a), hn::BitCast(halves, b)));
#endif
}

/// IntervalScale::code() of squared radii.
template <class FloatTag>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::RebindToSigned<FloatTag>> interval_codes(
    FloatTag, const IntervalScale& scale, hwy::HWY_NAMESPACE::Vec<FloatTag> squared) {
  namespace hn = hwy::HWY_NAMESPACE;
  constexpr hn::RebindToSigned<FloatTag> di;
  const auto steps =
      hn::ShiftRightSame(hn::Sub(hn::BitCast(di, squared), hn::Set(di, scale.base)), scale.shift);
  return hn::Min(hn::Max(steps, hn::Zero(di)), hn::Set(di, greatest_radius_code));
}

/// packed_interval() of codes.
template <class IntTag>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<IntTag> packed_intervals(IntTag di,
                                                            hwy::HWY_NAMESPACE::Vec<IntTag> least_code,
                                                            hwy::HWY_NAMESPACE::Vec<IntTag> greatest_code) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::Or(least_code, hn::ShiftLeft<16>(hn::Sub(hn::Set(di, greatest_radius_code), greatest_code)));
}

}  // namespace condyle::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
