#include "plan/inward_directions.hpp"

#include <algorithm>
#include <cstddef>

#include "core/ordered_sums.hpp"
#include "mesh/vertex_normals.hpp"

namespace condyle::plan {
namespace {

/// Means take so many steps over triangles at the most, some seconds: how far they reach in triangles of 0.1 mm is bounded.
constexpr std::size_t most_steps = 2'000'000'000;

}  // namespace

std::vector<Vec3> inward_directions(const TriMesh& mesh, std::span<const Index> vertices,
                                    std::span<const Index> triangles, int means) {
  const Points normals = mesh::area_normals(mesh);
  std::vector<Vec3> inwards(mesh.vertices.size(), Vec3::Zero()), sum(inwards.size(), Vec3::Zero());
  for (const Index v : vertices) inwards[v] = -core::ordered_direction(normals[v]);
  const auto most = most_steps / std::max<std::size_t>(1, triangles.size());
  for (std::size_t i = 0; i < std::min(static_cast<std::size_t>(means), most); ++i) {
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
