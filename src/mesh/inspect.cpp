#include "condyle/inspect.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "condyle/repair.hpp"
#include "core/predicates.hpp"

namespace condyle {
namespace {

// Half-edge 3t + k runs along side k of triangle t, from corner k to corner k + 1. "Corner 3t + k" is corner
// k.
using HalfEdge = Index;

Index from(const TriMesh& mesh, HalfEdge h) {
  return mesh.triangles[h / 3][h % 3];
}
Index to(const TriMesh& mesh, HalfEdge h) {
  return mesh.triangles[h / 3][(h + 1) % 3];
}
HalfEdge next(HalfEdge h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}

bool names_a_vertex_twice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Half-edges gathered by the edge they lie on: edge i owns half_edge[offset[i], offset[i + 1]), ascending.
/// Edges come in the order of their first half-edges.
struct EdgeTable {
  std::vector<HalfEdge> half_edge;
  std::vector<std::size_t> offset;

  std::size_t size() const { return offset.size() - 1; }
  std::span<const HalfEdge> operator[](std::size_t i) const {
    return std::span(half_edge).subspan(offset[i], offset[i + 1] - offset[i]);
  }
};

EdgeTable edges_of(const TriMesh& mesh) {
  struct Entry {
    std::pair<Index, Index> ends;
    HalfEdge h;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries;
  entries.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (names_a_vertex_twice(mesh.triangles[t])) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto h = static_cast<HalfEdge>(3 * t + k);
      entries.push_back({std::minmax(Index{from(mesh, h)}, Index{to(mesh, h)}), h});
    }
  }
  std::sort(entries.begin(), entries.end());

  // Groups of equal ends, then the groups by their first half-edge: the order of the file, not of the sort.
  std::vector<std::pair<std::size_t, std::size_t>> groups;
  for (std::size_t first = 0, last = 0; first < entries.size(); first = last) {
    while (last < entries.size() && entries[last].ends == entries[first].ends) ++last;
    groups.emplace_back(first, last);
  }
  std::sort(groups.begin(), groups.end(),
            [&](const auto& a, const auto& b) { return entries[a.first].h < entries[b.first].h; });

  EdgeTable table;
  table.half_edge.reserve(entries.size());
  table.offset.reserve(groups.size() + 1);
  table.offset.push_back(0);
  for (const auto& [first, last] : groups) {
    for (std::size_t i = first; i < last; ++i) table.half_edge.push_back(entries[i].h);
    table.offset.push_back(table.half_edge.size());
  }
  return table;
}

/// Disjoint sets with path halving; the smallest member represents its set.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }

  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index a, Index b) {
    a = find(a), b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

/// A sum that carries its rounding errors along (Neumaier): as good as one in twice the precision.
class CompensatedSum {
 public:
  void add(double value) {
    const double sum = sum_ + value;
    error_ += std::abs(sum_) >= std::abs(value) ? (sum_ - sum) + value : (value - sum) + sum_;
    sum_ = sum;
  }
  double value() const { return sum_ + error_; }

 private:
  double sum_ = 0, error_ = 0;
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

enum class EdgeKind { sound, boundary, non_manifold, inconsistent };

EdgeKind kind_of(const TriMesh& mesh, std::span<const HalfEdge> edge) {
  if (edge.size() == 1) return EdgeKind::boundary;
  if (edge.size() > 2) return EdgeKind::non_manifold;
  return from(mesh, edge[0]) == from(mesh, edge[1]) ? EdgeKind::inconsistent : EdgeKind::sound;
}

void find_bad_edges(const TriMesh& mesh, const EdgeTable& edges, MeshReport& report) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Edge edge{from(mesh, edges[e][0]), to(mesh, edges[e][0])};
    switch (kind_of(mesh, edges[e])) {
      case EdgeKind::sound:
        break;
      case EdgeKind::boundary:
        report.boundary_edges.add(edge);
        break;
      case EdgeKind::non_manifold:
        report.non_manifold_edges.add(edge);
        break;
      case EdgeKind::inconsistent:
        report.inconsistent_edges.add(edge);
        break;
    }
  }
}

