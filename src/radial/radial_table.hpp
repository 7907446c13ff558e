#pragma once

#include <limits>
#include <numbers>
#include <optional>
#include <variant>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/mesh.hpp"
#include "condyle/point_state.hpp"
#include "mesh/vertex_triangles.hpp"
#include "radial/build/cell_lists.hpp"
#include "radial/build/direction_pyramid.hpp"
#include "radial/exact/direction_map.hpp"
#include "radial/exact/ray_scan.hpp"
#include "radial/query/penetrations.hpp"
#include "radial/query/sorted_points.hpp"

/// The radial method: rays from one centre. docs/mathematics.md, section 2; Arbabi et al. 2009.

namespace condyle::radial {
struct FoundPoints;
struct GapColumns;
struct PenetrationSearch;
class PenetrationTrack;
}  // namespace condyle::radial

namespace condyle {

struct RadialOptions {
  radial::DirectionMapKind map = radial::DirectionMapKind::cube;
  /// Cells along one side of a face (cube) or of the disc's square (cartesian). Finer cells shorten lists and
  /// grow the table; none asks for about as many cells as fit the number of triangles.
  std::optional<int> cells_per_side;
};

/// Above this angle between ray and surface normal the radial depth is no longer a depth: the ray grazes the
/// wall, and the tangential depth is the one to read. docs/mathematics.md, section 2.
inline constexpr Angle oblique_ray = Angle::degrees(60);

/// The answer for each query point, one array per quantity.
struct RadialHits {
  std::vector<PointState> state;
  /// Winding number; for a point on the surface that of the side facing the centre.
  std::vector<int> winding;
  /// Signed, mm, along the ray: > 0 apart, < 0 penetrating, 0 on the surface; +infinity where the ray meets
  /// nothing.
  std::vector<double> radial_gap;
  /// Triangle that the gap or depth is measured to; no_index where there is none.
  std::vector<Index> triangle;
  std::vector<radial::RayDirection> direction;
  /// Between the ray and the normal of that triangle, radians in [0, pi/2]; 0 where there is no triangle.
  std::vector<double> ray_to_normal;

  std::size_t size() const noexcept { return state.size(); }
  void resize(std::size_t count);
  friend bool operator==(const RadialHits&, const RadialHits&) = default;
};

/// What a table holds, for tuning and for the figures of docs/performance.md.
struct RadialTableSize {
  std::size_t cells, entries, bytes;
  Index longest_list;
};

/// Which fixed triangles can be met in each direction from the centre, which is the origin of the mesh's
/// frame.
///
/// Built once for a mesh and a centre: every rigid pose of the query points reuses it. All decisions (which
/// triangles a ray crosses, on which side of each crossing the point lies) are exact for the doubles given: a
/// zero is broken by an infinitesimal shift of the ray, the same for all triangles, so that neighbours never
/// disagree. Gaps and depths are double, within 1e-12 of the vertex's radius, whatever the angle at which the
/// ray meets the surface.
class RadialTable {
 public:
  /// Raises MeshError where the origin lies exactly on the surface, and UsageError for options out of range.
  explicit RadialTable(TriMesh mesh, RadialOptions options = {});

  /// The surface has deformed: new places of all vertices, as many as there were. Answers are those of a
  /// table made anew for the mesh as it is now. Raises what the constructor does; the table is then not to be
  /// asked until an update succeeds.
  ///
  /// The first update lists triangles with room for their vertices to move on: a box on the cube that holds
  /// where each was and is, and a sixteenth of a cell more. Later ones list those alone whose vertices leave
  /// their rooms, which then grow: a surface that goes to and fro soon stays in them, and an update costs
  /// measuring the triangles, a third to nearly half of a build. Lists with room are longer by a
  /// quarter to a half, and a pose asked for takes 1.1 to 1.5 times as long; a new table is without.
  void update(PointsView vertices);

  /// New places of some vertices, each named once. The same otherwise.
  ///
  /// Cost: the triangles at those vertices, the rows of the cells they are in, and a look at the radii of all
  /// cells. The first such update also finds which triangles each vertex has, and the radii of each triangle
  /// in each of its cells, which takes some 30 bytes per triangle.
  void update(std::span<const Index> moved, PointsView positions);

  /// State, winding number, gap or depth, triangle of every point. Which gap: a point outside reaches the
  /// surface away from the centre where the centre is outside (ball seen from the socket: the joint space),
  /// and towards it where the centre is inside the solid (socket seen from the ball). A point inside leaves
  /// by the nearer way. A point exactly at the centre has no ray: its gap is infinite, negative where it is
  /// inside.
  ///
  /// Raises MeshError for an open mesh, naming an edge of its boundary: without an inside there is no answer.
  /// Linear in points; a point costs a look at its cell's list, sixteen triangles at a time, and the few of
  /// them that its ray comes near.
  void query(PointsView points, RadialHits& out) const;
  RadialHits query(PointsView points) const;

