#include "measure/near_part.hpp"

#include <array>
#include <vector>

#include "mesh/triangle_distance.hpp"

namespace condyle::measure {
namespace {

template <class Keep>
TriMesh kept_part(const TriMesh& mesh, const Keep& keep) {
  TriMesh part;
  std::vector<Index> number(mesh.vertices.size(), no_index);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!keep(t)) continue;
    Triangle triangle = mesh.triangles[t];
    for (Index& v : triangle) {
      if (number[v] == no_index) {
        number[v] = static_cast<Index>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[v]);
      }
      v = number[v];
    }
    part.triangles.push_back(triangle);
  }
  return part;
}

}  // namespace

TriMesh near_part(const TriMesh& mesh, const Sphere& ball) {
  std::vector<double> distance(mesh.vertices.size());
  for (std::size_t v = 0; v < distance.size(); ++v) distance[v] = (mesh.vertices[v] - ball.centre).norm();
  return kept_part(mesh, [&](std::size_t t) {
    const auto [i, j, k] = mesh.triangles[t];
    if (distance[i] < ball.radius || distance[j] < ball.radius || distance[k] < ball.radius) return true;
    // No point of a triangle is nearer than a corner by more than its longest edge.
    const std::array corners{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
    const double longest = std::max((corners[1] - corners[0]).norm(), (corners[2] - corners[0]).norm());
    if (distance[i] - longest > ball.radius) return false;
    return (mesh::nearest_on_triangle(ball.centre, corners) - ball.centre).norm() < ball.radius;
  });
}

TriMesh facing_part_of(const TriMesh& mesh, const Vec3& point) {
  return kept_part(mesh, [&](std::size_t t) {
    const Vec3 a = mesh.corner(t, 0);
    return (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).dot(a - point) < 0;
  });
}

}  // namespace condyle::measure
