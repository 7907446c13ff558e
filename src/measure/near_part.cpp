#include "measure/near_part.hpp"

#include <algorithm>
#include <array>

#include "mesh/triangle_distance.hpp"

namespace condyle::measure {
namespace {

template <class Keep>
MeshPart kept_part(const TriMesh& mesh, const Keep& keep) {
  MeshPart part;
  std::vector<Index> number(mesh.vertices.size(), no_index);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!keep(t)) continue;
    Triangle triangle = mesh.triangles[t];
    for (Index& v : triangle) {
      if (number[v] == no_index) {
        number[v] = static_cast<Index>(part.vertices.size());
        part.vertices.push_back(v);
        part.mesh.vertices.push_back(mesh.vertices[v]);
      }
      v = number[v];
    }
    part.mesh.triangles.push_back(triangle);
  }
  return part;
}

/// Whether triangles reach into a ball.
class Reach {
 public:
  Reach(const TriMesh& mesh, const Sphere& ball) : mesh_(mesh), ball_(ball), distance_(mesh.vertices.size()) {
    for (std::size_t v = 0; v < distance_.size(); ++v) distance_[v] = (mesh.vertices[v] - ball.centre).norm();
  }

  bool operator()(std::size_t t) const {
    const auto [i, j, k] = mesh_.triangles[t];
    const double radius = ball_.radius;
    if (distance_[i] < radius || distance_[j] < radius || distance_[k] < radius) return true;
    // No point of a triangle is nearer than a corner by more than the longer edge from it.
    const std::array corners{mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
    const double longest = std::max((corners[1] - corners[0]).norm(), (corners[2] - corners[0]).norm());
    if (distance_[i] - longest > radius) return false;
    return (mesh::nearest_on_triangle(ball_.centre, corners) - ball_.centre).norm() < radius;
  }

 private:
  const TriMesh& mesh_;
  Sphere ball_;
  std::vector<double> distance_;
};

/// Below 0 if the triangle faces the point.
double averted(const TriMesh& mesh, std::size_t t, const Vec3& point) {
  const Vec3 a = mesh.corner(t, 0);
  return (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).dot(a - point);
}

}  // namespace

MeshPart near_part(const TriMesh& mesh, const Sphere& ball) {
  return kept_part(mesh, Reach(mesh, ball));
}

MeshPart facing_part(const TriMesh& mesh, const Sphere& ball) {
  const Reach reaches(mesh, ball);
  return kept_part(mesh, [&](std::size_t t) { return averted(mesh, t, ball.centre) < 0 && reaches(t); });
}

MeshPart averted_part(const TriMesh& mesh, const Sphere& ball) {
  const Reach reaches(mesh, ball);
  return kept_part(mesh, [&](std::size_t t) { return averted(mesh, t, ball.centre) > 0 && reaches(t); });
}

}  // namespace condyle::measure
