#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "condyle/radial.hpp"
#include "mesh/vertex_triangles.hpp"
#include "radial/build/cell_lists.hpp"
#include "radial/build/direction_pyramid.hpp"
#include "radial/exact/direction_map.hpp"
#include "radial/exact/ray_scan.hpp"
#include "radial/query/point_blocks.hpp"

namespace condyle::radial {

struct FoundPoints;
struct GapColumns;
struct PenetrationSearch;

/// What a RadialTable holds; its functions are those of RadialTable.
class DirectionTable {
 public:
  DirectionTable(Mesh mesh, const RadialOptions& options);

  void update(PointsView vertices);
  void update(std::span<const Index> moved, PointsView positions);
  void query(PointsView points, RadialResults& out) const;
  void penetrations(const PointBlocks& points, const Pose& X_FM, Penetrations& out,
                    PenetrationWork* work) const;
  void penetrations(const PointBlocks& points, std::span<const Pose> X_FM, std::span<Penetrations> out) const;
  void add_ray_to_normal(PointsView points, const Pose& X_FM, Penetrations& out) const;
  void prepare_penetrations() const {}

  const TriMesh& mesh() const noexcept { return mesh_; }
  bool is_closed() const noexcept { return winding_at_centre_.has_value(); }
  std::optional<int> winding_at_centre() const noexcept { return winding_at_centre_; }
  RadialTableSize table_size() const noexcept;

 private:
  Index cell_of(const Vec3& v) const noexcept {
    return std::visit([&](const auto& map) { return map.cell_of(v); }, map_);
  }
  void require_closed() const;
  void require_centre_off_triangle(Index triangle) const;
  void require_centre_off_surface() const;
  void finish_lists();
  void find_all_radii();
  int find_winding_at_centre() const;
  /// False where floats are not to be trusted with these points and this pose.
  bool begin(const PointBlocks& points, const Pose& X_FM, PenetrationSearch& search) const;
  void decide(const PointBlocks& points, const Pose& X_FM, PenetrationSearch& search, RayScan& scan,
              Penetrations& out, PenetrationWork* work) const;
  CubeView view_of(const CubeMap& map) const;
  /// Triangles that the ray through v may meet, in the given room or in the list itself.
  std::span<const Index> candidates(const Vec3& v, std::vector<Index>& room) const;
  void penetrations_one_by_one(const PointBlocks& points, const Pose& X_FM, Penetrations& out) const;
  void find_gaps(const PointBlocks& points, const Pose& X_FM, const FoundPoints& found, std::size_t first,
                 std::size_t count, GapColumns& out) const;
  void finish(const PointBlocks& points, const Pose& X_FM, const FoundPoints& found, RayScan& scan,
              Penetrations& out) const;

  TriMesh mesh_;
  std::variant<CartesianMap, CubeMap> map_;
  CellLists lists_;
  DirectionPyramid pyramid_;
  mesh::VertexTriangles triangles_at_;  // from the first update of some vertices on
  std::optional<int> winding_at_centre_;
  std::optional<DirectedEdge> boundary_edge_;
};

}  // namespace condyle::radial
