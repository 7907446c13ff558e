#include "condyle/mesh/edge_uses.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#ifndef CONDYLE_MESH_EDGE_SLOTS
#define CONDYLE_MESH_EDGE_SLOTS
namespace condyle {
namespace {

/// A slot without a use, and what stands for an edge from a vertex to itself.
constexpr EdgeUse no_use = 0;

/// Slots in which uses wait for opposite ones. A use goes to one slot, which the edge tells: there it cancels
/// its opposite, or drives out what waits, to be gone through again. What is driven out without need costs
/// time, never the answer.
class EdgeSlots {
 public:
  explicit EdgeSlots(std::size_t count) : slot_(count, no_use) {}

  /// Writes what is driven out to `left`, or something else that does not count; returns how many that is.
  /// Without a branch: what happens nobody could foretell.
  std::size_t take(EdgeUse use, std::size_t number, EdgeUse* left) noexcept {
    const EdgeUse waited = slot_[number];
    const bool is_met = (waited ^ use) == 1;
    slot_[number] = is_met ? no_use : use;
    *left = waited;
    return static_cast<std::size_t>((waited != no_use) & !is_met);
  }

  /// Writes those that still wait to `left`, and one more that does not count; returns how many they are.
  std::size_t empty_into(EdgeUse* left) const noexcept {
    std::size_t count = 0;
    for (const EdgeUse use : slot_) {
      left[count] = use;
      count += use != no_use;
    }
    return count;
  }

 private:
  UninitialisedVector<EdgeUse> slot_;
};

/// 64 kB: all that most meshes ask for at a time, as their triangles keep together, in the processor's nearer
/// caches. With a quarter, or four times as many, the four sizes of a hip bone take up to 1.2 times as long.
constexpr unsigned first_slots_log2 = 13;

}  // namespace
}  // namespace condyle
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "condyle/mesh/edge_uses.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace condyle::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<std::uint32_t, 16>;
using Words = hn::Vec<D>;
constexpr D d;

/// Uses of the edges of some triangles, each as its lower and its upper half, and their slots.
struct UseBatch {
  static constexpr std::size_t triangles = 128, most = 3 * triangles;
  alignas(64) std::array<std::uint32_t, 2 * most> half;
  alignas(64) std::array<std::uint32_t, most> slot;

  EdgeUse use(std::size_t i) const noexcept {
    EdgeUse out;
    std::memcpy(&out, &half[2 * i], sizeof out);
    return out;
  }
};

HWY_INLINE void fill(const Triangle* triangles, UseBatch& out) {
  std::size_t count = 0;
  // The slot by the upper bits of a sum of products with odd numbers (2^32 over the golden ratio, and one of
  // xxHash's primes).
  const auto by_low = hn::Set(d, 0x9e3779b1u), by_high = hn::Set(d, 0x85ebca77u);
  const auto put = [&](Words from, Words to) {
    const auto low = hn::Min(from, to), high = hn::Max(from, to);
    const auto is_edge = hn::Ne(from, to);
    const auto from_high = hn::IfThenElseZero(hn::Gt(from, to), hn::Set(d, 1));
    const auto lower_half = hn::IfThenElseZero(is_edge, hn::Add(hn::Add(high, high), from_high));
    hn::StoreInterleaved2(lower_half, hn::IfThenElseZero(is_edge, low), d, out.half.data() + 2 * count);
    const auto mixed = hn::Add(hn::Mul(low, by_low), hn::Mul(high, by_high));
    hn::Store(hn::ShiftRight<32 - first_slots_log2>(mixed), d, out.slot.data() + count);
    count += hn::Lanes(d);
  };
  for (std::size_t i = 0; i < UseBatch::triangles; i += hn::Lanes(d)) {
    Words a, b, c;
    hn::LoadInterleaved3(d, triangles[i].data(), a, b, c);
    put(a, b), put(b, c), put(c, a);
  }
}

UninitialisedVector<EdgeUse> first_pass_any(std::span<const Triangle> triangles) {
  EdgeSlots slots(std::size_t{1} << first_slots_log2);
  UseBatch batch;
  UninitialisedVector<EdgeUse> left;
  std::size_t count = 0;
  const auto make_room = [&](std::size_t more) {
    if (left.size() < count + more) left.resize(2 * count + more);
  };
  make_room(triangles.size());
  const auto take_batch = [&](const Triangle* some) {
    fill(some, batch);
    make_room(UseBatch::most);
    for (std::size_t i = 0; i < UseBatch::most; ++i)
      count += slots.take(batch.use(i), batch.slot[i], left.data() + count);
  };
  std::size_t first = 0;
  for (; first + UseBatch::triangles <= triangles.size(); first += UseBatch::triangles)
    take_batch(triangles.data() + first);
  // What is beyond the last triangle has no edges.
  std::array<Triangle, UseBatch::triangles> last{};
  std::copy(triangles.begin() + static_cast<std::ptrdiff_t>(first), triangles.end(), last.begin());
  take_batch(last.data());
  make_room((std::size_t{1} << first_slots_log2) + 1);
  count += slots.empty_into(left.data() + count);
  left.resize(count);
  return left;
}

}  // namespace
}  // namespace condyle::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle {
namespace {

/// Goes through uses once more, with about as many slots as there are uses, told by the upper bits of a
/// product with `odd`.
void cancel_again(UninitialisedVector<EdgeUse>& uses, std::uint64_t odd) {
  const auto slots_log2 = static_cast<unsigned>(std::bit_width(uses.size()));
  EdgeSlots slots(std::size_t{1} << slots_log2);
  // None goes to where one after it is; room for one that does not count.
  const std::size_t size = uses.size();
  uses.resize(size + 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const EdgeUse use = uses[i];
    count += slots.take(use, (use >> 1) * odd >> (64 - slots_log2), uses.data() + count);
  }
  count += slots.empty_into(uses.data() + count);
  uses.resize(count);
}

}  // namespace

HWY_EXPORT(first_pass_any);

UninitialisedVector<EdgeUse> uncancelled_edge_uses(std::span<const Triangle> triangles) {
  UninitialisedVector<EdgeUse> left = HWY_DYNAMIC_DISPATCH(first_pass_any)(triangles);
  // So few are sorted in less time. Other slots each time: those that drove each other out seldom meet again.
  constexpr std::size_t few = 64;
  std::uint64_t odd = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
  for (std::size_t before = 2 * left.size(); left.size() > few && left.size() <= before / 4 * 3;) {
    before = left.size();
    cancel_again(left, odd);
    odd *= 0xd6e8feb86659fd93;  // any odd number with bits of both kinds everywhere
  }
  return left;
}

}  // namespace condyle
#endif
