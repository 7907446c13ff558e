// Included once for every instruction set, by sources that are compiled so.
#if defined(CONDYLE_RADIAL_RADIUS_WORDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_RADIAL_RADIUS_WORDS_INL
#undef CONDYLE_RADIAL_RADIUS_WORDS_INL
#else
#define CONDYLE_RADIAL_RADIUS_WORDS_INL
#endif

#include <hwy/highway.h>

#include "radial/build/radius_scale.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {

/// union_of() of RadiusWords, in lanes of 32 bits: the halves are numbers of their own.
template <class Tag>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<Tag> union_of_words(Tag tag, hwy::HWY_NAMESPACE::Vec<Tag> a,
                                                       hwy::HWY_NAMESPACE::Vec<Tag> b) {
  namespace hn = hwy::HWY_NAMESPACE;
#if HWY_TARGET == HWY_SCALAR
  using Lane = hn::TFromD<Tag>;
  const RadiusWord both =
      union_of(static_cast<RadiusWord>(hn::GetLane(a)), static_cast<RadiusWord>(hn::GetLane(b)));
  return hn::Set(tag, static_cast<Lane>(both));
#else
  constexpr hn::Repartition<std::uint16_t, Tag> halves;
  return hn::BitCast(tag, hn::Min(hn::BitCast(halves, a), hn::BitCast(halves, b)));
#endif
}

}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
