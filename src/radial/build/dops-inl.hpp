// Included once for every instruction set, by sources that are compiled so.
#if defined(CONDYLE_RADIAL_DOPS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_RADIAL_DOPS_INL
#undef CONDYLE_RADIAL_DOPS_INL
#else
#define CONDYLE_RADIAL_DOPS_INL
#endif

#include "simd/prelude-inl.hpp"

#include "radial/exact/cell_dop.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Parts of a face that triangles take, one in each lane or one in all.
template <class DI>
struct PartsInLanes {
  hn::Vec<DI> least[4], greatest[4];
};

/// Octagons of triangles in cells, lane by lane, and whether the triangle does not keep off the cell. A
/// point's parts are rounded down one by one: their sum may be 1 less than that of what it is rounded from,
/// their difference 1 more. One part more on either side is for points on the face's last edge.
template <class DI>
struct DopsInCells {
  using Ints = hn::Vec<DI>;
  hn::Mask<DI> meet;
  Ints axis, diagonal;

  HWY_INLINE DopsInCells(const PartsInLanes<DI>& parts, int n, Ints column, Ints row) {
    constexpr DI di;
    const auto set = [](int value) { return hn::Set(DI(), value); };
    const auto within = [&](Ints value, int most) {
      return hn::Min(hn::Max(value, hn::Zero(di)), set(most));
    };
    const auto word = [&](Ints least_a, Ints greatest_a, Ints least_b, Ints greatest_b) {
      const auto a = hn::Or(least_a, hn::ShiftLeft<8>(hn::Sub(set(255), greatest_a)));
      const auto b = hn::Or(least_b, hn::ShiftLeft<8>(hn::Sub(set(255), greatest_b)));
      return hn::Or(a, hn::ShiftLeft<16>(b));
    };
    const auto u = hn::ShiftLeft<8>(column), w = hn::ShiftLeft<8>(row);
    const auto sum = hn::Add(u, w), difference = hn::Add(hn::Sub(u, w), set(parts_per_cell * n - 255));
    const auto least_sum = hn::Sub(parts.least[2], hn::Add(sum, set(2)));
    const auto greatest_sum = hn::Sub(parts.greatest[2], hn::Sub(sum, set(1)));
    const auto least_difference = hn::Sub(parts.least[3], hn::Add(difference, set(1)));
    const auto greatest_difference = hn::Sub(parts.greatest[3], hn::Sub(difference, set(2)));
    const auto most = set(510);
    const auto before = hn::Or(hn::Lt(greatest_sum, hn::Zero(di)), hn::Lt(greatest_difference, hn::Zero(di)));
    meet = hn::Not(hn::Or(before, hn::Or(hn::Gt(least_sum, most), hn::Gt(least_difference, most))));
    axis = word(within(hn::Sub(parts.least[0], u), 255), within(hn::Sub(parts.greatest[0], u), 255),
                within(hn::Sub(parts.least[1], w), 255), within(hn::Sub(parts.greatest[1], w), 255));
    const auto half = [&](Ints value) { return hn::ShiftRight<1>(within(value, 510)); };
    diagonal = word(half(least_sum), half(greatest_sum), half(least_difference), half(greatest_difference));
  }
};

/// As many triangles, or cells of one, as are processed together.
using Lanes = hn::CappedTag<std::int32_t, 16>;
using Words = hn::RebindToUnsigned<Lanes>;
using LaneFloats = hn::RebindToFloat<Lanes>;
constexpr std::size_t lanes = hn::MaxLanes(Lanes());

}  // namespace
}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
