#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "condyle/axis_frame.hpp"
#include "condyle/point_state.hpp"
#include "mesh/closed_mesh.hpp"
#include "mesh/triangle_intersection.hpp"
#include "mesh/winding_number.hpp"
#include "tangential/build/free_directions.hpp"
#include "tangential/build/profile_boxes.hpp"
#include "tangential/build/ring_lists.hpp"
#include "tangential/exact/circle_crossing.hpp"
#include "tangential/exact/occupied_arcs.hpp"

/// The tangential method: circles about one axis. docs/mathematics.md, section 4; Arbabi et al. 2009.

namespace condyle {

/// How a point's circle tells inside from outside.
enum class TangentialRule {
  /// All crossings in their order, anchored by the exact winding number at the point. Right always.
  alternating,
  /// The published test: the nearest crossing along the arc, inside where the point is behind that
  /// triangle's plane. Right while the circle does not meet that plane a second time on the way, and away
  /// from shared edges; a face seen from beyond its own plane fails at 75 degrees already (see the tests).
  /// Kept to reproduce published figures.
  nearest_arc
};

struct RingTableOptions {
  /// Profile cells per triangle. More cells shorten the lists, of which each point reads one, and repeat each
  /// triangle in more of them: on a hip bone of 156,288 triangles 1/4 and 1 take 2.4 and 7 times as long to
  /// build as 1/16, 63 and 103 bytes per triangle instead of 47, and 0.95 and 0.9 of the time for all angles
  /// of a femur.
  double cells_per_triangle = 0.0625;
};

/// The answer for each query point, one array per quantity.
struct TangentialHits {
  std::vector<PointState> state;
  std::vector<int> winding;  ///< Winding number; on the surface, that just ahead of the point on its circle.
  /// Signed, radians, along the circle: > 0 apart, to the nearest occupied arc, +infinity where the circle
  /// meets no solid; < 0 inside, minus the angle to the nearer end of the point's arc, -infinity where the
  /// whole circle is solid (also for a point on the axis, which no rotation moves). 0 on the surface.
  std::vector<double> angular_gap;
  std::vector<double> arc_gap;  ///< The same as a length in mm at the point's own radius.
  std::vector<Index> triangle;  ///< The triangle reached; no_index where there is none.
  std::vector<Turn> turn;       ///< Which way to turn to reach it: inside, the shorter way out.
  tangential::TangentialWork work;

  std::size_t size() const noexcept { return state.size(); }
  void resize(std::size_t count);
  friend bool operator==(const TangentialHits&, const TangentialHits&) = default;
};

/// What a table holds, for tuning and for the figures of docs/performance.md.
struct RingTableSize {
  std::size_t cells, entries, bytes;
  std::size_t cells_in_use;  ///< Cells with at least one triangle.
  std::size_t longest_list;
  double mean_list;           ///< Over the cells in use.
  double bytes_per_triangle;  ///< All of it, the triangles themselves included.
};

/// Which triangles a turning point can meet about one axis: rings, seen in profile (`RingLists`).
///
/// Built once for a mesh and an axis; any points, and every rotation about the axis, reuse it. Points are
/// given in the mesh's own frame. Which triangles a circle crosses, on which side of the point, and the
/// winding number are exact in the axis frame (see `AxisFrame` for when that is exact for the points given).
class RingTable {
 public:
  /// MeshError where the mesh is not closed: arcs need an inside. UsageError for options out of range.
  RingTable(const TriMesh& mesh, const AxisFrame& frame, RingTableOptions options = {});
  /// Without that check: of one mesh many tables are made.
  RingTable(const mesh::ClosedMesh& mesh, const AxisFrame& frame, RingTableOptions options = {});

  /// State, gap or depth, triangle and sense of every point. Linear in points; a point costs the length of
  /// its cell's list. No allocation per point.
  void query(PointsView points, TangentialHits& out, TangentialRule rule = TangentialRule::alternating) const;
  TangentialHits query(PointsView points, TangentialRule rule = TangentialRule::alternating) const;

  /// All rotation angles at which each point lies in the solid.
  OccupiedArcs occupied_arcs(PointsView points) const;

  const AxisFrame& frame() const noexcept { return frame_; }
  const tangential::RingLists& lists() const noexcept { return lists_; }
  const tangential::ProfileGrid& grid() const noexcept { return lists_.grid(); }
  tangential::TriangleRef corner_refs(Index triangle) const noexcept {
    const auto& [a, b, c] = triangles_[triangle];
    return {&vertices_[a].at, &vertices_[b].at, &vertices_[c].at};
  }
  const tangential::FreeDirections& free_directions() const noexcept { return free_; }
  /// In the axis frame.
  mesh::TriangleCorners corners(Index triangle) const noexcept {
    const auto [a, b, c] = triangles_[triangle];
    return {vertices_[a].at, vertices_[b].at, vertices_[c].at};
  }
  RingTableSize table_size() const noexcept;

 private:
  class Chunk;

  tangential::FreeDirections free_directions_of(const tangential::AxisVertices& vertices,
                                                const tangential::ProfileBoxes& boxes) const;
  int winding_outwards(const tangential::Circle& circle, const tangential::CirclePlace& place,
                       tangential::TangentialWork& work) const;
  int winding_on_axis(const Vec3& point) const;
  tangential::Circle circle_of(const Vec3& point) const noexcept;
  void answer(Chunk& chunk, std::size_t begin, std::size_t end, TangentialRule rule,
              TangentialHits& out) const;
  void answer_alternating(Chunk& chunk, std::size_t circle, TangentialHits& out, std::size_t i) const;
  void answer_nearest_arc(Chunk& chunk, std::size_t circle, TangentialHits& out, std::size_t i) const;

  AxisFrame frame_;
  core::UninitialisedVector<tangential::AxisVertex> vertices_;
  core::UninitialisedVector<Triangle> triangles_;
  double scale_ = 0;  ///< At least every |x|, |y| of the triangles.
  tangential::RingLists lists_;
  tangential::FreeDirections free_;
};

}  // namespace condyle
