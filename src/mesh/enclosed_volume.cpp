#include "mesh/enclosed_volume.hpp"

#include <vector>

namespace condyle::mesh {

BoundingBox bounds_of_surface(const TriMesh& mesh) {
  if (mesh.triangles.empty()) return {Vec3::Zero(), Vec3::Zero()};
  std::vector<char> is_used(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (const Index v : t) is_used[v] = true;
  BoundingBox bounds{mesh.corner(0, 0), mesh.corner(0, 0)};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_used[v]) continue;
    bounds.low = bounds.low.cwiseMin(mesh.vertices[v]);
    bounds.high = bounds.high.cwiseMax(mesh.vertices[v]);
  }
  return bounds;
}

BoundingBox bounds_of_vertices(const TriMesh& mesh) {
  const Points& points = mesh.vertices;
  if (points.size() == 0) return {Vec3::Zero(), Vec3::Zero()};
  BoundingBox box{points[0], points[0]};
  for (std::size_t v = 0; v < points.size(); ++v) {
    box.low = box.low.cwiseMin(points[v]);
    box.high = box.high.cwiseMax(points[v]);
  }
  return box;
}

double enclosed_volume(const TriMesh& mesh) {
  const BoundingBox bounds = bounds_of_surface(mesh);
  const Vec3 centre = (bounds.low + bounds.high) / 2;
  CompensatedSum volume;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!names_a_vertex_twice(mesh.triangles[t])) volume.add(volume_below(mesh, t, centre));
  }
  return volume.value();
}

}  // namespace condyle::mesh
