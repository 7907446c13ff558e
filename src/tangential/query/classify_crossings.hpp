#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "tangential/build/profile_boxes.hpp"
#include "tangential/exact/circle_crossing.hpp"
#include "tangential/query/circle_cells.hpp"

namespace condyle::tangential {

/// Decision of vectors of doubles about a circle and a triangle that may cross.
enum class CrossingClass : signed char {
  leaves = static_cast<signed char>(Passage::leaves),  ///< One crossing, where the circle leaves the solid.
  enters = static_cast<signed char>(Passage::enters),  ///< One crossing, where it enters.
  uncertain = 0  ///< The filter could not decide, or there are two crossings: left to `add_crossings`.
};

/// The crossings among pairs of a circle and a triangle that may cross, in their order.
struct ClassifiedPairs {
  static constexpr std::size_t most = 64;

  std::size_t count = 0;
  /// Values of the crossing, if there is one: as in CircleCrossing.
  alignas(64) std::array<double, most> angle;
  /// A CrossingClass as a number.
  alignas(64) std::array<double, most> crossing_class;
  std::array<std::size_t, most> pair;  ///< Slot in the lists.
};

/// Triangles that circles are intersected with.
struct CircleTriangles {
  const AxisVertex* vertices;
  const Triangle* triangles;
  /// At least every |x| and |y| of the triangles, and 2/3 of those of the points.
  double scale;
};

/// Intersects triangles with circles at their heights, many at a time: what `add_crossings` does one by one,
/// wherever its decisions are certain in double by far. The same bits as there, on every instruction set. A
/// pair that is left out has no crossing, and its triangle does not hold the point.
///
/// Takes pairs [first, first + most) of the lists, as far as they go; `circle` are slots of `points`.
void classify_crossings(const CircleTriangles& source, std::span<const CirclePoint> points,
                        std::span<const Index> circle, std::span<const Index> triangle, std::size_t first,
                        ClassifiedPairs& out);

}  // namespace condyle::tangential
