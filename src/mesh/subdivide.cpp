#include "mesh/subdivide.hpp"

#include "core/parallel.hpp"
#include "mesh/edge_table.hpp"

namespace condyle::mesh {
TriMesh subdivided(const TriMesh& mesh) {
  return subdivided(mesh, [](const Vec3& midpoint) { return midpoint; });
}

TriMesh subdivided(const TriMesh& mesh, const std::function<Vec3(const Vec3&)>& place) {
  const EdgeTable edges(mesh);
  const std::size_t old_count = mesh.vertices.size();

  TriMesh finer;
  finer.vertices = Points(old_count + edges.size());
  for (std::size_t i = 0; i < old_count; ++i) finer.vertices.set(i, mesh.vertices[i]);
  constexpr std::size_t grain = 256;
  core::parallel_chunks(edges.size(), grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) {
      const Vec3 midpoint = (mesh.vertices[edges.ends(e)[0]] + mesh.vertices[edges.ends(e)[1]]) / 2;
      finer.vertices.set(old_count + e, place(midpoint));
    }
  });

  const auto middle = [&](HalfEdge h) {
    const Index edge = edges.edge_of(h);
    return edge == no_index ? mesh.triangles[h / 3][h % 3] : static_cast<Index>(old_count + edge);
  };
  finer.triangles.reserve(4 * mesh.triangles.size());
  for (HalfEdge side = 0; side < 3 * mesh.triangles.size(); side += 3) {
    const auto [a, b, c] = mesh.triangles[side / 3];
    const Index ab = middle(side), bc = middle(side + 1), ca = middle(side + 2);
    finer.triangles.insert(finer.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return finer;
}

}  // namespace condyle::mesh
