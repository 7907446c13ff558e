#include "answer/require_surface.hpp"

#include <algorithm>

#include "condyle/error.hpp"
#include "mesh/triangle_intersection.hpp"

namespace condyle {

void require_surface(const Mesh& mesh, const std::string& body) {
  if (mesh.triangles().empty()) throw MeshError(body + " has no triangle");
  const auto has_area = [&](const Triangle& t) {
    const mesh::TriangleCorners corners = {mesh.vertices()[t[0]], mesh.vertices()[t[1]],
                                           mesh.vertices()[t[2]]};
    return mesh::contains_coplanar(corners, corners[0]);  // without an area it contains nothing
  };
  if (std::none_of(mesh.triangles().begin(), mesh.triangles().end(), has_area))
    throw MeshError(body + " has no triangle with an area");
}

}  // namespace condyle
