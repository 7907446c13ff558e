#pragma once

#include <vector>

#include "radial/build/cell_entries.hpp"

/// A table on the paper's map: each triangle in all cells of its box. Plain, as the paper fills it: a triangle is in more cells than
/// it meets, and is found there sooner.

namespace condyle::radial {

struct CartesianRows {
  CellEntries entries;
  std::vector<CartesianBox> box;  ///< of each triangle
};

/// Linear in triangles and cells.
void build(const TriMesh& mesh, const CartesianMap& map, CartesianRows& rows);

/// The vertices have moved: triangles whose box has changed leave the cells of the old one and come to those of the new. Linear:
/// measuring all boxes, and the rows of the cells that change.
void follow_vertices(const TriMesh& mesh, const CartesianMap& map, CartesianRows& rows);

}  // namespace condyle::radial
