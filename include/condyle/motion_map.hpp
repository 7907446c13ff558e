#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "condyle/control.hpp"
#include "condyle/range_of_motion.hpp"

/// The combined range of motion: the free values of one coordinate of a joint over a grid of two others.
/// docs/mathematics/06-range-of-motion.md.

namespace condyle::motion {

/// A coordinate that a map holds or varies: a joint angle, or the translation along an axis of the joint's translation frame.
class MapCoordinate {
 public:
  constexpr MapCoordinate(JointAngle angle) noexcept : number_(static_cast<std::uint8_t>(angle)) {}
  /// Along x (0), y or z.
  [[nodiscard]] static constexpr MapCoordinate translation(int axis) noexcept {
    return MapCoordinate(static_cast<JointAngle>(3 + axis));
  }
  [[nodiscard]] constexpr bool is_angle() const noexcept { return number_ < 3; }
  [[nodiscard]] constexpr JointAngle angle() const noexcept { return static_cast<JointAngle>(number_); }
  [[nodiscard]] constexpr int axis() const noexcept { return number_ - 3; }
  /// "deg" or "mm": of its values.
  [[nodiscard]] constexpr std::string_view unit() const noexcept { return is_angle() ? "deg" : "mm"; }
  friend bool operator==(const MapCoordinate&, const MapCoordinate&) = default;

 private:
  std::uint8_t number_;
};

/// "flexion", or what the joint calls this angle; "x", "y" or "z".
[[nodiscard]] std::string_view name_of(MapCoordinate coordinate, Anatomy joint) noexcept;

/// Values of one held coordinate: first, first + step, ... up to last. In degrees or mm, because people write them so
/// and every value is to be the double nearest to what they wrote.
struct GridAxis {
  MapCoordinate coordinate = JointAngle::flexion;
  double first = 0, last = 0, step = 1;

  /// Values on the axis; the last one counts if it is a whole number of steps away to a millionth of one.
  [[nodiscard]] std::size_t count() const;
  /// Whether the last one is none of the values.
  [[nodiscard]] bool ends_early() const;
  [[nodiscard]] double value(std::size_t i) const noexcept { return first + static_cast<double>(i) * step; }
};

/// Past this many points a map is refused: at a millisecond each it would run for hours, at some 350 bytes
/// each fill gigabytes.
inline constexpr std::size_t most_map_points = 10'000'000;

/// How far a map varies a translation from its start: farther than a joint that is still one.
inline constexpr SlideRange map_slide_range{-50, 50};

/// Grid of a map: for every pair of values of the two coordinates on its axes, which values of a third are free.
///
///     column.count()
///     +---+---+---+
///     | 0 | 1 | 2 |     points row by row
///     +---+---+---+     row.count()
///     | 3 | 4 | 5 |
///     +---+---+---+
struct MapGrid {
  GridAxis row = {}, column = {};
  MapCoordinate vary = JointAngle::internal_rotation;
  Angle start = {};                                                   ///< of a varied angle
  RotationRange range = {Angle::degrees(-180), Angle::degrees(180)};  ///< from the start, in either direction
  /// Angles that are neither on an axis nor varied, the others 0; and the translation at which the joint is held (held_at()), from which
  /// a varied one starts.
  JointCoordinates held = {};
  SlideRange slide_range = map_slide_range;  ///< of a varied translation, from its start

  [[nodiscard]] std::size_t size() const { return row.count() * column.count(); }
  /// The joint's coordinates at the start of a point's rotations or slides.
  [[nodiscard]] JointCoordinates start_of(std::size_t point) const;
  /// Whether a coordinate on an axis, or the varied one, is a translation.
  [[nodiscard]] bool translates() const noexcept;
};

/// Throws UsageError for three coordinates that are not all different, steps that are not above 0, axes that end before
/// they begin, values that are not finite, an empty range or one of more than half a turn in either direction, a
/// hinge, a translation of a joint that does not translate, or more than most_map_points (with their number).
void check_grid(const MapGrid& grid, JointKind kind);

/// One end of what is free at a point of a map, in the unit of the varied coordinate.
struct MapEnd {
  double value = 0;       ///< of the varied coordinate
  double from_start = 0;  ///< the same less its start
  LimitReason reason = LimitReason::end_of_range;
  double error_bound = 0;
  std::optional<double> bearing_contact = {};  ///< how far the first one is, where that ends no motion
  std::optional<ContactWitness> contact = {};
  std::optional<std::size_t> ligament = {};

  [[nodiscard]] ContactKind kind() const noexcept { return contact ? contact->kind : ContactKind::unknown; }
};

struct MapInterval {
  MapEnd low, high;
  double width = 0;

  [[nodiscard]] bool holds_start() const noexcept { return low.from_start <= 0 && high.from_start >= 0; }
};

/// What is free at one point, whether an angle varies or a translation.
struct MapPoint {
  MapEnd negative, positive;           ///< from the start
  std::vector<MapInterval> intervals;  ///< ascending

  [[nodiscard]] bool free_at_start() const noexcept {
    return positive.reason != LimitReason::contact_at_start &&
           positive.reason != LimitReason::strained_at_start;
  }
  /// As FreeAngles has it.
  [[nodiscard]] const MapInterval* nearest_to_start() const noexcept;
};

/// Free angles, or free translations, over a grid. A point in contact at the start may be free elsewhere on its rotation, and one that is
/// free at the start may have more free intervals beyond contact.
struct MotionMap {
  MapGrid grid;
  std::vector<FreeAngles> points;       ///< grid.size(), row by row; none if a translation varies
  Anatomy anatomy = Anatomy::hip;       ///< of the joint
  std::vector<FreeSlides> slides = {};  ///< instead of points if a translation varies

  [[nodiscard]] MapPoint point(std::size_t i) const;

  /// Work counters of all searches together.
  [[nodiscard]] SearchWork work() const noexcept;
};

/// Computes all points, on all threads. Each point's answer is that of RangeOfMotion, at a translation that of the joint shifted there, a shift
/// that costs some time per triangle: the same bits whatever the threads. Throws as check_grid().
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

/// A grid with one row has no volume, with one column no areas, and one that translates neither, as what is free there ends with the range: zeros.
[[nodiscard]] FreeVolume free_volume(const MotionMap& map);

}  // namespace condyle::motion
