#pragma once

#include <memory>
#include <optional>

#include "condyle/radial.hpp"
#include "core/lazy.hpp"
#include "core/pool.hpp"
#include "mesh/vertex_triangles.hpp"
#include "radial/build/cell_radii.hpp"
#include "radial/build/direction_pyramid.hpp"
#include "radial/query/penetrations.hpp"

namespace condyle::radial {

/// Data of a RadialTable; its functions are those of RadialTable.
class DirectionTable {
 public:
  DirectionTable(Mesh mesh, const RadialOptions& options);
  DirectionTable(const DirectionTable& other);

  void update(PointsView vertices);
  void update(std::span<const Index> moved, PointsView positions);

  void query(PointsView points, RadialResults& out) const;
  std::vector<double> radial_gaps(PointsView points) const;
  void penetrations(const PointBlocks& points, const Pose& X_FM, Penetrations& out,
                    PenetrationWork* work) const;
  void penetrations(const PointBlocks& points, std::span<const Pose> X_FM, std::span<Penetrations> out) const;
  void add_ray_to_normal(PointsView points, const Pose& X_FM, Penetrations& out) const;
  void prepare_penetrations() const;

  const TriMesh& mesh() const noexcept { return deformed_ ? *deformed_ : given_.arrays(); }
  bool is_closed() const noexcept { return given_.is_closed(); }
  std::optional<int> winding_at_centre() const noexcept { return winding_at_centre_; }
  RadialTableSize table_size() const noexcept;

 private:
  /// Parts that penetrations() reads and query() does not.
  struct RejectionParts {
    CellRadii radii;
    DirectionPyramid pyramid;
  };

  const CubeMap* cube() const noexcept { return std::get_if<CubeMap>(&map_); }
  void build_parts();
  void find_winding_at_centre();
  void require_centre_off_surface() const;
  void require_centre_off_triangle(Index triangle) const;
  void require_closed() const;
  TriMesh& deforming_mesh();
  void follow_all();
  void follow_some(std::span<const Index> moved);
  const RejectionParts& rejection_parts() const;
  void find_rejection_parts(RejectionParts& parts) const;
  ExactView exact_view() const noexcept {
    const auto& functions = table_.forms.edge_functions;
    return {mesh(), map_, table_.entries, winding_at_centre_.value_or(0),
            functions.empty() ? nullptr : functions.data()};
  }
  std::optional<CubeView> cube_view() const;

  Mesh given_;
  std::unique_ptr<TriMesh> deformed_;  // from the first update on
  DirectionMap map_;
  CubeTable table_;  // of the paper's map only the entries
  std::optional<int> winding_at_centre_;
  mesh::VertexTriangles triangles_at_;  // from the first update of some vertices on
  core::Lazy<RejectionParts> rejection_;
  mutable core::Pool<PenetrationScratch> scratch_;
};

}  // namespace condyle::radial
