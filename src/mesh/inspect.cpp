#include "condyle/inspect.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/formatted.hpp"
#include "core/predicates.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/doubled_triangles.hpp"
#include "mesh/edge_table.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/self_crossings.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle {
namespace {

using mesh::DisjointSets;
using mesh::HalfEdge;
using mesh::names_a_vertex_twice;

// "Corner 3t + k" is corner k of triangle t.

Index from(const TriMesh& mesh, HalfEdge h) {
  return mesh.triangles[h / 3][h % 3];
}
Index to(const TriMesh& mesh, HalfEdge h) {
  return mesh.triangles[h / 3][(h + 1) % 3];
}
HalfEdge next(HalfEdge h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}

/// The edges that triangles with three different vertices have.
struct Edges {
  const TriMesh& mesh;
  const mesh::EdgeTable& table;

  std::vector<HalfEdge> scratch = {};

  /// Half-edges along an edge, ascending; until the next call.
  std::span<const HalfEdge> uses(Index edge) {
    scratch.clear();
    for (const HalfEdge h : table.half_edges(edge))
      if (!names_a_vertex_twice(mesh.triangles[h / 3])) scratch.push_back(h);
    return scratch;
  }

  /// visit(edge, its first half-edge), in the order of first half-edges: that of the file.
  template <class Visit>
  void for_each(const Visit& visit) {
    for (HalfEdge h = 0; h < 3 * mesh.triangles.size(); ++h) {
      if (names_a_vertex_twice(mesh.triangles[h / 3])) continue;
      const Index edge = table.edge_of(h);
      if (first_use(edge) == h) visit(edge, h);
    }
  }

 private:
  HalfEdge first_use(Index edge) const {
    const auto all = table.half_edges(edge);
    return *std::find_if(all.begin(), all.end(),
                         [&](HalfEdge h) { return !names_a_vertex_twice(mesh.triangles[h / 3]); });
  }
};

bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{2, 0}}) {
    if (core::orientation_2d(a[i], a[j], b[i], b[j], c[i], c[j]) != core::Sign::zero) return false;
  }
  return true;
}

void find_bad_vertices(const TriMesh& mesh, MeshReport& report) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const auto& triangle : mesh.triangles) {
    for (const Index v : triangle) used[v] = true;
  }
  const auto first = first_of_same_coordinates(mesh.vertices);
  for (Index v = 0; v < mesh.vertices.size(); ++v) {
    if (!used[v]) report.unreferenced_vertices.add(v);
    if (first[v] != v) report.duplicate_vertices.add(v);
  }
}

void find_bad_triangles(const TriMesh& mesh, MeshReport& report) {
  struct Entry {
    Triangle sorted;
    Index number;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries(mesh.triangles.size());
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    entries[t] = {mesh.triangles[t], t};
    std::sort(entries[t].sorted.begin(), entries[t].sorted.end());
    if (names_a_vertex_twice(mesh.triangles[t]) ||
        has_no_area(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2))) {
      report.degenerate_triangles.add(t);
    }
  }
  std::sort(entries.begin(), entries.end());
  std::vector<Index> duplicates;
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].sorted == entries[i - 1].sorted) duplicates.push_back(entries[i].number);
  }
  std::sort(duplicates.begin(), duplicates.end());
  for (const Index t : duplicates) report.duplicate_triangles.add(t);
}

void find_bad_edges(Edges& edges, MeshReport& report) {
  edges.for_each([&](Index e, HalfEdge first) {
    const Edge edge{from(edges.mesh, first), to(edges.mesh, first)};
    const auto uses = edges.uses(e);
    const std::size_t count = uses.size();
    if (count == 1) report.boundary_edges.add(edge);
    if (count == 2 && from(edges.mesh, uses[1]) == edge.from) report.inconsistent_edges.add(edge);
    if (count > 2) report.non_manifold_edges.add(edge);
    if (edges.table.balance(edges.mesh, e) != 0) report.unbalanced_edges.add(edge);
  });
}

