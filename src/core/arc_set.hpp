#pragma once

#include <vector>

#include "condyle/angle.hpp"

namespace condyle::core {

/// From `start` on in the positive sense over `width`, ends included; may pass the angle 0. A full turn has
/// width 2 pi.
struct Arc {
  Angle start, width;
  friend bool operator==(const Arc&, const Arc&) = default;
};

/// A set of directions: closed arcs on the circle.
///
///   0 |----[====]-------[==========]--| 2 pi      kept as disjoint intervals, ascending;
///     |==]----------------------[=====|           an arc across 0 is kept as two, of which arcs() makes one again
///
/// Ends are compared as they are, with no tolerance, and no operation computes new ones: the union of many
/// sets is the same to the last bit in whatever order it is formed.
class ArcSet {
 public:
  /// No direction.
  ArcSet() = default;
  /// Union of arcs: starts of any size, widths from 0 to 2 pi (more is a full turn).
  explicit ArcSet(const std::vector<Arc>& arcs);
  static ArcSet full_turn();

  bool empty() const noexcept { return intervals_.empty(); }
  bool is_full_turn() const noexcept;
  /// Sum of all widths.
  Angle measure() const noexcept;
  /// Disjoint, ascending by start in [0, 2 pi); an arc across 0 comes last.
  std::vector<Arc> arcs() const;

  bool contains(Angle direction) const noexcept;
  bool contains(const Arc& arc) const noexcept;

  /// Directions in either.
  ArcSet united(const ArcSet& other) const;
  /// Everything else, its ends included: single directions leave no gap, and are lost.
  ArcSet complement() const;

  friend bool operator==(const ArcSet&, const ArcSet&) = default;

 private:
  /// Radians, 0 <= low <= high <= 2 pi.
  struct Interval {
    double low, high;
    friend auto operator<=>(const Interval&, const Interval&) = default;
  };
  /// The one or two intervals of an arc.
  static void append(const Arc& arc, std::vector<Interval>& to);
  static std::vector<Interval> merged(std::vector<Interval> intervals);
  bool holds(const Interval& interval) const noexcept;

  std::vector<Interval> intervals_;
};

}  // namespace condyle::core
