#include "condyle/mesh.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "condyle/error.hpp"
#include "core/coordinate_range.hpp"
#include "core/lazy.hpp"
#include "mesh/edge_balance.hpp"
#include "mesh/edge_table.hpp"
#include "mesh/findings.hpp"
#include "mesh/vertex_triangles.hpp"

namespace condyle {
namespace {

/// Vertex numbers are of 32 bits, of which the check for closedness needs one; half-edges, three per triangle,
/// are numbered in 32 bits too.
constexpr std::size_t most_vertices = std::size_t{1} << 31, most_triangles = no_index / 3;

void check_size(const char* what, std::size_t count, std::size_t most) {
  if (count >= most)
    throw MeshError(std::to_string(count) + " " + what + ", not fewer than " + std::to_string(most));
}

/// Whether the vertices are apart, and nowhere far enough.
bool is_too_small(const Points& points) {
  // The first two vertices of nearly every mesh are.
  if (points.size() > 1 && (points[1] - points[0]).cwiseAbs().maxCoeff() >= core::least_size) return false;
  double extent = 0;
  for (const auto* column : {&points.x, &points.y, &points.z}) {
    if (column->empty()) return false;
    const auto [low, high] = std::minmax_element(column->begin(), column->end());
    extent = std::max(extent, *high - *low);
  }
  return extent > 0 && extent < core::least_size;
}

void check_vertices(const Points& points) {
  if (points.y.size() != points.x.size() || points.z.size() != points.x.size())
    throw MeshError("coordinates are " + std::to_string(points.x.size()) + " x, " +
                    std::to_string(points.y.size()) + " y and " + std::to_string(points.z.size()) +
                    " z, not as many of each");
  check_size("vertices", points.size(), most_vertices);
  if (const auto v = core::first_out_of_range(points)) {
    const bool finite = points[*v].allFinite();
    throw MeshError("vertex " + std::to_string(*v) + " has a coordinate " +
                    (finite ? "beyond 1e30" : "that is not finite"));
  }
  if (is_too_small(points)) throw MeshError("the mesh is smaller than 1e-30, too small to compute with");
}

void check_triangles(const TriMesh& mesh) {
  check_size("triangles", mesh.triangles.size(), most_triangles);
  const std::size_t count = mesh.vertices.size();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Index v : mesh.triangles[t]) {
      if (v >= count)
        throw MeshError("triangle " + std::to_string(t) + " uses vertex " + std::to_string(v) + " of " +
                        std::to_string(count));
    }
  }
}

}  // namespace

std::string_view name_of(LengthUnit unit) noexcept {
  switch (unit) {
    case LengthUnit::millimetres:
      return "mm";
    case LengthUnit::centimetres:
      return "cm";
    case LengthUnit::inches:
      return "in";
    case LengthUnit::metres:
      break;
  }
  return "m";
}

std::string_view plural_of(LengthUnit unit) noexcept {
  switch (unit) {
    case LengthUnit::millimetres:
      return "millimetres";
    case LengthUnit::centimetres:
      return "centimetres";
    case LengthUnit::inches:
      return "inches";
    case LengthUnit::metres:
      break;
  }
  return "metres";
}

LengthUnit length_unit_named(std::string_view word) {
  std::string words;
  for (const LengthUnit unit : all_length_units) {
    if (name_of(unit) == word) return unit;
    words += (words.empty() ? "" : ", ") + std::string(name_of(unit));
  }
  throw UsageError("units: must be one of " + words + ", not '" + std::string(word) + "'");
}

/// What depends on the triangles alone: meshes that differ in where their vertices are share it.
struct Mesh::Connectivity {
  std::optional<DirectedEdge> unbalanced_edge;
  core::Lazy<std::optional<mesh::EdgeTable>> edges = {};
  core::Lazy<mesh::VertexTriangles> triangles_at_vertices = {};
};

struct Mesh::Checked {
  TriMesh arrays;
  std::shared_ptr<const Connectivity> connectivity;
  mutable mesh::Findings findings = {};
};

Mesh::Mesh(TriMesh arrays) {
  check_vertices(arrays.vertices);
  check_triangles(arrays);
  std::shared_ptr<const Connectivity> connectivity(new Connectivity{mesh::first_unbalanced_edge(arrays)});
  checked_ = std::shared_ptr<const Checked>(new Checked{std::move(arrays), std::move(connectivity)});
}

Mesh::Mesh(std::shared_ptr<const Checked> checked) noexcept : checked_(std::move(checked)) {}

Mesh Mesh::moved_to(Points vertices) const {
  check_vertices(vertices);
  if (vertices.size() != arrays().vertices.size())
    throw MeshError(std::to_string(vertices.size()) + " vertices in place of " +
                    std::to_string(arrays().vertices.size()));
  return Mesh(std::shared_ptr<const Checked>(
      new Checked{{std::move(vertices), arrays().triangles}, checked_->connectivity}));
}

const TriMesh& Mesh::arrays() const noexcept {
  return checked_->arrays;
}

const std::optional<DirectedEdge>& Mesh::unbalanced_edge() const noexcept {
  return checked_->connectivity->unbalanced_edge;
}

const mesh::EdgeTable& mesh::edges_of(const Mesh& mesh) {
  return *mesh.checked_->connectivity->edges.get([&](auto& edges) { edges.emplace(mesh); });
}

const mesh::VertexTriangles& mesh::triangles_at_vertices_of(const Mesh& mesh) {
  return mesh.checked_->connectivity->triangles_at_vertices.get(
      [&](auto& triangles) { triangles = VertexTriangles(mesh); });
}

mesh::Findings& mesh::findings_of(const Mesh& mesh) {
  return mesh.checked_->findings;
}

}  // namespace condyle
