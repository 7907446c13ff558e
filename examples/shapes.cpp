#include "shapes.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace examples {

using condyle::Index;
using condyle::TriMesh;

TriMesh ball(double radius, Index rings) {
  const Index around = 2 * (rings + 1);
  TriMesh mesh;
  for (Index i = 1; i <= rings; ++i) {
    const double latitude = std::numbers::pi * i / (rings + 1);
    for (Index j = 0; j < around; ++j) {
      const double longitude = 2 * std::numbers::pi * j / around;
      mesh.vertices.push_back({radius * std::sin(latitude) * std::cos(longitude), radius * std::cos(latitude),
                               -radius * std::sin(latitude) * std::sin(longitude)});
    }
  }
  const Index top = rings * around, bottom = top + 1;
  mesh.vertices.push_back({0, radius, 0});
  mesh.vertices.push_back({0, -radius, 0});
  const auto at = [around](Index i, Index j) { return i * around + j % around; };
  for (Index j = 0; j < around; ++j) {
    mesh.triangles.push_back({top, at(0, j), at(0, j + 1)});
    mesh.triangles.push_back({bottom, at(rings - 1, j + 1), at(rings - 1, j)});
    for (Index i = 0; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

TriMesh sheet(double half, Index n) {
  TriMesh mesh;
  for (Index i = 0; i <= n; ++i)
    for (Index k = 0; k <= n; ++k)
      mesh.vertices.push_back({half * (2.0 * i / n - 1), 0, half * (2.0 * k / n - 1)});
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; k < n; ++k) {
      const Index a = i * (n + 1) + k, b = a + n + 1;
      mesh.triangles.push_back({a, a + 1, b});
      mesh.triangles.push_back({a + 1, b + 1, b});
    }
  }
  return mesh;
}

TriMesh socket(double radius) {
  TriMesh mesh = ball(2 * radius);
  const TriMesh cavity = ball(radius);
  const auto offset = static_cast<Index>(mesh.vertices.size());
  for (std::size_t i = 0; i < cavity.vertices.size(); ++i) mesh.vertices.push_back(cavity.vertices[i]);
  // The cavity's boundary is wound the other way: its outside is the hollow.
  for (const auto& [a, b, c] : cavity.triangles)
    mesh.triangles.push_back({a + offset, c + offset, b + offset});
  return mesh;
}

}  // namespace examples
