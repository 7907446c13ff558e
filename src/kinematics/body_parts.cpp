#include <algorithm>

#include "condyle/error.hpp"
#include "condyle/joint.hpp"
#include "core/one_line.hpp"

namespace condyle {

Mesh mesh_of_part(const Body& body, std::string_view part) {
  const auto found = std::find_if(body.parts.begin(), body.parts.end(),
                                  [&](const BodyPart& known) { return known.name == part; });
  if (found == body.parts.end()) {
    std::string names;
    for (const BodyPart& known : body.parts) names += (names.empty() ? "" : ", ") + known.name;
    throw UsageError(body.name + " has no part \"" + core::one_line(part) + "\"" +
                     (names.empty() ? ": it is one mesh" : "; there are " + core::one_line(names, 2000)));
  }
  TriMesh mesh;
  for (std::size_t v = 0; v < found->vertices; ++v)
    mesh.vertices.push_back(body.mesh.vertices()[found->first_vertex + v]);
  const auto first = static_cast<Index>(found->first_vertex);
  for (std::size_t t = 0; t < found->triangles; ++t) {
    const auto [a, b, c] = body.mesh.triangles()[found->first_triangle + t];
    mesh.triangles.push_back({a - first, b - first, c - first});
  }
  return mesh;
}

bool has_part(const Body& body, PartContact contact) noexcept {
  return std::any_of(body.parts.begin(), body.parts.end(),
                     [&](const BodyPart& part) { return part.contact == contact; });
}

std::string_view name_of(PartContact contact) noexcept {
  switch (contact) {
    case PartContact::ends:
      return "ends";
    case PartContact::bearing:
      return "bearing";
    case PartContact::soft:
      break;
  }
  return "soft";
}

bool is_cut(const Body& body) noexcept {
  return std::any_of(body.parts.begin(), body.parts.end(),
                     [](const BodyPart& part) { return part.cut_triangles > 0; });
}

bool is_cut_face(const Body& body, std::size_t triangle) noexcept {
  const BodyPart* part = part_of_triangle(body, triangle);
  return part && triangle - part->first_triangle >= part->triangles - part->cut_triangles;
}

const BodyPart* part_of_vertex(const Body& body, std::size_t vertex) noexcept {
  for (const BodyPart& part : body.parts)
    if (vertex - part.first_vertex < part.vertices) return &part;
  return nullptr;
}

const BodyPart* part_of_triangle(const Body& body, std::size_t triangle) noexcept {
  for (const BodyPart& part : body.parts)
    if (triangle - part.first_triangle < part.triangles) return &part;
  return nullptr;
}

}  // namespace condyle
