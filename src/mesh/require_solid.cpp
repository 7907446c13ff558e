#include "mesh/require_solid.hpp"

#include "condyle/error.hpp"
#include "condyle/inspect.hpp"
#include "mesh/enclosed_volume.hpp"

namespace condyle::mesh {

void require_solid(const Mesh& mesh, const std::string& name) {
  if (const auto& edge = mesh.unbalanced_edge()) {
    const MeshReport report = inspect(mesh);
    const std::string where = report.boundary_edges.count > 0
                                  ? describe_boundary(report)
                                  : "triangles wound against each other at the edge from vertex " +
                                        std::to_string(edge->from) + " to vertex " + std::to_string(edge->to);
    throw MeshError(name + ": " + where +
                    ": the mesh has no inside; intersecting triangle pairs can still be computed");
  }
  if (enclosed_volume(mesh) < 0)
    throw MeshError(name +
                    ": inverted orientation, its volume is negative; the repair flip_inverted turns it");
}

}  // namespace condyle::mesh
