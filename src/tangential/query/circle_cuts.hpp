#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "tangential/build/profile_boxes.hpp"
#include "tangential/exact/circle_crossing.hpp"
#include "tangential/query/circle_places.hpp"

namespace condyle::tangential {

/// What vectors of doubles say about a circle and a triangle that may cross.
enum class CutVerdict : signed char {
  leaves = static_cast<signed char>(Passage::leaves),  ///< One crossing, where the circle leaves the solid.
  enters = static_cast<signed char>(Passage::enters),  ///< One crossing, where it enters.
  undecided = 0  ///< To be decided by `add_crossings`: too close to call, or two crossings.
};

/// Of some pairs of a circle and a triangle those that may cross, in their order.
struct CircleCuts {
  static constexpr std::size_t most = 64;

  std::size_t count = 0;
  alignas(64) std::array<double, most> angle;  ///< Of the crossing, where there is one: as in CircleCrossing.
  alignas(64) std::array<double, most> verdict;  ///< A CutVerdict as a number.
  std::array<std::size_t, most> pair;            ///< Place in the lists.
};

/// What circles are cut with.
struct CutSource {
  const AxisVertex* vertices;
  const Triangle* triangles;
  /// At least every |x| and |y| of the triangles, and 2/3 of those of the points.
  double scale;
};

/// Cuts triangles at the height of circles, many at a time: what `add_crossings` does one by one, wherever
/// its decisions are certain in double by far. The same bits as there, on every instruction set. A pair that
/// is not among those that may cross has no crossing, and its triangle does not hold the point.
///
/// Takes pairs [first, first + most) of the lists, as far as they go; `circle` are places in `points`.
void cut_circles(const CutSource& source, std::span<const TurningPoint> points, std::span<const Index> circle,
                 std::span<const Index> triangle, std::size_t first, CircleCuts& out);

}  // namespace condyle::tangential
