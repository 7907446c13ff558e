#include "answer/depth_meshes.hpp"

#include <string>
#include <string_view>

#include "condyle/inspect.hpp"
#include "mesh/require_solid.hpp"

namespace condyle::answer {
namespace {

void require_depth_mesh(const Mesh& mesh, DepthMethod method, std::string_view body) {
  const std::string name(body);
  if (method == DepthMethod::normal) return mesh::require_oriented(mesh, name);
  try {
    mesh::require_solid(mesh, name);
  } catch (const MeshError& error) {
    throw NoSolidError(error, !mesh.is_closed() && inspect(mesh).inconsistent_edges.count == 0);
  }
}

}  // namespace

void require_depth_meshes(const Joint& joint, DepthMethod method, const motion::BodyNames& names) {
  require_depth_mesh(joint.fixed.mesh, method, names.fixed);
  require_depth_mesh(joint.mobile.mesh, method, names.mobile);
}

}  // namespace condyle::answer
