#pragma once

#include <string>

#include "condyle/joint.hpp"
#include "condyle/voxel_mask.hpp"

namespace condyle::test {

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

/// A grid of these axes (steps from voxel to voxel, mm) that has a voxel centre at `through` and holds both meshes with `margin`
/// voxels to spare on each side.
VoxelGrid grid_around(const TriMesh& a, const TriMesh& b, const Eigen::Matrix3d& steps, const Vec3& through,
                      int margin = 4);

/// The surface of the mask as surface_of() makes it by default, with its image.
Body body_of(std::string name, const VoxelMask& mask);

}  // namespace condyle::test
