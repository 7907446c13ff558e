#pragma once

#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

namespace condyle::test {

/// Whether any triangle is degenerate. Nothing defines whether its corners are inside a body.
bool has_degenerate(const TriMesh& mesh);

/// Whether surfaces meet at the pose; a triangle that is degenerate is none there either, though rounding may give it an area.
bool surfaces_meet(const TriMesh& fixed, const TriMesh& mobile, const Pose& X);

/// Whether a corner of `a` at the pose is in the solid of `b`, an inside being what closed meshes have; likewise without triangles that are
/// degenerate.
bool corner_inside(const TriMesh& a, const Pose& X, const Mesh& b);

}  // namespace condyle::test