  /// Whether each point is inside, alone: cheaper, since a point nearer to the centre than the surface in its
  /// cell has crossed nothing, and one further out than it has crossed everything.
  void query_states(PointsView points, std::vector<PointState>& out) const;

  /// Every point that is not outside at a pose X_FM, with what query() tells of it, byte for byte: points
  /// posed and rounded once (core/pose.hpp), signs exact, on every instruction set alike. All other points
  /// are outside.
  ///
  /// Three passes in vectors of floats: blocks of points and then points are rejected by the radii of the
  /// surface around them; what is left is held against the triangles of its cell, and points that floats do
  /// not settle are decided as query() does. For the paper's map, for a pose that is no rigid motion or moves
  /// the centre by more than four times the distance of the nearest surface, all points are.
  ///
  /// Raises MeshError for an open mesh. Cost: blocks, plus points near the surface. No allocation once `out`
  /// has its room.
  void penetrations(const SortedPoints& points, const Pose& X_FM, Penetrations& out,
                    PenetrationWork* work = nullptr) const;
  /// The same at each of several poses, on all threads; `out` has as many elements as there are poses.
  void penetrations(const SortedPoints& points, std::span<const Pose> X_FM,
                    std::span<Penetrations> out) const;
  /// Fills out.ray_to_normal; `points` are those that the sorted ones were made from, the pose is the one
  /// asked.
  void add_ray_to_normal(PointsView points, const Pose& X_FM, Penetrations& out) const;

  /// Calls visit(triangle of this table) for every triangle that shares a cell and a radius interval with the
  /// given one, which is in this table's frame: all that can intersect it, some of them several times.
  template <class Visit>
  void visit_candidates(const radial::Cone& cone, const Visit& visit) const {
    const auto in_cell = [&](const radial::CellOverlap& overlap) {
      const SquaredRadii radii = radii_of(overlap.cell);
      if (overlap.min_radius * overlap.min_radius > radii.greatest) return;
      if (overlap.max_radius * overlap.max_radius < radii.least) return;
      for (const Index triangle : lists_.of(overlap.cell)) visit(triangle);
    };
    std::visit([&](const auto& map) { map.visit_cells(cone, in_cell); }, map_);
  }

  const TriMesh& mesh() const noexcept { return mesh_; }
  bool is_closed() const noexcept { return winding_at_centre_.has_value(); }
  /// Winding number of the centre; empty for an open mesh.
  std::optional<int> winding_at_centre() const noexcept { return winding_at_centre_; }
  RadialTableSize table_size() const noexcept;

 private:
  friend class radial::PenetrationTrack;

  struct SquaredRadii {
    double least, greatest;
  };

  Index cell_of(const Vec3& v) const noexcept {
    return std::visit([&](const auto& map) { return map.cell_of(v); }, map_);
  }
  SquaredRadii radii_of(Index cell) const noexcept {
    const radial::RadiusWord word = lists_.radii[cell];
    if (word == radial::no_radii) return {std::numeric_limits<double>::infinity(), 0};
    return {lists_.scale.least(static_cast<int>(word & 0xffff)),
            lists_.scale.greatest(radial::greatest_radius_code - static_cast<int>(word >> 16))};
  }
  void require_closed() const;
  void require_centre_off_triangle(Index triangle) const;
  void require_centre_off_surface() const;
  void finish_lists();
  void find_all_radii();
  int find_winding_at_centre() const;
  int cube_cells_per_side() const noexcept {
    const auto* cube = std::get_if<radial::CubeMap>(&map_);
    return cube ? cube->cells_per_side() : 0;
  }
  /// False where floats are not to be trusted with these points and this pose.
  bool begin(const SortedPoints& points, const Pose& X_FM, radial::PenetrationSearch& search) const;
  void decide(const SortedPoints& points, const Pose& X_FM, radial::PenetrationSearch& search,
              radial::RayScan& scan, Penetrations& out, PenetrationWork* work) const;
  radial::CubeView view_of(const radial::CubeMap& map) const;
  /// Triangles that the ray through v may meet, in the given room or in the list itself.
  std::span<const Index> candidates(const Vec3& v, std::vector<Index>& room) const;
  void penetrations_one_by_one(const SortedPoints& points, const Pose& X_FM, Penetrations& out) const;
  void find_gaps(const SortedPoints& points, const Pose& X_FM, const radial::FoundPoints& found,
                 std::size_t first, std::size_t count, radial::GapColumns& out) const;
  void finish(const SortedPoints& points, const Pose& X_FM, const radial::FoundPoints& found,
              radial::RayScan& scan, Penetrations& out) const;

  TriMesh mesh_;
  std::variant<radial::CartesianMap, radial::CubeMap> map_;
  radial::CellLists lists_;
  radial::DirectionPyramid pyramid_;
  mesh::VertexTriangles triangles_at_;  // from the first update of some vertices on
  std::optional<int> winding_at_centre_;
  std::optional<std::pair<Index, Index>> boundary_edge_;
};

}  // namespace condyle
