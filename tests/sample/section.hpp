#pragma once

#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::test {

/// One closed loop in which a plane cuts a closed mesh. The area is positive for an outer border.
struct SectionLoop {
  double area;
  Vec3 centroid;
};

/// Every loop in the plane normal . p = offset; `normal` of length one.
std::vector<SectionLoop> section(const TriMesh& mesh, const Vec3& normal, double offset);

/// The loop whose centroid is nearest to p.
SectionLoop section_near(const TriMesh& mesh, const Vec3& normal, const Vec3& p);

}  // namespace condyle::test
