#include "mesh/require_solid.hpp"

#include "condyle/error.hpp"
#include "condyle/inspect.hpp"
#include "mesh/doubled_triangles.hpp"
#include "mesh/enclosed_volume.hpp"

namespace condyle::mesh {
namespace {

std::string wound_against(Index from, Index to) {
  return "triangles wound against each other at the edge from vertex " + std::to_string(from) +
         " to vertex " + std::to_string(to);
}

}  // namespace

void require_solid(const Mesh& mesh, const std::string& name) {
  if (const auto& edge = mesh.unbalanced_edge()) {
    const MeshReport report = inspect(mesh);
    const std::string where =
        report.boundary_edges.count > 0 ? describe_boundary(report) : wound_against(edge->from, edge->to);
    throw MeshError(name + ": " + where +
                    ": the mesh has no inside; intersecting triangle pairs can still be computed");
  }
  if (is_two_sided(mesh)) throw MeshError(name + ": " + two_sided_text);
  if (is_inside_out(mesh))
    throw MeshError(name +
                    ": inverted orientation, its volume is negative; the repair flip_inverted turns it");
}

void require_oriented(const Mesh& mesh, const std::string& name) {
  if (mesh.is_closed()) return require_solid(mesh, name);
  if (const auto& edge = inspect(mesh).inconsistent_edges.first)
    throw MeshError(name + ": " + wound_against(edge->from, edge->to) + ": the surface has no outer side");
}

}  // namespace condyle::mesh
