#include "kinematics/surface_points.hpp"

#include <algorithm>
#include <cmath>

namespace condyle::kinematics {

std::vector<SurfacePoint> surface_points(const TriMesh& mesh, const std::optional<Sphere>& within) {
  std::vector<Vec3> doubled_area(mesh.vertices.size(), Vec3::Zero());
  std::vector<double> area(mesh.vertices.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0);
    const Vec3 n = (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a);
    for (const Index v : mesh.triangles[t]) {
      doubled_area[v] += n;
      area[v] += n.norm() / 6;
    }
  }
  std::vector<SurfacePoint> points;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 p = mesh.vertices[v];
    const double length = doubled_area[v].norm();
    if (!(length > 0 && std::isfinite(length))) continue;
    if (within && (p - within->centre).norm() > within->radius) continue;
    points.push_back({static_cast<Index>(v), p, doubled_area[v] / length, area[v]});
  }
  return points;
}

std::vector<Index> largest_connected_part(const TriMesh& mesh, const std::vector<SurfacePoint>& points,
                                          const std::vector<Index>& chosen) {
  // Union-find over mesh vertices; every root is the smallest vertex of its part, so no order decides.
  std::vector<Index> parent(mesh.vertices.size(), no_index);
  for (const Index i : chosen) parent[points[i].vertex] = points[i].vertex;
  const auto root = [&](Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];
      if (parent[a] == no_index || parent[b] == no_index) continue;
      const Index ra = root(a), rb = root(b);
      parent[std::max(ra, rb)] = std::min(ra, rb);
    }
  }
  std::vector<double> area(mesh.vertices.size(), 0.0);
  for (const Index i : chosen) area[root(points[i].vertex)] += points[i].area;
  const auto largest = static_cast<Index>(std::max_element(area.begin(), area.end()) - area.begin());
  std::vector<Index> part;
  for (const Index i : chosen)
    if (root(points[i].vertex) == largest) part.push_back(i);
  return part;
}

std::vector<Index> vertices_of(const std::vector<SurfacePoint>& points, const std::vector<Index>& chosen) {
  std::vector<Index> vertices;
  vertices.reserve(chosen.size());
  for (const Index i : chosen) vertices.push_back(points[i].vertex);
  return vertices;
}

double robust_deviation(std::vector<double> residuals) {
  if (residuals.empty()) return 0;
  for (double& r : residuals) r = std::abs(r);
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return 1.4826 * *middle;
}

}  // namespace condyle::kinematics
