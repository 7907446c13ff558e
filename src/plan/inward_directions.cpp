#include "plan/inward_directions.hpp"

#include "core/ordered_sums.hpp"
#include "mesh/vertex_normals.hpp"

namespace condyle::plan {

std::vector<Vec3> inward_directions(const TriMesh& mesh, std::span<const Index> vertices,
                                    std::span<const Index> triangles, int means) {
  const Points normals = mesh::area_normals(mesh);
  std::vector<Vec3> inwards(mesh.vertices.size(), Vec3::Zero()), sum(inwards.size(), Vec3::Zero());
  for (const Index v : vertices) inwards[v] = -core::ordered_direction(normals[v]);
  for (int i = 0; i < means; ++i) {
    for (const Index v : vertices) sum[v] = inwards[v];
    for (const Index t : triangles) {
      const Triangle& corner = mesh.triangles[t];
      for (int k = 0; k < 3; ++k) sum[corner[k]] += inwards[corner[(k + 1) % 3]];
    }
    for (const Index v : vertices) inwards[v] = core::ordered_direction(sum[v]);
  }
  return inwards;
}

}  // namespace condyle::plan
