#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "condyle/pose.hpp"

namespace condyle {

/// The unit in which a file gives lengths. Inside the library everything is millimetres.
enum class LengthUnit : std::uint8_t { millimetres, centimetres, inches, metres };
inline constexpr LengthUnit all_length_units[] = {LengthUnit::millimetres, LengthUnit::centimetres,
                                                  LengthUnit::inches, LengthUnit::metres};

[[nodiscard]] constexpr double mm_per(LengthUnit unit) noexcept {
  return unit == LengthUnit::metres        ? 1000
         : unit == LengthUnit::inches      ? 25.4
         : unit == LengthUnit::centimetres ? 10
                                           : 1;
}

/// As in files: "cm".
[[nodiscard]] std::string_view name_of(LengthUnit unit) noexcept;
/// In a sentence: "centimetres".
[[nodiscard]] std::string_view plural_of(LengthUnit unit) noexcept;
/// Throws UsageError that lists the valid words.
[[nodiscard]] LengthUnit length_unit_named(std::string_view word);

class Mesh;
namespace mesh {
class EdgeTable;
class VertexTriangles;
class Findings;
[[nodiscard]] const EdgeTable& edges_of(const Mesh& mesh);
[[nodiscard]] const VertexTriangles& triangles_at_vertices_of(const Mesh& mesh);
[[nodiscard]] Findings& findings_of(const Mesh& mesh);
}  // namespace mesh

/// Three vertex numbers, counter-clockwise seen from outside the solid.
using Triangle = std::array<Index, 3>;

/// Plain arrays of a triangle mesh, anybody's to fill. Vertices in millimetres once past the file readers.
/// Nothing is promised of them; what computes with a mesh asks for a `Mesh`, which is checked.
struct TriMesh {
  Points vertices;
  std::vector<Triangle> triangles;

  [[nodiscard]] Vec3 corner(std::size_t triangle, int k) const noexcept {
    return vertices[triangles[triangle][k]];
  }

  friend bool operator==(const TriMesh&, const TriMesh&) = default;
};

/// The mesh with its vertices moved; same triangles.
[[nodiscard]] inline TriMesh posed(const Pose& X, const TriMesh& mesh) {
  return {posed(X, mesh.vertices.view()), mesh.triangles};
}

/// An edge as a triangle runs along it.
struct DirectedEdge {
  Index from, to;

  friend bool operator==(const DirectedEdge&, const DirectedEdge&) = default;
};

/// A triangle mesh that has come through the one door: every index in range, every coordinate finite and at most 1e30, its
/// vertices in one place or apart by at least 1e-30 along an axis, and known to be closed or not. Tables are made of nothing else. Immutable and shared: a
/// copy costs a pointer.
class Mesh {
 public:
  /// Checks the arrays, which are taken over. Raises MeshError naming the first bad element ("triangle 812
  /// uses vertex 40991 of 40000"). Not explicit: every function that takes a Mesh checks its argument. Linear for a
  /// closed mesh.
  Mesh(TriMesh arrays);

  [[nodiscard]] const TriMesh& arrays() const noexcept;
  [[nodiscard]] const Points& vertices() const noexcept { return arrays().vertices; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const noexcept { return arrays().triangles; }
  [[nodiscard]] Vec3 corner(std::size_t triangle, int k) const noexcept {
    return arrays().corner(triangle, k);
  }

  /// Whether every edge is used as often in one direction as in the other: then the surface has an inside, in the
  /// sense of the winding number. Neither manifoldness nor freedom from self-intersections is required.
  [[nodiscard]] bool is_closed() const noexcept { return !unbalanced_edge().has_value(); }
  /// The first directed edge, in the order of triangles, that is used more often than its opposite.
  [[nodiscard]] const std::optional<DirectedEdge>& unbalanced_edge() const noexcept;

  /// The same triangles with other vertex positions. What depends on the triangles alone is shared and not computed again:
  /// whether the mesh is closed, its edges, the triangles at each vertex. Raises MeshError if the number of vertices differs,
  /// and as the constructor does.
  [[nodiscard]] Mesh moved_to(Points vertices) const;

  operator const TriMesh&() const noexcept { return arrays(); }

 private:
  struct Connectivity;
  struct Checked;
  friend const mesh::EdgeTable& mesh::edges_of(const Mesh& mesh);
  friend const mesh::VertexTriangles& mesh::triangles_at_vertices_of(const Mesh& mesh);
  friend mesh::Findings& mesh::findings_of(const Mesh& mesh);

  explicit Mesh(std::shared_ptr<const Checked> checked) noexcept;
  std::shared_ptr<const Checked> checked_;
};

}  // namespace condyle
