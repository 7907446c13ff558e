#pragma once

#include <array>
#include <span>
#include <vector>

#include "condyle/mesh.hpp"
#include "core/uninitialised.hpp"
#include "radial/build/cube_passes.hpp"
#include "radial/exact/direction_map.hpp"

namespace condyle::radial {

/// The cells of a cube map that triangles meet, found and counted before they are sorted into rows.
///
///   entry   triangle by triangle   | a in cell 7 | a in cell 8 | b in cell 7 | ...
///   length  of each cell's row        ...  7: 2   8: 1  ...
///
/// Small triangles on one face, most of all, are binned by their 8-DOP on the face; larger ones by 8-DOP
/// and edges; those on several faces by their projections on each. What is too near to the planes between
/// faces for that is clipped (CubeMap::visit_cells).
class CubeBinning {
 public:
  /// Borrows all; `placed` are the vertices.
  CubeBinning(PointsView vertices, std::span<const Triangle> triangles, const CubeMap& map,
              const PlacedVertices& placed);

  /// Lists all triangles.
  void bin();

  /// In the order of the triangles.
  void for_each_entry(const auto& visit) const {
    for (const auto& block : full_)
      for (const CellEntry& entry : block) visit(entry);
    for (const CellEntry& entry : std::span(entry_).first(count_)) visit(entry);
  }
  std::uint32_t length(Index cell) const noexcept { return length_[cell]; }
  /// Whether any triangle had to be clipped: then only where the vertices truly are has counted for it.
  bool has_clipped() const noexcept { return has_clipped_; }

 private:
  void reserve(std::size_t entries);
  void bin_larger(Index triangle);
  bool project_on_one_face(Index triangle);
  bool project_on_faces(Index triangle);
  /// Its corners are in their place already.
  void add_projected(Index triangle, int face);
  void bin_clipped(Index triangle);
  void bin_projected();
  Binning scratch() noexcept {
    return {.cells_per_side = n_,
            .entry = entry_.data(),
            .count = count_,
            .capacity = entry_.size(),
            .length = length_.data(),
            .elsewhere = nullptr,
            .elsewhere_count = 0};
  }

  PointsView vertices_;
  std::span<const Triangle> triangles_;
  const CubeMap& map_;
  PlacedVertices placed_;
  int n_;
  /// Blocks: entries of slender triangles are many more than can be foreseen, and moving them would take their memory twice.
  std::vector<core::UninitialisedVector<CellEntry>> full_;
  core::UninitialisedVector<CellEntry> entry_;
  std::size_t count_ = 0;  ///< in the block that is being filled
  std::vector<std::uint32_t> length_;
  /// Waiting to be binned, see ProjectedTriangles; vectors are read whole, beyond those that wait too.
  static constexpr std::size_t most_projected = 256;
  std::array<FaceCorners, most_projected + binning_padding> projected_u_{}, projected_w_{};
  std::array<std::uint32_t, most_projected> projected_triangle_;
  std::array<std::int32_t, most_projected> projected_face_;
  std::size_t projected_count_ = 0;
  bool has_clipped_ = false;
};

/// A mesh as the passes read it; its vertices in one place each are not given.
MeshView view_of(PointsView vertices, std::span<const Triangle> triangles) noexcept;

}  // namespace condyle::radial
