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
  float least_squared = 0, greatest_squared = 0;  ///< of the radii of all cells

  /// For a cube map alone, for its vector code, which reads up to a vector beyond the last entry.
  UninitialisedVector<std::uint32_t> box, slant;  ///< CellOctagon of each entry
  UninitialisedVector<std::uint16_t>
      nearest;  ///< code of a squared radius that no point of its triangle is below
  UninitialisedVector<ConeForms> forms;
  UninitialisedVector<Vec3> corner;  ///< the mesh's vertices again, each in one place

  std::vector<float> inverse_length;  ///< of the directions to a face's cell corners, for listing

  /// Where the room of each row ends, once entries have moved: rows are then no longer in the order of cells.
  std::vector<std::uint32_t> row_end;

  std::span<const Index> of(Index cell) const noexcept {
    return {triangle.data() + row[cell].first, triangle.data() + row[cell].last};
  }
  std::size_t entry_count() const noexcept;
  std::size_t bytes() const noexcept;

  /// Room for so many entries and a vector beyond them.
  void resize_entries(std::size_t count);
  void set_entry(std::size_t at, Index triangle_listed, const CellOctagon& octagon,
                 int nearest_code) noexcept {
    triangle[at] = triangle_listed;
    box[at] = octagon.box;
    slant[at] = octagon.slant;
    nearest[at] = static_cast<std::uint16_t>(nearest_code);
  }
  /// Changes to single rows; linear in the row. The entry to remove is there, the one to add is not.
  void remove_entry(Index cell, Index triangle_listed) noexcept;
  void add_entry(Index cell, Index triangle_listed, const CellOctagon& octagon, int nearest_code);
};

/// Listed one by one: exact overlap of each cone with each cell.
CellLists list_cells(const TriMesh& mesh, const CartesianMap& map);

/// The same for a cube map, with octagons and forms, fast: a triangle that is small against a cell, on one
/// face, is listed by its octagon on the face.
///
/// Conservative in every step: triangles are widened by list_margin, and a cell's radii hold those of all
/// parts of its triangles within it.
CellLists list_cells(const TriMesh& mesh, const CubeMap& map);
/// Into the memory of lists that exist.
void list_cells(const TriMesh& mesh, const CubeMap& map, CellLists& lists);

/// Lists anew those triangles alone, whose corners before and after are meshes of as many triangles. Radii of
/// cells grow where needed and do not shrink; returns whether any grew. Linear in these triangles and the
/// rows that they are in.
bool move_triangles(const CubeMap& map, std::span<const Index> triangles, const TriMesh& before,
                    const TriMesh& after, CellLists& lists);

}  // namespace condyle