void find_boundary_loops(Edges& edges, MeshReport& report) {
  const TriMesh& mesh = edges.mesh;
  DisjointSets connected(mesh.vertices.size());
  std::vector<HalfEdge> boundary;
  edges.for_each([&](Index e, HalfEdge first) {
    if (edges.uses(e).size() != 1) return;
    boundary.push_back(first);
    connected.join(from(mesh, first), to(mesh, first));
  });
  std::vector<Index> loop_of(mesh.vertices.size(), no_index);  // by the vertex that represents it
  std::vector<BoundaryLoop> loops;
  for (const HalfEdge h : boundary) {
    const Edge edge{from(mesh, h), to(mesh, h)};
    Index& loop = loop_of[connected.find(edge.from)];
    if (loop == no_index) {
      loop = static_cast<Index>(loops.size());
      loops.push_back({0, edge, Vec3::Zero()});
    }
    ++loops[loop].edges;
    loops[loop].centre += (mesh.vertices[edge.from] + mesh.vertices[edge.to]) / 2;
  }
  for (auto& loop : loops) {
    loop.centre /= static_cast<double>(loop.edges);
    report.boundary_loops.add(loop);
  }
}

/// Corners about a vertex, joined over the edges their triangles share: one set is one fan.
DisjointSets fans_of(Edges& edges) {
  const TriMesh& mesh = edges.mesh;
  DisjointSets fans(3 * mesh.triangles.size());
  edges.for_each([&](Index e, HalfEdge first) {
    for (const HalfEdge other : edges.uses(e)) {
      const bool same_direction = from(mesh, first) == from(mesh, other);
      fans.join(first, same_direction ? other : next(other));
      fans.join(next(first), same_direction ? next(other) : other);
    }
  });
  return fans;
}

void find_non_manifold_vertices(const TriMesh& mesh, DisjointSets& fans, MeshReport& report) {
  std::vector<Index> fans_about(mesh.vertices.size(), 0);
  for (Index corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
    if (names_a_vertex_twice(mesh.triangles[corner / 3])) continue;
    if (fans.find(corner) == corner) ++fans_about[from(mesh, corner)];
  }
  for (Index v = 0; v < mesh.vertices.size(); ++v) {
    if (fans_about[v] > 1) report.non_manifold_vertices.add(v);
  }
}

/// Genus by Euler: vertices - edges + triangles = 2 - 2 genus, edges = 3/2 triangles.
void measure_components(Edges& edges, DisjointSets& fans, MeshReport& report) {
  const TriMesh& mesh = edges.mesh;
  const auto in_table = edges.table.components();
  // Components of triangles without sides have no number in the report.
  std::vector<Index> number(in_table.first_triangle.size(), no_index);
  const auto component_of = [&](Index triangle) { return number[in_table.of_triangle[triangle]]; };
  const Vec3 centre = (report.bounds.low + report.bounds.high) / 2;
  std::vector<std::int64_t> vertices;
  std::vector<mesh::CompensatedSum> volume;
  std::vector<bool> manifold;
  auto& components = report.components;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    if (names_a_vertex_twice(mesh.triangles[t])) continue;
    if (component_of(t) == no_index) {
      number[in_table.of_triangle[t]] = static_cast<Index>(components.size());
      components.emplace_back().first_triangle = t;
      components.back().bounds = {mesh.corner(t, 0), mesh.corner(t, 0)};
      vertices.push_back(0), volume.emplace_back(), manifold.push_back(true);
    }
    const Index c = component_of(t);
    ++components[c].triangles;
    BoundingBox& bounds = components[c].bounds;
    for (int k = 0; k < 3; ++k) {
      bounds.low = bounds.low.cwiseMin(mesh.corner(t, k));
      bounds.high = bounds.high.cwiseMax(mesh.corner(t, k));
    }
    volume[c].add(mesh::volume_below(mesh, t, centre));
    for (Index corner = 3 * t; corner < 3 * t + 3; ++corner) vertices[c] += fans.find(corner) == corner;
  }
  edges.for_each([&](Index e, HalfEdge first) {
    const Index c = component_of(first / 3);
    if (edges.table.balance(mesh, e) != 0) components[c].closed = false;
    if (edges.uses(e).size() != 2) manifold[c] = false;
  });
  mesh::CompensatedSum total;
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (!components[c].closed) continue;
    const auto triangles = static_cast<std::int64_t>(components[c].triangles);
    if (manifold[c]) components[c].genus = static_cast<int>((2 - (vertices[c] - triangles / 2)) / 2);
    components[c].signed_volume = volume[c].value();
    if (volume[c].value() < 0) report.inverted_components.add(static_cast<Index>(c));
    total.add(volume[c].value());
  }
  if (report.is_closed()) report.signed_volume = total.value();
}

