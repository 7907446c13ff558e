// Included once for every instruction set, by sources that are compiled so, behind <hwy/foreach_target.h>:
// all of Highway that they need.
#if defined(CONDYLE_SIMD_PRELUDE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_SIMD_PRELUDE_INL
#undef CONDYLE_SIMD_PRELUDE_INL
#else
#define CONDYLE_SIMD_PRELUDE_INL
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "simd/compress_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::simd::HWY_NAMESPACE {

/// Lanes numbered first, first + 1 and so on. Iota of anything but a constant GCC 12 writes to memory lane by
/// lane, and reads it again.
template <class Tag>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<Tag> numbers_from(Tag tag, std::size_t first) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::Add(hn::Iota(tag, 0), hn::Set(tag, static_cast<hn::TFromD<Tag>>(first)));
}

/// The lanes whose mask is set, packed, followed by arbitrary values.
///
/// Eight lanes are permuted by a table of our own: of Highway 1.0.3's GCC 12 makes a copy on the stack each
/// time.
template <class Tag, class Vector>
HWY_INLINE Vector compacted(Tag tag, Vector values, hwy::HWY_NAMESPACE::Mask<Tag> mask) {
  namespace hn = hwy::HWY_NAMESPACE;
  if constexpr (hn::MaxLanes(tag) != 8) {
    return hn::Compress(values, mask);
  } else {
    constexpr hn::RebindToUnsigned<Tag> words;
    constexpr hn::Rebind<std::uint8_t, Tag> bytes;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, mask, bits);
    const auto lanes = hn::PromoteTo(words, hn::LoadU(bytes, compaction_lanes[bits[0]].data()));
    return hn::TableLookupLanes(values, hn::IndicesFromVec(tag, lanes));
  }
}

/// Stores what is compacted; may write a whole vector.
template <class Tag, class Vector, class T>
HWY_INLINE void store_compacted(Tag tag, Vector values, hwy::HWY_NAMESPACE::Mask<Tag> mask, T* to) {
  hwy::HWY_NAMESPACE::StoreU(compacted(tag, values, mask), tag, to);
}

}  // namespace condyle::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
