#pragma once

#include "condyle/mesh.hpp"
#include "core/uninitialised.hpp"
#include "radial/build/cube_passes.hpp"
#include "radial/exact/direction_map.hpp"
#include "radial/query/cube_view.hpp"

namespace condyle::radial {

/// Which triangles can be met in each cell of a direction map, and between which radii.
///   row        [0,2) [2,2) [2,5)  ...      one entry per cell
///   triangle  | a b |     | c d e |  ...   cell i owns [row[i].first, row[i].last)
struct CellLists {
  /// Entries beyond the last one that vector code may read: a vector that starts on it, and one fetched
  /// ahead.
  static constexpr std::size_t entries_beyond = 32;

  core::UninitialisedVector<CellRow> row;
  core::UninitialisedVector<Index> triangle;
  std::vector<RadiusWord> radii;  ///< of each cell; no_radii where no triangle is met
  RadiusScale scale;
  float least_squared = 0, greatest_squared = 0;  ///< of the radii of all cells

  /// For a cube map alone, for its vector code, which reads beyond the last entry.
  core::UninitialisedVector<std::uint32_t> box, slant;  ///< CellOctagon of each entry
  core::UninitialisedVector<std::uint8_t>
      nearest;  ///< upper half of the code of its triangle's least squared radius
  core::UninitialisedVector<RadiusWord>
      entry_radii;  ///< of each entry's triangle in its cell; kept once single triangles have changed
  core::UninitialisedVector<ConeForms> forms;
  core::UninitialisedVector<TrianglePlane>
      plane;  ///< of each triangle, from when it is measured until radii are found
  core::UninitialisedVector<Vec3> corner;  ///< the mesh's vertices again, each in one place
  std::vector<float> inverse_length;       ///< of the directions to a face's cell corners
  std::vector<std::uint32_t> unknown;      ///< triangles whose forms were no numbers when all were measured
  bool starts_at_centre = false;           ///< No radius is too small: the centre is inside.

  /// Where each vertex may be without its triangles being listed anew; none until they first move, while
  /// lists hold the triangles just where they are.
  core::UninitialisedVector<std::uint8_t> face;
  core::UninitialisedVector<FaceRoom> room;
  bool has_clipped = false;  ///< Some triangles are listed where they are, whatever the rooms.

  /// Where the room of each row ends, once entries have moved: rows are then no longer in the order of cells.
  std::vector<std::uint32_t> row_end;

  std::span<const Index> of(Index cell) const noexcept {
    return {triangle.data() + row[cell].first, triangle.data() + row[cell].last};
  }
  std::size_t entry_count() const noexcept;
  std::size_t bytes() const noexcept;

  /// Room for so many entries and a vector beyond them.
  void resize_entries(std::size_t count);
  void set_entry(std::size_t at, Index triangle_listed, const CellOctagon& octagon) noexcept {
    triangle[at] = triangle_listed;
    box[at] = octagon.box;
    slant[at] = octagon.slant;
  }
  void move_entry(std::size_t from, std::size_t to) noexcept;
  /// Sorts long rows by halves of their cells. Linear in their entries.
  void split_rows();
  /// Changes to single rows, which are whole then; linear in the row. The entry to remove is there, the one
  /// to add is not.
  void remove_entry(Index cell, Index triangle_listed) noexcept;
  void add_entry(Index cell, Index triangle_listed, const CellOctagon& octagon);
};

/// Listed one by one: exact overlap of each cone with each cell.
CellLists list_cells(const TriMesh& mesh, const CartesianMap& map);

/// The same for a cube map, with octagons and forms, fast: a triangle that is small against a cell, on one
/// face, is listed by its octagon on the face.
///
/// Conservative in every step: triangles are widened by list_margin, and a cell's radii hold those of all
/// parts of its triangles within it.
CellLists list_cells(const TriMesh& mesh, const CubeMap& map);
/// All but the radii of the cells, into the memory of lists that exist.
void list_cells(const TriMesh& mesh, const CubeMap& map, CellLists& lists);
/// Least and greatest radius in each cell, and the nearest one of each entry; those of each entry where they
/// are kept. Linear in entries.
void find_radii(const CubeMap& map, CellLists& lists);

/// Rooms that hold each vertex where it is, no more. To be called before vertices move; does nothing where
/// there are rooms.
void make_rooms(const TriMesh& mesh, CellLists& lists);

/// The vertices of a mesh have moved. Lists stay as they are where all three vertices of a triangle are in
/// their rooms. A vertex that has left its room is given one that holds where it was and is, and a sixteenth
/// of a cell around that, so that what it does again costs nothing. Radii of cells are not found again.
///
/// Linear: measuring all triangles, and listing those at vertices that left their rooms.
void follow_vertices(const TriMesh& mesh, const CubeMap& map, CellLists& lists);

/// Cells whose radii are others than before: those named, or perhaps all.
struct ChangedRadii {
  bool may_be_all = false;
  std::vector<Index> cells = {};
};

/// The same for some vertices, with `triangles` all triangles at them; finds the radii of the cells that
/// these are in. Costs what these triangles and the rows they are in do.
ChangedRadii follow_vertices(const TriMesh& mesh, const CubeMap& map, std::span<const Index> moved,
                             std::span<const Index> triangles, CellLists& lists);

}  // namespace condyle::radial
