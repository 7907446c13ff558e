#include "condyle/mesh/vertex_triangles.hpp"

#include <algorithm>

namespace condyle {

VertexTriangles::VertexTriangles(const TriMesh& mesh)
    : first_(mesh.vertices.size() + 1, 0), triangle_(3 * mesh.triangles.size()) {
  for (const Triangle& triangle : mesh.triangles)
    for (const Index v : triangle) ++first_[v + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  std::vector<Index> next = first_;
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    for (const Index v : mesh.triangles[t]) triangle_[next[v]++] = t;
}

std::vector<Index> VertexTriangles::of(std::span<const Index> vertices) const {
  std::vector<Index> triangles;
  for (const Index v : vertices) triangles.insert(triangles.end(), of(v).begin(), of(v).end());
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace condyle
