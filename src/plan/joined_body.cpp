#include "plan/joined_body.hpp"

#include <utility>

namespace condyle::plan {
namespace {

void append(TriMesh& whole, const TriMesh& mesh) {
  const auto first = static_cast<Index>(whole.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) whole.vertices.push_back(mesh.vertices[v]);
  for (const auto& [a, b, c] : mesh.triangles) whole.triangles.push_back({a + first, b + first, c + first});
}

}  // namespace

Body joined_body(const std::string& name, const std::vector<ImplantMesh>& parts) {
  TriMesh whole;
  Body body{name, TriMesh{}};
  for (const auto& [part, mesh] : parts) {
    if (parts.size() > 1)
      body.parts.push_back(
          {part, whole.vertices.size(), mesh.vertices.size(), whole.triangles.size(), mesh.triangles.size()});
    append(whole, mesh);
  }
  body.mesh = Mesh(std::move(whole));
  return body;
}

}  // namespace condyle::plan
