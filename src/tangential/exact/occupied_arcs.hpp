#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/points.hpp"
#include "tangential/exact/circle_crossing.hpp"

namespace condyle {

/// Sense of rotation about the axis, counter-clockwise seen from its tip being positive.
enum class Turn : signed char { negative = -1, none = 0, positive = 1 };

/// Rotation angles for which a point lies in the solid: begin <= angle < end, in radians, 0 <= begin < 2 pi
/// and begin < end <= begin + 2 pi. An arc that never ends is [0, 2 pi) with no triangles.
struct OccupiedArc {
  double begin, end;
  Index enters = no_index, leaves = no_index;  ///< Triangles at the two ends.

  friend bool operator==(const OccupiedArc&, const OccupiedArc&) = default;
};

/// Way from a place on a circle to the nearest end of an arc.
struct AngularGap {
  /// > 0 apart: to the nearest occupied arc, +infinity where the circle meets no solid. < 0 inside: minus the
  /// way to the nearer end of its arc, -infinity where the whole circle is solid. Radians.
  double angle = std::numeric_limits<double>::infinity();
  Index triangle = no_index;  ///< The triangle reached.
  Turn turn = Turn::none;     ///< Which way to turn to get there; positive where both are as near.

  friend bool operator==(const AngularGap&, const AngularGap&) = default;
};

/// The arcs of a circle on which the winding number is positive, ascending, appended to `arcs`. `winding` is
/// that just ahead of the point; `crossings` are sorted, and sum to zero. Crossings at one angle act
/// together. Beyond that double arithmetic orders them: where surfaces coincide without sharing edges, or the
/// circle touches the solid in one point, an arc or a gap no longer than the crossings' error may show or
/// not.
void append_arcs(int winding, std::span<const tangential::CircleCrossing> crossings,
                 std::vector<OccupiedArc>& arcs);

/// The gap at the point itself.
AngularGap gap_at_point(int winding, std::span<const tangential::CircleCrossing> crossings) noexcept;

/// For many points, all rotation angles about one axis at which each lies in the solid: one pass answers
/// every angle.
///   offset_   0        2  2     3  ...     one entry per point, plus one
///   arc_     | a   b  |  | c   | ...       point i owns [offset_[i], offset_[i+1])
class OccupiedArcs {
 public:
  OccupiedArcs() : offset_(1, 0) {}
  OccupiedArcs(std::vector<std::size_t> offset, std::vector<OccupiedArc> arcs);

  std::size_t size() const noexcept { return offset_.size() - 1; }
  std::span<const OccupiedArc> of(std::size_t point) const noexcept {
    return {arc_.data() + offset_[point], offset_[point + 1] - offset_[point]};
  }

  /// Whether the point, turned by phi, lies in the solid. As exact as the ends of the arcs are; see
  /// `add_crossings`.
  bool inside_at(std::size_t point, Angle phi) const noexcept;
  AngularGap gap_at(std::size_t point, Angle phi) const noexcept;

  friend bool operator==(const OccupiedArcs&, const OccupiedArcs&) = default;

 private:
  std::vector<std::size_t> offset_;
  std::vector<OccupiedArc> arc_;
};

}  // namespace condyle
