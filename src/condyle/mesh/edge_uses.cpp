#include "condyle/mesh/edge_uses.hpp"

#include <algorithm>

#include "condyle/core/uninitialised.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "condyle/mesh/edge_uses.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace condyle::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint32_t, 8>;
constexpr Words words;

/// One bit for each place where the given use waits.
HWY_INLINE unsigned places_of(const WaitingUses& waiting, std::uint32_t use) {
  unsigned places = 0;
  for (std::size_t k = 0; k < 8; k += hn::MaxLanes(words)) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(words, hn::Eq(hn::Load(words, waiting.use + k), hn::Set(words, use)), bits);
    places |= static_cast<unsigned>(bits[0]) << k;
  }
  return places;
}

/// Takes the opposite use out, or puts this one in; false where there is no room. Which it is cannot be
/// foretold, so nothing branches on it.
HWY_INLINE bool meet(WaitingUses& waiting, std::uint32_t asked) {
  const unsigned opposite = places_of(waiting, asked ^ 1u);
  const unsigned places = opposite | places_of(waiting, WaitingUses::none) << 8;
  if (places == 0) return false;
  const std::uint32_t is_met = opposite != 0 ? 1 : 0;
  waiting.use[hwy::Num0BitsBelowLS1Bit_Nonzero32(places) & 7] = asked | (0u - is_met);
  return true;
}

/// Edges that lie together share vertices, and a processor waits long before it reads as a whole what it has
/// just written in parts: so many stretches of the mesh take turns (one: 20 ns per triangle, these: 6 to 8).
constexpr std::size_t stretches = 24;

void cancel_edge_uses_any(std::span<const Triangle> triangles, std::size_t vertices,
                          std::vector<std::uint64_t>& left_over) {
  UninitialisedVector<WaitingUses> waiting(vertices);
  for (WaitingUses& uses : waiting) std::fill_n(uses.use, 8, WaitingUses::none);
  const auto keep = [&](Index low, std::uint32_t use) {
    left_over.push_back(std::uint64_t{low} << 32 | use);
  };
  const auto take_edge = [&](const Triangle& triangle, std::size_t k) {
    const Index a = triangle[k], b = triangle[k == 2 ? 0 : k + 1];
    if (a == b) return;
    const Index low = std::min(a, b), high = std::max(a, b);
    const std::uint32_t use = 2 * high + static_cast<Index>(a == high);
    if (!meet(waiting[low], use)) keep(low, use);
  };
  const std::size_t stretch = triangles.size() / stretches;
  for (std::size_t i = 0; i < stretch; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t turn = 0; turn < stretches; ++turn) take_edge(triangles[turn * stretch + i], k);
    }
  }
  for (const Triangle& triangle : triangles.subspan(stretches * stretch)) {
    for (std::size_t k = 0; k < 3; ++k) take_edge(triangle, k);
  }
  for (Index low = 0; low < vertices; ++low) {
    if (places_of(waiting[low], WaitingUses::none) == 0xff) continue;
    for (const std::uint32_t use : waiting[low].use)
      if (use != WaitingUses::none) keep(low, use);
  }
}

}  // namespace
}  // namespace condyle::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle {

HWY_EXPORT(cancel_edge_uses_any);

void cancel_edge_uses(std::span<const Triangle> triangles, std::size_t vertices,
                      std::vector<std::uint64_t>& left_over) {
  HWY_DYNAMIC_DISPATCH(cancel_edge_uses_any)(triangles, vertices, left_over);
}

}  // namespace condyle
#endif
