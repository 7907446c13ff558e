// Included once for every instruction set, by sources that are compiled so.
#if defined(CONDYLE_SIMD_LANE_NUMBERS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_SIMD_LANE_NUMBERS_INL
#undef CONDYLE_SIMD_LANE_NUMBERS_INL
#else
#define CONDYLE_SIMD_LANE_NUMBERS_INL
#endif

#include <cstddef>
#include <cstdint>

#include "simd/prelude-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::simd::HWY_NAMESPACE {

/// Writes the numbers of those lanes of which the mask is set, the first lane being number `first`, to `to`,
/// and returns how many they are; may write a whole vector. Without a branch: which lanes these are cannot be
/// predicted.
template <class D>
HWY_INLINE std::size_t store_lane_numbers(D d, hwy::HWY_NAMESPACE::Mask<D> mask, std::size_t first,
                                          std::uint32_t* to) {
  namespace hn = hwy::HWY_NAMESPACE;
  if constexpr (hn::MaxLanes(D()) == 16) {
    const hn::RebindToUnsigned<D> du;
    store_compacted(du, numbers_from(du, first), hn::RebindMask(du, mask), to);
    return hn::CountTrue(d, mask);
  } else {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    std::size_t count = 0;
    for (std::size_t k = 0; k < hn::MaxLanes(D()); ++k) {
      to[count] = static_cast<std::uint32_t>(first + k);
      count += bits[0] >> k & 1;
    }
    return count;
  }
}

}  // namespace condyle::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
