#include "mesh/require_solid.hpp"

#include "condyle/error.hpp"
#include "condyle/inspect.hpp"
#include "mesh/edge_balance.hpp"

namespace condyle::mesh {

void require_solid(const TriMesh& mesh, const std::string& name) {
  const MeshReport report = inspect(mesh);
  if (const auto edge = unbalanced_edge(mesh)) {
    const std::string where = report.boundary_edges.count > 0
                                  ? describe_boundary(report)
                                  : "triangles wound against each other at the edge from vertex " +
                                        std::to_string(edge->first) + " to vertex " +
                                        std::to_string(edge->second);
    throw MeshError(name + ": " + where +
                    ": the mesh has no inside; intersecting triangle pairs can still be computed");
  }
  if (report.signed_volume && *report.signed_volume < 0) {
    throw MeshError(name + ": wound inside out, its volume is negative; the repair flip_inverted turns it");
  }
}

}  // namespace condyle::mesh
