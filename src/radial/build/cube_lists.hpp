#pragma once

#include <span>

#include "radial/build/cell_lists.hpp"
#include "radial/build/cube_passes.hpp"

/// Steps of making the lists of a cube map, of which cell_lists.hpp has the whole.

namespace condyle::radial {

/// Rows and octagons of all triangles, for vertices anywhere between their places.
void list_all(const TriMesh& mesh, const CubeMap& map, const PlacedVertices& placed, CellLists& lists);

/// Where vertices are, the scale of their radii, and the forms and planes of all triangles.
void measure(const TriMesh& mesh, CellLists& lists);

/// Radii of those cells, on the scale that there is. Those of all entries are found and kept from the first
/// such call on.
ChangedRadii find_radii_in(const CubeMap& map, const TouchedTriangles& touched, CellLists& lists);

}  // namespace condyle::radial
