#pragma once

#include <cstddef>
#include <vector>

#include "condyle/mesh.hpp"

/// Repairs that lose nothing: the surface is the same set of points before and after. Each is requested by
/// name, changes the mesh in place and says what it did. Whatever would need a guess (filling holes, dropping
/// triangles, moving vertices) is not here.

namespace condyle {

/// For every point the number of the first one with the same coordinates, -0 being +0: its own number where
/// it is that first one. Coordinates must not be NaN. n log n.
std::vector<Index> first_of_same_coordinates(PointsView points);

/// Merges vertices whose coordinates are the same, -0 being +0, without any tolerance; the first of each
/// stays, in its place. Triangles stay, all of them. Returns how many vertices went.
std::size_t weld_exactly(TriMesh& mesh);

/// Drops vertices no triangle uses; the order of the others stays. Returns how many went.
std::size_t drop_unreferenced_vertices(TriMesh& mesh);

/// Flips a mesh of inverted orientation, by exchanging the last two corners of every triangle: each component closed
/// and of negative volume. Returns the number of triangles flipped: all, or none if no component is inverted. Raises
/// MeshError if the orientation cannot be determined (not closed) or if only some components are inverted: these may
/// be the boundaries of cavities, which are oriented like that.
std::size_t flip_inverted(TriMesh& mesh);

/// The three as values, for lists of them.
enum class Repair { weld, drop_unreferenced, flip_inverted };

/// A repair that was made: how many vertices went, or triangles were flipped.
struct RepairDone {
  Repair repair;
  std::size_t count;
};

/// Makes the repairs in this order. Raises MeshError if one cannot be made.
std::vector<RepairDone> repair_mesh(TriMesh& mesh, const std::vector<Repair>& repairs);

}  // namespace condyle
