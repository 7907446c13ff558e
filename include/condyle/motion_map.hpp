#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "condyle/control.hpp"
#include "condyle/range_of_motion.hpp"

/// The combined range of motion: the free angles of one joint angle over a grid of the other two.
/// docs/mathematics/06-range-of-motion.md.

namespace condyle::motion {

/// Values of one held angle: first, first + step, ... up to last. In degrees, because people write them so
/// and every value is to be the double nearest to what they wrote.
struct GridAxis {
  JointAngle angle = JointAngle::flexion;
  double first_deg = 0, last_deg = 0, step_deg = 1;

  /// Values on the axis; the last one counts if it is a whole number of steps away to a millionth of one.
  [[nodiscard]] std::size_t count() const;
  /// Whether the last one is none of the values.
  [[nodiscard]] bool ends_early() const;
  [[nodiscard]] double value_deg(std::size_t i) const noexcept {
    return first_deg + static_cast<double>(i) * step_deg;
  }
};

/// Past this many points a map is refused: at a millisecond each it would run for hours, at some 350 bytes
/// each fill gigabytes.
inline constexpr std::size_t most_map_points = 10'000'000;

/// Grid of a map: for every pair of values of the two held angles, which values of the third are free.
///
///     column.count()
///     +---+---+---+
///     | 0 | 1 | 2 |     points row by row
///     +---+---+---+     row.count()
///     | 3 | 4 | 5 |
///     +---+---+---+
struct MapGrid {
  GridAxis row = {}, column = {};
  JointAngle vary = JointAngle::internal_rotation;
  Angle start = {};                                                   ///< of the varied angle
  RotationRange range = {Angle::degrees(-180), Angle::degrees(180)};  ///< from the start, in either direction

  [[nodiscard]] std::size_t size() const { return row.count() * column.count(); }
  /// The joint's angles at the start of a point's rotations.
  [[nodiscard]] JointAngles start_of(std::size_t point) const;
};

/// Throws UsageError for three angles that are not all different, steps that are not above 0, axes that end before
/// they begin, values that are not finite, an empty range or one of more than half a turn in either direction, a
/// hinge, or more than most_map_points (with their number).
void check_grid(const MapGrid& grid, JointKind kind);

/// Free angles over a grid. A point in contact at the start may be free elsewhere on its rotation, and one that is free
/// at the start may have more free intervals beyond contact.
struct MotionMap {
  MapGrid grid;
  std::vector<FreeAngles> points;  ///< grid.size(), row by row
  Anatomy anatomy = Anatomy::hip;  ///< of the joint

  /// Work counters of all searches together.
  [[nodiscard]] SearchWork work() const noexcept;
};

/// Computes all points, on all threads. Each point's answer is that of RangeOfMotion: the same bits whatever
/// the threads. Throws as check_grid().
[[nodiscard]] MotionMap motion_map(const MapGrid& grid, const RangeOfMotion& joint);
/// The same; empty if it was stopped before all points were computed.
[[nodiscard]] std::optional<MotionMap> motion_map(const MapGrid& grid, const RangeOfMotion& joint,
                                                  const Control& control);

/// How much of the space of joint angles is free, all intervals of every point together, by the trapezoidal rule over the grid: the error of the
/// volume goes with the square of the step where limits change smoothly.
///
/// Three angles are coordinates of rotations, and equal boxes of them are not equally many rotations: near
/// adduction = +-90 degrees flexion and internal rotation turn about nearly one line. A small change of the
/// angles turns M by omega = e1 df + e2 da + e3 dr, and the volume that these three vectors span,
/// |e1 . (e2 x e3)| = |e1 x e3| = cos(adduction), of a shoulder sin(elevation), is what a box da df dr holds of the
/// invariant (Haar) measure, which does not depend on how rotations are written down. Weighted by it the volume is the same in
/// any joint coordinate system; the whole of rotations, flexion and internal rotation over a full turn and
/// adduction over a half, has 360 * 360 * 360 / pi deg^3.
struct FreeVolume {
  double plain_deg3 = 0;
  double weighted_deg3 = 0;           ///< the weight integrated too, exactly if its own angle is varied
  std::vector<double> row_area_deg2;  ///< free width over the columns of each row
};

/// A grid with one row has no volume, with one column no areas: zeros.
[[nodiscard]] FreeVolume free_volume(const MotionMap& map);

}  // namespace condyle::motion
