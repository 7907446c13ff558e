#pragma once

#include "method.hpp"

/// The methods of each source file of this folder. Those of packages are there only where CMake found them.

namespace bench {

/// Condyle's own.
std::vector<MethodKind> condyle_kinds();

/// Flexible Collision Library: hierarchies of boxes, slabs and swept rectangles.
std::vector<MethodKind> fcl_kinds();

/// Embree: rays between vertex and centre.
std::vector<MethodKind> embree_kinds();

/// OpenVDB: signed distance fields.
std::vector<MethodKind> openvdb_kinds();

/// Layered depth images: the fixed body drawn into entries and exits along one axis.
std::vector<MethodKind> layered_depth_kinds();

/// Rays from the joint centre, sampled over the sphere.
std::vector<MethodKind> spherical_sampling_kinds();

/// A dense grid of signed distances.
std::vector<MethodKind> dense_distance_kinds();

/// Spatial hashing of tetrahedra.
std::vector<MethodKind> spatial_hashing_kinds();

}  // namespace bench
