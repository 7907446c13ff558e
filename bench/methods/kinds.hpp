#pragma once

#include "method.hpp"

/// The methods of each source file of this folder. Those of packages are there only where CMake found them.

namespace bench {

/// Condyle's own.
std::vector<MethodKind> condyle_kinds();

/// Hierarchies of balls, in plain code of our own.
std::vector<MethodKind> sphere_tree_kinds();

/// A hierarchy of boxes, updated by halves, in plain code of our own.
std::vector<MethodKind> hybrid_tree_kinds();

/// Hierarchies of spherical shells, in plain code of our own.
std::vector<MethodKind> spherical_shell_kinds();

/// Flexible Collision Library: hierarchies of boxes, slabs and swept rectangles.
std::vector<MethodKind> fcl_kinds();

/// Computational Geometry Algorithms Library: trees of boxes with exact predicates.
std::vector<MethodKind> cgal_kinds();

/// Visualization Toolkit: distance to a surface, and its filter for collisions.
std::vector<MethodKind> vtk_kinds();

/// Bullet: GImpact meshes.
std::vector<MethodKind> bullet_kinds();

/// Open Dynamics Engine: triangle meshes.
std::vector<MethodKind> ode_kinds();

/// Simbody: contact of triangle meshes as in musculoskeletal models.
std::vector<MethodKind> simbody_kinds();

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
