#include "mesh/subdivide.hpp"

#include <algorithm>
#include <utility>

#include "core/parallel.hpp"

namespace condyle::mesh {
namespace {

using Edge = std::pair<Index, Index>;

/// Each edge once, smaller vertex first, ascending.
std::vector<Edge> edges_of(const TriMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

TriMesh subdivided(const TriMesh& mesh) {
  return subdivided(mesh, [](const Vec3& midpoint) { return midpoint; });
}

TriMesh subdivided(const TriMesh& mesh, const std::function<Vec3(const Vec3&)>& place) {
  const std::vector<Edge> edges = edges_of(mesh);
  const std::size_t old_count = mesh.vertices.size();

  TriMesh finer;
  finer.vertices = Points(old_count + edges.size());
  for (std::size_t i = 0; i < old_count; ++i) finer.vertices.set(i, mesh.vertices[i]);
  constexpr std::size_t grain = 256;
  core::parallel_chunks(edges.size(), grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) {
      const Vec3 midpoint = (mesh.vertices[edges[e].first] + mesh.vertices[edges[e].second]) / 2;
      finer.vertices.set(old_count + e, place(midpoint));
    }
  });

  const auto middle = [&](Index a, Index b) {
    const auto at = std::lower_bound(edges.begin(), edges.end(), Edge(std::minmax(a, b)));
    return static_cast<Index>(old_count + static_cast<std::size_t>(at - edges.begin()));
  };
  finer.triangles.reserve(4 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.triangles.insert(finer.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return finer;
}

}  // namespace condyle::mesh
