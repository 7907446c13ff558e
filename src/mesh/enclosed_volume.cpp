#include "mesh/enclosed_volume.hpp"

#include <cmath>
#include <vector>

#include "core/predicates.hpp"
#include "mesh/doubled_triangles.hpp"

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

/// Coordinates from the centre of the box are at most its half h. A triangle's term is a sixth of six products of three, each at most
/// h_x h_y h_z and rounded nine times, and a plain sum of n terms t is off by at most n u sum |t|, to first order; twice that is more.
bool is_inside_out(const TriMesh& mesh) {
  const BoundingBox box = bounds_of_vertices(mesh);
  const Vec3 centre = (box.low + box.high) / 2, half = (box.high - box.low) / 2;
  double volume = 0, sizes = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double term = volume_below(mesh, t, centre);
    volume += term, sizes += std::abs(term);
  }
  const double terms = static_cast<double>(mesh.triangles.size()),
               bound = 2 * terms * core::rounding_unit * (9 * half.prod() + sizes);
  return std::abs(volume) > bound + core::filter_floor ? volume < 0
                                                       : enclosed_volume(mesh) < 0 && !is_two_sided(mesh);
}

}  // namespace condyle::mesh
