// Included once for every instruction set, by sources that are compiled so.
#if defined(CONDYLE_RADIAL_COMPACTION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_RADIAL_COMPACTION_INL
#undef CONDYLE_RADIAL_COMPACTION_INL
#else
#define CONDYLE_RADIAL_COMPACTION_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace condyle::HWY_NAMESPACE {

/// Stores those lanes of which the mask is set, one behind the other; may write a whole vector.
///
/// Sixteen lanes have an instruction for that. For fewer, Highway 1.0.3 permutes by a table, which GCC 12
/// copies to the stack each time: with few lanes set, as here, going through them takes half the time.
template <class Tag, class Vector, class T>
HWY_INLINE void store_compacted(Tag tag, Vector values, hwy::HWY_NAMESPACE::Mask<Tag> mask, T* to) {
  namespace hn = hwy::HWY_NAMESPACE;
  if constexpr (hn::MaxLanes(tag) != 8) {
    hn::StoreU(hn::Compress(values, mask), tag, to);
  } else {
    alignas(64) T all[hn::MaxLanes(tag)];
    hn::Store(values, tag, all);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, mask, bits);
    for (unsigned left = bits[0]; left != 0; left &= left - 1) {
      *to++ = all[hwy::Num0BitsBelowLS1Bit_Nonzero32(left)];
    }
  }
}

}  // namespace condyle::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
