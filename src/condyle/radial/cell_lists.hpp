#pragma once

#include "condyle/core/uninitialised.hpp"
#include "condyle/mesh/tri_mesh.hpp"
#include "condyle/radial/cube_view.hpp"
#include "condyle/radial/direction_map.hpp"

namespace condyle {

/// Which triangles can be met in each cell of a direction map, and between which radii.
///   row        [0,2) [2,2) [2,5)  ...      one entry per cell
///   triangle  | a b |     | c d e |  ...   cell i owns [row[i].first, row[i].last)
struct CellLists {
  UninitialisedVector<CellRow> row;
  UninitialisedVector<Index> triangle;
  std::vector<RadiusWord> radii;  ///< of each cell; no_radii where no triangle is met
  RadiusScale scale;

  /// For a cube map alone, for its vector code, which reads up to a vector beyond the last entry.
  UninitialisedVector<std::uint32_t> box, slant;  ///< CellOctagon of each entry
  UninitialisedVector<ConeForms> forms;
  UninitialisedVector<Vec3> corner;  ///< the mesh's vertices again, each in one place

  std::span<const Index> of(Index cell) const noexcept {
    return {triangle.data() + row[cell].first, triangle.data() + row[cell].last};
  }
  std::size_t bytes() const noexcept;
};

/// Listed one by one: exact overlap of each cone with each cell.
CellLists list_cells(const TriMesh& mesh, const CartesianMap& map);

/// The same for a cube map, with boxes and forms, fast: a triangle that is small against a cell, on one face,
/// is listed by its bounding box on the face.
///
/// Conservative in every step: triangles are widened by list_margin, and a cell's radii hold those of all
/// parts of its triangles within it.
CellLists list_cells(const TriMesh& mesh, const CubeMap& map);

}  // namespace condyle
