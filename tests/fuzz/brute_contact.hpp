#pragma once

#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

namespace condyle::test {

/// Whether surfaces meet at the pose; a triangle that is degenerate is none there either, though rounding may give it an area.
bool surfaces_meet(const TriMesh& fixed, const TriMesh& mobile, const Pose& X);

/// Whether a corner of `a` is in the solid of `b`, an inside being what closed meshes have.
bool corner_inside(const TriMesh& a, const Mesh& b);

}  // namespace condyle::test
