#include "sample/solid_mesh.hpp"

#include <cmath>

#include "mesh/subdivide.hpp"
#include "sample/contour.hpp"
#include "sample/projection.hpp"

namespace condyle::sample {

TriMesh meshed(const Solid& solid, const Meshing& meshing, std::size_t triangles) {
  std::size_t base = triangles, levels = 0;
  while (base / 4 >= meshing.least_base) base /= 4, ++levels;
  base -= base % 2;

  // F = 2 (V - 2 + 2 g) for a closed manifold of genus g.
  const TriMesh start = contoured(solid, meshing.contour_spacing);
  const auto vertices_for = [handles = genus(start)](std::size_t count) {
    return static_cast<std::size_t>(static_cast<long>(count / 2) + 2 - 2 * handles);
  };
  TriMesh mesh = remeshed(start, solid.field, meshing.sizing, vertices_for(base));
  for (std::size_t level = 0; level < levels; ++level) {
    mesh = mesh::subdivided(mesh, [&](const Vec3& midpoint) { return laid_on(solid.field, midpoint).point; });
  }
  if (mesh.triangles.size() == triangles) return mesh;
  return refined(mesh, solid.field, meshing.sizing, vertices_for(triangles));
}

std::size_t triangles_for(const Solid& solid, const Meshing& meshing, double edge_length) {
  const TriMesh start = contoured(solid, meshing.contour_spacing);
  const double per_triangle = std::sqrt(3.0) / 4 * edge_length * edge_length;
  return 2 * static_cast<std::size_t>(std::ceil(sized_area(start, meshing.sizing) / per_triangle / 2));
}

int genus(const TriMesh& mesh) {
  // V - E + F = 2 - 2 g, with E = 3 F / 2.
  const auto vertices = static_cast<long>(mesh.vertices.size()),
             triangles = static_cast<long>(mesh.triangles.size());
  return static_cast<int>((2 - vertices + triangles / 2) / 2);
}

}  // namespace condyle::sample
