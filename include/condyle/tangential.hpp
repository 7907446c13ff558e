#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// The tangential method: circles about one axis. docs/mathematics/04-tangential-method.md; Arbabi et al. 2009.

namespace condyle::tangential {
struct Rings;
/// How the state of a point follows from its circle.
enum class TangentialRule {
  /// All crossings in their order, anchored by the exact winding number at the point. Always right.
  alternating,
  /// The published rule: the nearest crossing along the arc, inside if the point is behind that
  /// triangle's plane. Right while the circle does not meet that plane a second time on the way, and away
  /// from shared edges; a face seen from beyond its own plane fails at 75 degrees already (see the tests).
  /// Kept to reproduce published figures.
  nearest_arc
};

struct RingTableOptions {
  /// Cells of the profile per triangle, above 0 and at most 64. More cells shorten the lists, of which each
  /// point reads one, and enter each triangle in more of them: on a hip bone of 156,288 triangles 1/4 and 1
  /// take 2.4 and 7 times as long to build as 1/16, 63 and 103 bytes per triangle instead of 47, and 0.95 and
  /// 0.9 of the time for all angles of a femur.
  double cells_per_triangle = 0.0625;
};

/// Counts of what a query did; the same for any number of threads.
struct TangentialWork {
  std::size_t points = 0;           ///< Points queried.
  std::size_t candidates = 0;       ///< Triangles in the lists of their cells.
  std::size_t evaluated = 0;        ///< Triangles among them whose box holds the circle.
  std::size_t crossings = 0;        ///< Crossings found.
  std::size_t exact_decisions = 0;  ///< Signs that double arithmetic left open, of the circle's own.

  TangentialWork& operator+=(const TangentialWork& other) noexcept;
  friend bool operator==(const TangentialWork&, const TangentialWork&) = default;
};

/// The answer for each query point, one array per quantity.
struct TangentialResults {
  std::vector<PointState> state;
  std::vector<int> winding;  ///< Winding number; on the surface, that just ahead of the point on its circle.
  /// Signed, along the circle: > 0 apart, to the nearest occupied arc, +infinity if the circle meets no
  /// solid; < 0 inside, minus the angle to the nearer end of the point's arc, -infinity if the whole
  /// circle is solid (also for a point on the axis, which no rotation moves). 0 on the surface.
  std::vector<Angle> angular_gap;
  std::vector<double> arc_gap_mm;  ///< The same as a length at the point's own radius.
  std::vector<Index> triangle;     ///< The triangle reached; no_index if there is none.
  /// Sense in which to rotate the point to reach it: inside, the nearer exit.
  std::vector<RotationSense> rotation_sense;
  TangentialWork work;

  [[nodiscard]] std::size_t size() const noexcept { return state.size(); }
  void resize(std::size_t count);
  friend bool operator==(const TangentialResults&, const TangentialResults&) = default;
};

/// Rotation angles for which a point lies in the solid: begin <= angle < end, with 0 <= begin < 2 pi and
/// begin < end <= begin + 2 pi. An arc that never ends is [0, 2 pi) with no triangles.
struct OccupiedArc {
  Angle begin, end;
  Index enters = no_index, leaves = no_index;  ///< Triangles at the two ends.

  friend bool operator==(const OccupiedArc&, const OccupiedArc&) = default;
};

/// From an angle on a circle to the nearest end of an arc.
struct AngularGap {
  /// > 0 apart: to the nearest occupied arc, +infinity if the circle meets no solid. < 0 inside: minus the
  /// angle to the nearer end of the arc, -infinity if the whole circle is solid.
  Angle angle = Angle::radians(std::numeric_limits<double>::infinity());
  Index triangle = no_index;  ///< The triangle reached.
  /// Sense in which to rotate to reach it; positive if both are as near.
  RotationSense rotation_sense = RotationSense::none;

  friend bool operator==(const AngularGap&, const AngularGap&) = default;
};

/// For many points, all rotation angles about one axis at which each lies in the solid: one pass answers
/// every angle.
///   offset_   0        2  2     3  ...     one entry per point, plus one
///   arc_     | a   b  |  | c   | ...       point i owns [offset_[i], offset_[i+1])
class OccupiedArcs {
 public:
  OccupiedArcs() : offset_(1, 0) {}

  /// Number of points.
  [[nodiscard]] std::size_t size() const noexcept { return offset_.size() - 1; }
  /// The arcs of one point, ascending.
  [[nodiscard]] std::span<const OccupiedArc> of(std::size_t point) const noexcept {
    return {arc_.data() + offset_[point], offset_[point + 1] - offset_[point]};
  }

  /// Whether the point, rotated by phi, lies in the solid. As exact as the ends of the arcs are: they err by
  /// some 1e-14 of a radian where the circle crosses the surface, by 1e-7 at worst where it only touches it.
  /// Logarithmic in the point's arcs.
  [[nodiscard]] bool inside_at(std::size_t point, Angle phi) const noexcept;
  /// The gap of the point rotated by phi.
  [[nodiscard]] AngularGap gap_at(std::size_t point, Angle phi) const noexcept;

  friend bool operator==(const OccupiedArcs&, const OccupiedArcs&) = default;

 private:
  friend class RingTable;
  OccupiedArcs(std::vector<std::size_t> offset, std::vector<OccupiedArc> arcs);

  std::vector<std::size_t> offset_;
  std::vector<OccupiedArc> arc_;
};

/// Contents of a table, for tuning and for the figures of docs/performance.md.
struct RingTableSize {
  std::size_t cells, entries, bytes;
  std::size_t cells_in_use;  ///< Cells with at least one triangle.
  std::size_t longest_list;
  double mean_list;           ///< Over the cells in use.
  double bytes_per_triangle;  ///< All of it, the triangles themselves included.
};

/// Which triangles a rotating point can meet about one axis, cell by cell of the profile (radius, height).
///
/// Built once for a mesh and an axis; any points, and every rotation about the axis, reuse it. Points are
/// given in the mesh's own frame, in mm. Which triangles a circle crosses, on which side of the point, and
/// the winding number are exact in the axis frame (see `AxisFrame` for when that is exact for the points
/// given). Immutable and shared: a copy costs a pointer. A table moved from may only be assigned to or
/// destroyed.
class RingTable {
 public:
  /// MeshError if the mesh is not closed: arcs need an inside. UsageError for options out of range. Linear
  /// in triangles.
  RingTable(const Mesh& mesh, const AxisFrame& frame, RingTableOptions options = {});

  /// State, gap or depth, triangle and rotation sense of every point. Linear in points; a point costs the
  /// length of its cell's list. No allocation per point. `results` may hold anything before. UsageError for a coordinate that
  /// is not finite or beyond 1e30 mm.
  void query(PointsView points, TangentialResults& results,
             TangentialRule rule = TangentialRule::alternating) const;
  [[nodiscard]] TangentialResults query(PointsView points,
                                        TangentialRule rule = TangentialRule::alternating) const;

  /// All rotation angles at which each point lies in the solid. Costs about as much as one query.
  [[nodiscard]] OccupiedArcs occupied_arcs(PointsView points) const;

  [[nodiscard]] const AxisFrame& frame() const noexcept;
  [[nodiscard]] RingTableSize table_size() const noexcept;

 private:
  std::shared_ptr<const Rings> rings_;
};

}  // namespace condyle::tangential
