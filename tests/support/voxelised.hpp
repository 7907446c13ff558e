#pragma once

#include <string>

#include "condyle/joint.hpp"
#include "condyle/label_surface.hpp"
#include "mesh/voxelise.hpp"

namespace condyle::test {

using mesh::voxelised;

/// A grid of these axes (steps from voxel to voxel, mm) that has a voxel centre at `through` and holds both meshes with `margin`
/// voxels to spare on each side.
VoxelGrid grid_around(const TriMesh& a, const TriMesh& b, const Eigen::Matrix3d& steps, const Vec3& through,
                      int margin = 4);

/// The surface of the mask as surface_of() makes it by default, with its image.
Body body_of(std::string name, const VoxelMask& mask);

}  // namespace condyle::test
