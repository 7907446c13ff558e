#pragma once

#include "radial/build/cell_radii.hpp"

/// A cube table that follows its mesh's vertices.

namespace condyle::radial {

/// A slack rectangle for each vertex that holds it where it is, no more. To be called before vertices move;
/// does nothing if there is slack.
void init_slack(const TriMesh& mesh, CubeTable& table);

/// The vertices of a mesh have moved. Rows stay as they are where all three vertices of a triangle are in
/// their slack rectangles. A vertex that left its slack is given one that holds where it was and is, and a
/// sixteenth of a cell around that, so that what it does again costs nothing. Forms of triangles and radii of cells are out of
/// date then. Whether any row changed.
///
/// Linear: looking at all vertices, and binning the triangles at those that left their slack.
bool follow_rows(const TriMesh& mesh, const CubeMap& map, CubeTable& table);

/// The same for some vertices, with `triangles` all triangles at them; moves their corners too.
bool follow_rows(const TriMesh& mesh, const CubeMap& map, std::span<const Index> moved,
                 std::span<const Index> triangles, CubeTable& table);

/// The same, and measures the forms of these triangles. Radii, where they are given, are kept
/// current: those of the cells that these triangles are in are found. Costs what these triangles and the rows
/// they are in do.
ChangedRadii follow_vertices(const TriMesh& mesh, const CubeMap& map, std::span<const Index> moved,
                             std::span<const Index> triangles, CubeTable& table, CellRadii* radii);

}  // namespace condyle::radial
