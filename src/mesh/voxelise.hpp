#pragma once

#include "condyle/label_surface.hpp"
#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// The voxels of the grid whose centres are inside the mesh: where its winding number is not 0. The mask's box is the smallest that
/// holds the mesh, cut off where the grid ends.
///
///     k      __
///     |  ---/--\------>  A scanline through the centres of a row of voxels crosses the surface where a voxel's
///     |    |    \        inside begins and where it ends.
///     +----------- i
///
/// Vertices are rounded once, into the index space; after that, whether a scanline crosses is decided alike for all triangles of
/// an edge, so that nothing leaks. The mesh must be closed. Linear in the triangles, the crossings and the box.
VoxelMask voxelised(const TriMesh& mesh, const VoxelGrid& grid);

}  // namespace condyle::mesh
