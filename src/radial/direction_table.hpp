#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <variant>

#include "condyle/radial.hpp"
#include "core/lazy.hpp"
#include "core/pool.hpp"
#include "mesh/vertex_triangles.hpp"
#include "radial/build/cartesian_rows.hpp"
#include "radial/build/cell_radii.hpp"
#include "radial/build/direction_pyramid.hpp"
#include "radial/query/penetrations.hpp"

namespace condyle::radial {

/// Parts that penetrations() reads and query() does not.
struct RejectionParts {
  CellRadii radii;
  DirectionPyramid pyramid;
  IntervalScale scale;  ///< of both

  std::size_t bytes() const noexcept { return radii.bytes() + pyramid.size() * sizeof(PackedInterval); }
};

/// Rejection parts of a surface that has moved since: read with slack for how far, they need not be made again.
///
///     made        moved        moved        asked: with slack for how far the surface is from where it was
///     RejectionParts ------------------------->    when they were made, and forms of the triangles that
///                                                  points come near to alone
struct EarlierParts {
  RejectionParts parts;
  Points vertices;             ///< where they were; none: there are no parts
  std::optional<Drift> drift;  ///< since; empty where that is too far

  /// The entries have changed: no triangle of theirs is known to be too far out.
  void forget_nearest(const CellEntries& entries) { parts.radii.nearest.assign(entries.triangle.size(), 0); }
};

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
  const CubeMap* cube() const noexcept { return std::get_if<CubeMap>(&map_); }
  void build_parts();
  void find_winding_at_centre();
  void require_no_corner_at_centre() const;
  void require_centre_off_surface() const;
  void require_centre_off_triangle(Index triangle) const;
  void require_closed() const;
  TriMesh& deforming_mesh();
  void follow_all(const Points& before);
  void follow_on_paper_map();
  void keep_rejection_parts(const Points& before);
  double move_corners();
  void drift_on(std::span<const Index> moved, std::span<const Index> triangles);
  void settle_drift(double furthest_mm);
  void measure_forms() const;
  void follow_some(std::span<const Index> moved);
  const RejectionParts& rejection_parts() const;
  void find_rejection_parts(RejectionParts& parts) const;
  /// Without forms.
  ExactView exact_view() const noexcept {
    return {mesh(), map_, entries(), winding_at_centre_.value_or(0), nullptr};
  }
  const CellEntries& entries() const noexcept { return cube() ? table_.entries : cartesian_.entries; }
  ExactView measured_view() const;
  std::optional<CubeView> cube_view() const;
  bool reads_earlier_parts() const noexcept;
  CubeView drifted_view(const Drift& drift) const;

  Mesh given_;
  std::unique_ptr<TriMesh> deformed_;  // from the first update on
  Points spare_;                       // memory for the next one's vertices
  DirectionMap map_;
  mutable CubeTable table_;                    // on the cube; forms are measured when they are read
  CartesianRows cartesian_;                    // on the paper's map
  core::Lazy<std::monostate> forms_measured_;  // whether they are
  std::optional<int> winding_at_centre_;
  mesh::VertexTriangles triangles_at_;  // from the first update of some vertices on
  core::Lazy<RejectionParts> rejection_;
  EarlierParts earlier_;
  mutable std::atomic<std::size_t> measured_on_demand_ = 0;  // triangles, since the last update
  mutable core::Pool<PenetrationScratch> scratch_;
};

}  // namespace condyle::radial
