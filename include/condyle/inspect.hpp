#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle {

/// Two vertices joined by a triangle's side; `from` before `to` in the first triangle that has it.
struct Edge {
  Index from, to;

  friend bool operator==(const Edge&, const Edge&) = default;
};

/// How many elements have a defect, and the first of them in the mesh's order.
template <class Element>
struct Finding {
  std::size_t count = 0;
  std::optional<Element> first;

  void add(const Element& element) {
    if (count++ == 0) first = element;
  }
};

/// A connected run of edges that have one triangle only: the rim of a hole or of an open sheet. A plain ring
/// where no vertex has more than two of these edges; rings that touch in a vertex count as one.
struct BoundaryLoop {
  std::size_t edges;
  Edge first;   ///< The first of them in the mesh's order.
  Vec3 centre;  ///< Mean of the edges' middles: where to look for it.
};

/// Two triangles of one mesh, the smaller number first.
struct TriangleCrossing {
  Index first, second;

  friend bool operator==(const TriangleCrossing&, const TriangleCrossing&) = default;
};

struct BoundingBox {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();

  [[nodiscard]] double diagonal() const { return (high - low).norm(); }
};

/// Triangles that hang together over edges, two triangles' or more. Solids that touch in a vertex are two
/// components.
struct MeshComponent {
  Index first_triangle = 0;
  std::size_t triangles = 0;
  /// Every edge is used as often in one direction as in the other.
  bool closed = true;
  /// Number of handles, where closed and without non-manifold edges; a vertex counts once for each of its fans.
  std::optional<int> genus;
  /// Where closed; negative when inverted, as the boundary of a cavity is.
  std::optional<double> signed_volume;
  BoundingBox bounds{};
  /// The component that most of it lies inside, whichever way the two are wound; number in `components`.
  std::optional<Index> inside = {};
};

struct EdgeLengths {
  double shortest, median, longest;
};

struct LikelyUnit {
  std::optional<LengthUnit> unit;  ///< Empty: the size fits neither.
  std::string reason;              ///< One line, with the size that decided.
};

/// Properties and faults of a mesh. Lengths are in the mesh's unit; elements are counted from 0.
///
/// A triangle that names a vertex twice has no sides of its own: it counts as degenerate and stays out of
/// edges, boundaries and components. The bounds are those of the surface: vertices without a triangle do not
/// widen them.
struct MeshReport {
  std::size_t vertices = 0, triangles = 0;

  /// One triangle.
  Finding<Edge> boundary_edges;
  Finding<BoundaryLoop> boundary_loops;
  /// Three triangles or more.
  Finding<Edge> non_manifold_edges;
  /// Its triangles, joined over the edges they share, are more than one fan.
  Finding<Index> non_manifold_vertices;
  /// Two triangles that run along it in one direction: wound differently.
  Finding<Edge> inconsistent_edges;
  /// Used more often in one direction than in the other: all boundary and inconsistent edges, and those
  /// non-manifold ones that keep the mesh from being closed.
  Finding<Edge> unbalanced_edges;
  /// If every triangle is there twice, once in each sense, a line that says so; else empty.
  std::string two_sided = {};
  /// Has the three vertices of an earlier one, in any order.
  Finding<Index> duplicate_triangles;
  /// A vertex twice, or an area of exactly zero.
  Finding<Index> degenerate_triangles;
  /// In no triangle.
  Finding<Index> unreferenced_vertices;
  /// Has the coordinates of an earlier one, -0 being +0.
  Finding<Index> duplicate_vertices;
  /// Closed, with negative volume; numbers in `components`.
  Finding<Index> inverted_components;
  /// Share a point and no vertex.
  Finding<TriangleCrossing> self_crossings;

  std::vector<MeshComponent> components;  ///< By first triangle.

  BoundingBox bounds{};
  double area = 0;
  std::optional<double> signed_volume;  ///< Where closed.
  EdgeLengths edge_lengths{0, 0, 0};
  LikelyUnit likely_unit;

  /// As Mesh::is_closed: every edge is used as often in one direction as in the other. The surface then has an
  /// inside, if perhaps an inverted one. Neither self-intersections nor non-manifold edges and vertices matter
  /// to that.
  [[nodiscard]] bool is_closed() const noexcept { return unbalanced_edges.count == 0; }
};

/// Looks at everything once, in n log n unless it crosses itself all over.
[[nodiscard]] MeshReport inspect(const Mesh& mesh);

/// The report's guess of the unit, without the rest of it. Linear.
[[nodiscard]] LikelyUnit likely_unit(const TriMesh& mesh);

/// The first boundary loop in words, for the message that refuses an open mesh: "an open boundary of 14 edges
/// near (12.1, -3, 44.9), from vertex 812 (the first of 3)". Empty for a mesh without boundary.
[[nodiscard]] std::string describe_boundary(const MeshReport& report);

// Repairs that lose nothing: the surface is the same set of points before and after. Each is requested by
// name, changes the mesh in place and says what it did. Whatever would need a guess (filling holes, dropping
// triangles, moving vertices) is not here.

/// For every point the number of the first one with the same coordinates, -0 being +0: its own number where
/// it is that first one. Coordinates must not be NaN. n log n.
[[nodiscard]] std::vector<Index> first_of_same_coordinates(PointsView points);

/// Merges vertices whose coordinates are the same, -0 being +0, without any tolerance; the first of each
/// stays, in its place. Triangles stay, all of them. Returns how many vertices went.
std::size_t weld_exactly(TriMesh& mesh);

/// Drops vertices no triangle uses; the order of the others stays. Returns how many went.
std::size_t drop_unreferenced_vertices(TriMesh& mesh);

/// Flips a mesh of inverted orientation, by exchanging the last two corners of every triangle: each component closed
/// and of negative volume. Returns the number of triangles flipped: all, or none if no component is inverted. Raises
/// MeshError if the orientation cannot be determined (not closed) or if only some components are inverted: these may
/// be the boundaries of cavities, which are oriented like that.
std::size_t flip_inverted(TriMesh& mesh);

// A mesh may hold more than one bone means: specks, another bone, another leg, walls within. These leave all but one piece out, and the
// vertices of the others; a mesh of one piece stays as it is. The cavities of the piece that stays, wound as such, stay with it.

/// The piece of most volume among those that lie in no other; of most area if the mesh is open. n log n.
[[nodiscard]] TriMesh largest_piece(const Mesh& mesh);

/// The piece whose surface is nearest a point, such as a joint centre, and those that come as near but for a tenth of the root of the mesh's
/// area, some 25 mm of a bone: the parts of a child's hip bone, which meet in its socket, but of two legs the one at this hip. n log n.
[[nodiscard]] TriMesh piece_at(const Mesh& mesh, const Vec3& point);

/// The three as values, for lists of them.
enum class Repair { weld, drop_unreferenced, flip_inverted };

/// A repair that was made: how many vertices went, or triangles were flipped.
struct RepairDone {
  Repair repair;
  std::size_t count;
};

/// Makes the repairs in this order. Raises MeshError if one cannot be made.
std::vector<RepairDone> repair_mesh(TriMesh& mesh, const std::vector<Repair>& repairs);

}  // namespace condyle
