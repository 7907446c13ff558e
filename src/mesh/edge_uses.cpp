#include "mesh/edge_uses.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#ifndef CONDYLE_MESH_EDGE_SLOTS
#define CONDYLE_MESH_EDGE_SLOTS
namespace condyle::mesh {
namespace {

/// A slot without a use, and what stands for an edge from a vertex to itself.
constexpr EdgeUse no_use = 0;

/// Slots in which uses wait for opposite ones. The edge determines a use's slot: there it cancels its opposite, or
/// drives out the waiting use, to be gone through again. A use driven out without need costs time, never the answer.
class EdgeSlots {
 public:
  explicit EdgeSlots(std::size_t count) : slot_(count, no_use) {}

  /// Takes a use; returns what it drives out, or `no_use`. Without a branch, and so that the compiler finds
  /// none: which comes next nobody could predict.
  EdgeUse take(EdgeUse use, std::size_t number) noexcept {
    const EdgeUse waited = slot_[number];
    const EdgeUse unless_met = EdgeUse{(waited ^ use) == 1} - 1;
    slot_[number] = use & unless_met;
    return waited & unless_met;
  }

  std::span<const EdgeUse> all() const noexcept { return slot_; }

 private:
  core::UninitialisedVector<EdgeUse> slot_;
};

/// 64 kB: all that most meshes ask for at a time, as their triangles keep together, in the processor's nearer
/// caches; less for small ones, where emptying it would take as long as filling it.
unsigned first_slots_log2(std::size_t triangles) noexcept {
  return std::clamp(static_cast<unsigned>(std::bit_width(triangles)), 5u, 13u);
}

}  // namespace
}  // namespace condyle::mesh
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/edge_uses.cpp"
#include <hwy/foreach_target.h>
#include "simd/prelude-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::mesh::HWY_NAMESPACE {
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

HWY_INLINE void fill(const Triangle* triangles, unsigned slots_log2, UseBatch& out) {
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
    hn::Store(hn::ShiftRightSame(mixed, static_cast<int>(32 - slots_log2)), d, out.slot.data() + count);
    count += hn::Lanes(d);
  };
  for (std::size_t i = 0; i < UseBatch::triangles; i += hn::Lanes(d)) {
    Words a, b, c;
    hn::LoadInterleaved3(d, triangles[i].data(), a, b, c);
    put(a, b), put(b, c), put(c, a);
  }
}

/// Writes those that are uses to `to`, one behind the other, and up to a vector more that does not count;
/// returns their count. No element moves to the place of a later one.
std::size_t write_uses(std::span<const EdgeUse> uses, EdgeUse* to) {
  std::size_t count = 0, i = 0;
  if constexpr (hn::MaxLanes(d) == 16) {
    // By halves: of vectors of whole ones GCC 12 copies a table to the stack each time.
    for (; i + 8 <= uses.size(); i += 8) {
      const auto halves = hn::LoadU(d, reinterpret_cast<const std::uint32_t*>(uses.data() + i));
      const auto is_use = hn::Ne(hn::Or(halves, hn::Reverse2(d, halves)), hn::Zero(d));
      simd::HWY_NAMESPACE::store_compacted(d, halves, is_use, reinterpret_cast<std::uint32_t*>(to + count));
      count += hn::CountTrue(d, is_use) / 2;
    }
  }
  for (; i < uses.size(); ++i) {
    to[count] = uses[i];
    count += uses[i] != no_use;
  }
  return count;
}

core::UninitialisedVector<EdgeUse> first_pass(std::span<const Triangle> triangles) {
  const unsigned slots_log2 = first_slots_log2(triangles.size());
  EdgeSlots slots(std::size_t{1} << slots_log2);
  UseBatch batch;
  std::array<EdgeUse, UseBatch::most> driven_out;
  core::UninitialisedVector<EdgeUse> left;
  std::size_t count = 0;
  const auto keep = [&](std::span<const EdgeUse> uses) {
    if (left.size() < count + uses.size()) left.resize(2 * count + uses.size());
    count += write_uses(uses, left.data() + count);
  };
  const auto take_batch = [&](const Triangle* some) {
    fill(some, slots_log2, batch);
    // In two steps: where the next one is written would else be known too late for what is read meanwhile.
    // Eight times in a row: for each place in the code a processor predicts whether it reads what was just
    // written.
    for (std::size_t i = 0; i < UseBatch::most; i += 8) {
      for (std::size_t k = i; k < i + 8; ++k) driven_out[k] = slots.take(batch.use(k), batch.slot[k]);
    }
    keep(driven_out);
  };
  std::size_t first = 0;
  for (; first + UseBatch::triangles <= triangles.size(); first += UseBatch::triangles)
    take_batch(triangles.data() + first);
  // Lanes beyond the last triangle have no edges.
  std::array<Triangle, UseBatch::triangles> last{};
  std::copy(triangles.begin() + static_cast<std::ptrdiff_t>(first), triangles.end(), last.begin());
  take_batch(last.data());
  keep(slots.all());
  left.resize(count);
  return left;
}

/// Goes through uses once more, with about as many slots as there are uses, selected by the upper bits of a product
/// with `odd`.
void cancel_again(core::UninitialisedVector<EdgeUse>& uses, std::uint64_t odd) {
  const auto slots_log2 = static_cast<unsigned>(std::bit_width(uses.size()));
  EdgeSlots slots(std::size_t{1} << slots_log2);
  for (EdgeUse& use : uses) use = slots.take(use, (use >> 1) * odd >> (64 - slots_log2));
  std::size_t count = write_uses(uses, uses.data());
  uses.resize(count + slots.all().size());
  count += write_uses(slots.all(), uses.data() + count);
  uses.resize(count);
}

core::UninitialisedVector<EdgeUse> uncancelled_any(std::span<const Triangle> triangles) {
  core::UninitialisedVector<EdgeUse> left = first_pass(triangles);
  // So few are sorted in no time. Other slots each time: those that drove each other out seldom meet again.
  constexpr std::size_t few = 8;
  std::uint64_t odd = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
  for (std::size_t before = 2 * left.size(); left.size() > few && left.size() <= before / 4 * 3;) {
    before = left.size();
    cancel_again(left, odd);
    odd *= 0xd6e8feb86659fd93;  // any odd number with bits of both kinds everywhere
  }
  return left;
}

}  // namespace
}  // namespace condyle::mesh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::mesh {

HWY_EXPORT(uncancelled_any);

core::UninitialisedVector<EdgeUse> uncancelled_edge_uses(std::span<const Triangle> triangles) {
  return HWY_DYNAMIC_DISPATCH(uncancelled_any)(triangles);
}

}  // namespace condyle::mesh
#endif
