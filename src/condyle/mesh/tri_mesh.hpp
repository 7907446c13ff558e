#pragma once

#include <array>
#include <vector>

#include "condyle/core/pose.hpp"
#include "condyle/core/vec3.hpp"

namespace condyle {

/// Three vertex numbers, counter-clockwise seen from outside the solid.
using Triangle = std::array<Index, 3>;

/// A triangle mesh, owned. Vertices in millimetres once past the file readers; every index in range, every
/// coordinate finite (the readers see to both). Nothing else is promised: `inspect` tells what a mesh is fit
/// for.
struct TriMesh {
  Points vertices;
  std::vector<Triangle> triangles;

  Vec3 corner(std::size_t triangle, int k) const noexcept { return vertices[triangles[triangle][k]]; }

  friend bool operator==(const TriMesh&, const TriMesh&) = default;
};

/// The mesh with its vertices moved; same triangles.
inline TriMesh posed(const Pose& X, const TriMesh& mesh) {
  return {posed(X, mesh.vertices.view()), mesh.triangles};
}

}  // namespace condyle
