#pragma once

#include "method.hpp"

/// The methods of each source file of this folder. Those of packages are there only where CMake found them.

namespace bench {

/// Condyle's own.
std::vector<MethodKind> condyle_kinds();

/// Hierarchies of balls, in plain code of our own.
std::vector<MethodKind> sphere_tree_kinds();

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

}  // namespace bench
