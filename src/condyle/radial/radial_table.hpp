#pragma once

#include <numbers>
#include <optional>
#include <variant>
#include <vector>

#include "condyle/core/angle.hpp"
#include "condyle/core/point_state.hpp"
#include "condyle/mesh/tri_mesh.hpp"
#include "condyle/radial/direction_map.hpp"

/// The radial method: rays from one centre. docs/mathematics.md, section 2; Arbabi et al. 2009.

namespace condyle {

struct RadialOptions {
  DirectionMapKind map = DirectionMapKind::cube;
  /// Cells along one side of a face (cube) or of the disc's square (cartesian). Finer cells shorten lists and
  /// grow the table.
  int cells_per_side = 64;
};

/// Which way along its ray a vertex reaches the surface that its gap or depth is measured to.
enum class RayDirection : std::uint8_t { towards_centre, away_from_centre };

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
  std::vector<RayDirection> direction;
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
///   offset_     0     2  2        5  ...      one entry per cell, plus one
///   triangle_  | a b |  | c d e |    ...      cell i owns [offset_[i], offset_[i+1])
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

  /// State, winding number, gap or depth, triangle of every point. Which gap: a point outside reaches the
  /// surface away from the centre where the centre is outside (ball seen from the socket: the joint space),
  /// and towards it where the centre is inside the solid (socket seen from the ball). A point inside leaves
  /// by the nearer way. A point exactly at the centre has no ray: its gap is infinite, negative where it is
  /// inside.
  ///
  /// Raises MeshError for an open mesh, naming an edge of its boundary: without an inside there is no answer.
  /// Linear in points; a point costs the length of its cell's list. No allocation per point.
  void query(PointsView points, RadialHits& out) const;
  RadialHits query(PointsView points) const;

  /// Whether each point is inside, alone: cheaper, since a point nearer to the centre than the surface in its
  /// cell has crossed nothing, and one further out than it has crossed everything.
  void query_states(PointsView points, std::vector<PointState>& out) const;

  /// Calls visit(triangle of this table) for every triangle that shares a cell and a radius interval with the
  /// given one, which is in this table's frame: all that can intersect it, some of them several times.
  template <class Visit>
  void visit_candidates(const Cone& cone, const Visit& visit) const {
    const auto in_cell = [&](const CellOverlap& overlap) {
      const CellBounds& bounds = bounds_[overlap.cell];
      if (overlap.min_radius * overlap.min_radius > bounds.max_squared_radius) return;
      if (overlap.max_radius * overlap.max_radius < bounds.min_squared_radius) return;
      for (std::uint32_t i = offset_[overlap.cell]; i < offset_[overlap.cell + 1]; ++i) visit(triangle_[i]);
    };
    std::visit([&](const auto& map) { map.visit_cells(cone, in_cell); }, map_);
  }

  const TriMesh& mesh() const noexcept { return mesh_; }
  bool is_closed() const noexcept { return winding_at_centre_.has_value(); }
  /// Winding number of the centre; empty for an open mesh.
  std::optional<int> winding_at_centre() const noexcept { return winding_at_centre_; }
  RadialTableSize table_size() const noexcept;

 private:
  struct CellBounds {
    double min_squared_radius, max_squared_radius;
  };

  Index cell_of(const Vec3& v) const noexcept {
    return std::visit([&](const auto& map) { return map.cell_of(v); }, map_);
  }
  void require_closed() const;
  void fill();

  TriMesh mesh_;
  std::variant<CartesianMap, CubeMap> map_;
  std::vector<std::uint32_t> offset_;
  std::vector<Index> triangle_;
  std::vector<CellBounds> bounds_;
  std::optional<int> winding_at_centre_;
  std::optional<std::pair<Index, Index>> boundary_edge_;
};

}  // namespace condyle
