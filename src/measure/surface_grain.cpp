#include "measure/surface_grain.hpp"

#include <algorithm>
#include <cmath>

#include "core/formatted.hpp"

namespace condyle::measure {

SurfaceGrain grain_of(const TriMesh& mesh, const std::vector<Index>& vertices, const Vec3& centre) {
  std::vector<char> is_in(mesh.vertices.size());
  for (const Index v : vertices) is_in[v] = 1;
  std::vector<double> distance(mesh.vertices.size()), of_neighbours(distance.size()),
      neighbours(distance.size());
  for (const Index v : vertices) distance[v] = (mesh.vertices[v] - centre).norm();
  double area = 0, edges = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& corners = mesh.triangles[t];
    if (!is_in[corners[0]] || !is_in[corners[1]] || !is_in[corners[2]]) continue;
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    const double size = (b - a).cross(c - a).norm() / 2;
    area += size, edges += size * std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3})
        of_neighbours[corners[k]] += distance[corners[other]], ++neighbours[corners[k]];
  }
  SurfaceGrain grain;
  if (area > 0) grain.edge_mm = edges / area;
  double squares = 0, count = 0;
  for (const Index v : vertices) {
    if (neighbours[v] == 0) continue;
    const double off = distance[v] - of_neighbours[v] / neighbours[v];
    // The mean of six neighbours has a sixth of a vertex's variance.
    squares += off * off / (1 + 1.0 / 6), ++count;
  }
  if (count > 0) grain.roughness_mm = std::sqrt(squares / count);
  return grain;
}

std::string alpha_grain_note(const SurfaceGrain& head, double radius) {
  if (head.roughness_mm > by_head(rough_mm, radius))
    return core::formatted("the head is rough by %.2f mm", head.roughness_mm);
  if (head.edge_mm > by_head(coarse_edge_mm, radius))
    return core::formatted("the head's triangles of %.1f mm sag by %.2f mm", head.edge_mm,
                           head.edge_mm * head.edge_mm / (8 * radius));
  return {};
}

}  // namespace condyle::measure