void find_boundary_loops(const TriMesh& mesh, const EdgeTable& edges, MeshReport& report) {
  DisjointSets connected(mesh.vertices.size());
  std::vector<HalfEdge> boundary;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].size() != 1) continue;
    boundary.push_back(edges[e][0]);
    connected.join(from(mesh, boundary.back()), to(mesh, boundary.back()));
  }
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
DisjointSets fans_of(const TriMesh& mesh, const EdgeTable& edges) {
  DisjointSets fans(3 * mesh.triangles.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const HalfEdge first = edges[e][0];
    for (const HalfEdge other : edges[e].subspan(1)) {
      const bool same_direction = from(mesh, first) == from(mesh, other);
      fans.join(first, same_direction ? other : next(other));
      fans.join(next(first), same_direction ? next(other) : other);
    }
  }
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

/// Signed volume of the tetrahedra from the box's centre to each triangle: there the terms are small, and a
/// mesh far from the origin loses nothing. Genus by Euler: vertices - edges + triangles = 2 - 2 genus, edges
/// = 3/2 triangles.
void measure_components(const TriMesh& mesh, const EdgeTable& edges, DisjointSets& fans, MeshReport& report) {
  DisjointSets connected(mesh.triangles.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (const HalfEdge h : edges[e].subspan(1)) connected.join(edges[e][0] / 3, h / 3);
  }
  const Vec3 centre = (report.bounds.low + report.bounds.high) / 2;
  std::vector<Index> component_of(mesh.triangles.size(), no_index);
  std::vector<std::int64_t> vertices;
  std::vector<CompensatedSum> volume;
  auto& components = report.components;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    if (names_a_vertex_twice(mesh.triangles[t])) continue;
    const Index root = connected.find(t);
    if (root == t) {
      component_of[t] = static_cast<Index>(components.size());
      components.emplace_back().first_triangle = t;
      vertices.push_back(0);
      volume.emplace_back();
    }
    const Index c = component_of[t] = component_of[root];
    ++components[c].triangles;
    const Vec3 p = mesh.corner(t, 0) - centre, q = mesh.corner(t, 1) - centre, r = mesh.corner(t, 2) - centre;
    volume[c].add(p.dot(q.cross(r)) / 6);
    for (Index corner = 3 * t; corner < 3 * t + 3; ++corner) vertices[c] += fans.find(corner) == corner;
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (kind_of(mesh, edges[e]) != EdgeKind::sound) components[component_of[edges[e][0] / 3]].closed = false;
  }
  CompensatedSum total;
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (!components[c].closed) continue;
    const auto triangles = static_cast<std::int64_t>(components[c].triangles);
    components[c].genus = static_cast<int>((2 - (vertices[c] - triangles / 2)) / 2);
    components[c].signed_volume = volume[c].value();
    if (volume[c].value() < 0) report.inverted_components.add(static_cast<Index>(c));
    total.add(volume[c].value());
  }
  if (report.is_closed()) report.signed_volume = total.value();
}

/// The bounds of the triangles; zero for none.
BoundingBox surface_bounds(const TriMesh& mesh) {
  if (mesh.triangles.empty()) return {Vec3::Zero(), Vec3::Zero()};
  BoundingBox box{mesh.corner(0, 0), mesh.corner(0, 0)};
  for (const Triangle& triangle : mesh.triangles) {
    for (const Index v : triangle) {
      box.low = box.low.cwiseMin(mesh.vertices[v]);
      box.high = box.high.cwiseMax(mesh.vertices[v]);
    }
  }
  return box;
}

void measure_surface(const TriMesh& mesh, const EdgeTable& edges, MeshReport& report) {
  if (mesh.triangles.empty()) return;
  report.bounds = surface_bounds(mesh);
  CompensatedSum area;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    area.add((b - a).cross(c - a).norm() / 2);
  }
  report.area = area.value();

  if (edges.size() == 0) return;
  std::vector<double> lengths(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const HalfEdge h = edges[e][0];
    lengths[e] = (mesh.vertices[to(mesh, h)] - mesh.vertices[from(mesh, h)]).norm();
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
  const double median =
      lengths.size() % 2 == 1 ? *middle : (*std::max_element(lengths.begin(), middle) + *middle) / 2;
  report.edge_lengths = {*shortest, median, *longest};
}

/// A number as a person would write it: six digits, no trailing zeros.
std::string in_short(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, 6).ptr;
  return {text.begin(), end};
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
  return {std::nullopt, size + ": no bone in millimetres (20 to 1000) nor in metres (0.02 to 1)"};
}

}  // namespace

LikelyUnit likely_unit(const TriMesh& mesh) {
  return likely_unit_of_size(surface_bounds(mesh).diagonal());
}

MeshReport inspect(const TriMesh& mesh) {
  assert(mesh.triangles.size() < no_index / 3 && "half-edges are counted in an Index");
  MeshReport report;
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  const EdgeTable edges = edges_of(mesh);
  DisjointSets fans = fans_of(mesh, edges);

  find_bad_vertices(mesh, report);
  find_bad_triangles(mesh, report);
  find_bad_edges(mesh, edges, report);
  find_boundary_loops(mesh, edges, report);
  find_non_manifold_vertices(mesh, fans, report);
  measure_surface(mesh, edges, report);
  measure_components(mesh, edges, fans, report);
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
