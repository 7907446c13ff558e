// Included once for every instruction set, by sources that are compiled so.
#if defined(CONDYLE_SIMD_PACKED_RANGES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_SIMD_PACKED_RANGES_INL
#undef CONDYLE_SIMD_PACKED_RANGES_INL
#else
#define CONDYLE_SIMD_PACKED_RANGES_INL
#endif

#include "simd/packed_range.hpp"
#include "simd/prelude-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::simd::HWY_NAMESPACE {

/// By how much ranges in lanes of 32 bits fail to hold points: zero where holds(). A lane that fails has other bits
/// on each instruction set.
template <class Tag>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<Tag> range_excess(Tag tag, hwy::HWY_NAMESPACE::Vec<Tag> ranges,
                                                     hwy::HWY_NAMESPACE::Vec<Tag> points) {
  namespace hn = hwy::HWY_NAMESPACE;
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(tag, holds(hn::GetLane(ranges), hn::GetLane(points)) ? 0u : 1u);
#elif HWY_TARGET == HWY_EMU128
  // The emulation takes vectors of bytes apart. As words, the topmost bit of each byte of `least` shows whether the
  // other seven of the point are no less than the range's: nothing is borrowed from the next byte.
  const auto top = hn::Set(tag, 0x80808080u);
  const auto least = hn::Sub(hn::Or(points, top), hn::AndNot(top, ranges));
  const auto holding = hn::Or(hn::AndNot(ranges, points), hn::AndNot(hn::Xor(points, ranges), least));
  return hn::AndNot(holding, top);
#else
  constexpr hn::Repartition<std::uint8_t, Tag> bytes;
  return hn::BitCast(tag, hn::SaturatedSub(hn::BitCast(bytes, ranges), hn::BitCast(bytes, points)));
#endif
}

}  // namespace condyle::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
