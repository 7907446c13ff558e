#pragma once

#include "condyle/mesh.hpp"

namespace condyle::io {

/// The mesh grows by a prism of eight sides, open at both ends, from one point to the other; by nothing if they are one.
void add_line(TriMesh& mesh, const Vec3& from, const Vec3& to, double half_width_mm);

}  // namespace condyle::io