/// Which components lie inside others.
void find_nested_components(const Mesh& mesh, MeshReport& report) {
  const mesh::SurfacePieces& pieces = mesh::pieces_of(mesh);
  if (pieces.of_triangle.empty()) return;
  // Components of an open mesh may be one piece, joined at vertices.
  const auto piece_of = [&](const MeshComponent& c) { return pieces.of_triangle[c.first_triangle]; };
  for (MeshComponent& component : report.components) {
    const mesh::SurfacePiece& piece = pieces.all[piece_of(component)];
    if (!piece.is_inner()) continue;
    const auto around = std::find_if(report.components.begin(), report.components.end(),
                                     [&](const MeshComponent& c) { return piece_of(c) == piece.around; });
    component.inside = static_cast<Index>(around - report.components.begin());
  }
}

void find_self_crossings(const Mesh& mesh, MeshReport& report) {
  const mesh::SelfCrossings& found = mesh::self_crossings_of(mesh);
  report.self_crossings.count = found.pairs;
  if (found.first) report.self_crossings.first = {(*found.first)[0], (*found.first)[1]};
}

void measure_surface(Edges& edges, MeshReport& report) {
  const TriMesh& mesh = edges.mesh;
  report.bounds = mesh::bounds_of_surface(mesh);
  mesh::CompensatedSum area;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    area.add((b - a).cross(c - a).norm() / 2);
  }
  report.area = area.value();

  std::vector<double> lengths;
  edges.for_each([&](Index, HalfEdge h) {
    lengths.push_back((mesh.vertices[to(mesh, h)] - mesh.vertices[from(mesh, h)]).norm());
  });
  if (lengths.empty()) return;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
  const double median =
      lengths.size() % 2 == 1 ? *middle : (*std::max_element(lengths.begin(), middle) + *middle) / 2;
  report.edge_lengths = {*shortest, median, *longest};
}

/// A number as a person would write it: six digits, no trailing zeros.
std::string in_short(double value) {
  return core::formatted("%.6g", value);
}

/// Human bones and their cartilages, whole or in part, span 20 mm (a wedge of meniscus) to 1 m (a tall man's
/// femur is half of that). The two ranges touch nowhere, so a surface of either unit is never taken for the
/// other; a smaller or larger object is simply not guessed.
LikelyUnit likely_unit_of_size(double diagonal) {
  constexpr double shortest_mm = 20, longest_mm = 1000, mm_per_m = 1000;
  const std::string size = "the bounding box is " + in_short(diagonal) + " across";
  if (diagonal >= shortest_mm && diagonal <= longest_mm) {
    return {LengthUnit::millimetres, size + ": a bone in millimetres"};
  }
  if (diagonal >= shortest_mm / mm_per_m && diagonal <= longest_mm / mm_per_m) {
    return {LengthUnit::metres, size + ": a bone in metres"};
  }
  return {std::nullopt,
          size + ": no human bone in millimetres (20 to 1000) nor in metres (0.02 to 1), an animal's may be"};
}

}  // namespace

LikelyUnit likely_unit(const TriMesh& mesh) {
  return likely_unit_of_size(mesh::bounds_of_surface(mesh).diagonal());
}

MeshReport inspect(const Mesh& mesh) {
  MeshReport report;
  report.vertices = mesh.vertices().size();
  report.triangles = mesh.triangles().size();
  Edges edges{mesh, mesh::edges_of(mesh)};
  DisjointSets fans = fans_of(edges);

  find_bad_vertices(mesh, report);
  find_bad_triangles(mesh, report);
  find_bad_edges(edges, report);
  find_boundary_loops(edges, report);
  find_non_manifold_vertices(mesh, fans, report);
  find_self_crossings(mesh, report);
  measure_surface(edges, report);
  measure_components(edges, fans, report);
  find_nested_components(mesh, report);
  if (mesh::is_two_sided(mesh)) report.two_sided = mesh::two_sided_text;
  report.likely_unit = likely_unit_of_size(report.bounds.diagonal());
  return report;
}

std::string describe_boundary(const MeshReport& report) {
  if (!report.boundary_loops.first) return {};
  const auto& loop = *report.boundary_loops.first;
  const Vec3& p = loop.centre;
  std::string text = "an open boundary of " + std::to_string(loop.edges) +
                     (loop.edges == 1 ? " edge" : " edges") + " near (" + in_short(p.x()) + ", " +
                     in_short(p.y()) + ", " + in_short(p.z()) + "), from vertex " +
                     std::to_string(loop.first.from);
  if (report.boundary_loops.count > 1)
    text += " (the first of " + std::to_string(report.boundary_loops.count) + ")";
  return text;
}

}  // namespace condyle
