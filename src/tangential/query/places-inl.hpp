// Included once for every instruction set, by sources that are compiled so.
#if defined(CONDYLE_TANGENTIAL_PLACES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_TANGENTIAL_PLACES_INL
#undef CONDYLE_TANGENTIAL_PLACES_INL
#else
#define CONDYLE_TANGENTIAL_PLACES_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace condyle::tangential::HWY_NAMESPACE {

/// Writes the numbers of those lanes of which the mask is set, the first lane being number `first`, to `to`,
/// and returns how many they are; may write a whole vector. Without a branch: which they are nobody could
/// foretell.
template <class D>
HWY_INLINE std::size_t store_places(D d, hwy::HWY_NAMESPACE::Mask<D> mask, std::size_t first,
                                    std::uint32_t* to) {
  namespace hn = hwy::HWY_NAMESPACE;
  if constexpr (hn::MaxLanes(D()) == 16) {
    // From 0, which is a constant: of other numbers GCC 12 builds the vector lane by lane.
    const auto all = hn::Add(hn::Iota(d, 0), hn::Set(d, static_cast<std::uint32_t>(first)));
    hn::StoreU(hn::Compress(all, mask), d, to);
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

}  // namespace condyle::tangential::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
