#pragma once

#include <cstddef>

#include "condyle/mesh.hpp"

namespace condyle::io {

/// Appends a mesh to those before it.
inline void append_mesh(TriMesh& whole, const TriMesh& mesh) {
  const auto first = static_cast<Index>(whole.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) whole.vertices.push_back(mesh.vertices[v]);
  for (const auto& [a, b, c] : mesh.triangles) whole.triangles.push_back({a + first, b + first, c + first});
}

}  // namespace condyle::io
