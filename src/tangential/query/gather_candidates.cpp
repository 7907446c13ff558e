#include "tangential/query/gather_candidates.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangential/query/gather_candidates.cpp"
#include <hwy/foreach_target.h>

#include "simd/packed_ranges-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::tangential::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace simd = simd::HWY_NAMESPACE;

using D = hn::CappedTag<std::uint32_t, 16>;
constexpr D d;

std::size_t gather_any(const RingLists& lists, std::span<const CircleCell> circles, std::size_t first,
                       CandidatePairs& pairs) {
  const std::size_t capacity = pairs.triangle.size();
  const Index* const offsets = lists.offsets();
  const RingEntry* const entries = lists.entry_data();
  std::size_t count = 0, c = first;
  for (; c < circles.size(); ++c) {
    const Index begin = offsets[circles[c].cell], end = offsets[circles[c].cell + 1];
    if (count + (end - begin) + hn::MaxLanes(d) > capacity) break;
    const auto bytes = hn::Set(d, circles[c].bytes), number = hn::Set(d, static_cast<Index>(c));
    for (Index i = begin; i < end; i += static_cast<Index>(hn::MaxLanes(d))) {
      hn::Vec<D> triangles, boxes;
      hn::LoadInterleaved2(d, &entries[i].triangle, triangles, boxes);
      const auto held =
          hn::And(hn::Eq(simd::range_excess(d, boxes, bytes), hn::Zero(d)), hn::FirstN(d, end - i));
      hn::StoreU(number, d, pairs.circle.data() + count);
      simd::store_compacted(d, triangles, held, pairs.triangle.data() + count);
      count += hn::CountTrue(d, held);
    }
  }
  pairs.triangle.resize(count), pairs.circle.resize(count);
  return c;
}

}  // namespace
}  // namespace condyle::tangential::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::tangential {

HWY_EXPORT(gather_any);

std::size_t gather_candidates(const RingLists& lists, std::span<const CircleCell> circles, std::size_t first,
                              CandidatePairs& pairs) {
  // Enough for a few hundred circles, few enough for the processor's nearest cache; and for the longest list
  // with a vector written behind it.
  constexpr std::size_t usual = 4096, padding = 16;
  const std::size_t capacity = std::max(usual, lists.longest() + padding);
  pairs.triangle.resize(capacity), pairs.circle.resize(capacity);
  return HWY_DYNAMIC_DISPATCH(gather_any)(lists, circles, first, pairs);
}

}  // namespace condyle::tangential
#endif
