
#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/inspect.hpp"

namespace condyle {
namespace {

/// Keeps the vertices for which keep(i), in their order; returns where each of them went.
template <class Keep>
std::vector<Index> keep_vertices(Points& points, const Keep& keep) {
  std::vector<Index> new_number(points.size(), no_index);
  Index kept = 0;
  for (Index i = 0; i < points.size(); ++i) {
    if (!keep(i)) continue;
    points.set(kept, points[i]);
    new_number[i] = kept++;
  }
  for (auto* coordinate : {&points.x, &points.y, &points.z}) {
    coordinate->resize(kept);
    coordinate->shrink_to_fit();
  }
  return new_number;
}

std::string in_words(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

}  // namespace

std::vector<Index> first_of_same_coordinates(PointsView points) {
  struct Entry {
    std::array<double, 3> p;
    Index number;
  };
  std::vector<Entry> entries(points.size());
  for (Index i = 0; i < points.size(); ++i) entries[i] = {{points.x[i], points.y[i], points.z[i]}, i};
  // Compared as numbers, so that -0 equals +0; the earliest of equals comes first.
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.p != b.p ? a.p < b.p : a.number < b.number; });

  std::vector<Index> first(points.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool same = i > 0 && entries[i].p == entries[i - 1].p;
    first[entries[i].number] = same ? first[entries[i - 1].number] : entries[i].number;
  }
  return first;
}

std::size_t weld_exactly(TriMesh& mesh) {
  const std::size_t before = mesh.vertices.size();
  const auto first = first_of_same_coordinates(mesh.vertices);
  const auto new_number = keep_vertices(mesh.vertices, [&](Index i) { return first[i] == i; });
  for (auto& triangle : mesh.triangles) {
    for (auto& v : triangle) v = new_number[first[v]];
  }
  return before - mesh.vertices.size();
}

std::size_t drop_unreferenced_vertices(TriMesh& mesh) {
  const std::size_t before = mesh.vertices.size();
  std::vector<bool> used(before, false);
  for (const auto& triangle : mesh.triangles) {
    for (const Index v : triangle) used[v] = true;
  }
  const auto new_number = keep_vertices(mesh.vertices, [&](Index i) { return used[i]; });
  for (auto& triangle : mesh.triangles) {
    for (auto& v : triangle) v = new_number[v];
  }
  return before - mesh.vertices.size();
}

std::size_t flip_inverted(TriMesh& mesh) {
  const MeshReport report = inspect(mesh);
  if (!report.is_closed() || report.components.empty()) {
    const std::string why =
        report.boundary_edges.count > 0 ? "it has " + describe_boundary(report)
        : report.inconsistent_edges.count > 0
            ? "neighbours are wound differently at " + in_words(report.inconsistent_edges.count, "edge")
        : report.unbalanced_edges.count > 0
            ? "it has " + in_words(report.unbalanced_edges.count, "unbalanced non-manifold edge")
            : "it has no surface";
    throw MeshError("cannot decide whether the mesh is inverted: " + why);
  }
  const std::size_t inverted = report.inverted_components.count;
  if (inverted == 0) return 0;
  if (inverted < report.components.size()) {
    throw MeshError(in_words(inverted, "component") + " of " + std::to_string(report.components.size()) +
                    " inverted, the first with triangle " +
                    std::to_string(report.components[*report.inverted_components.first].first_triangle) +
                    ": not turned, as the boundary of a cavity is wound that way");
  }
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh.triangles.size();
}

std::vector<RepairDone> repair_mesh(TriMesh& mesh, const std::vector<Repair>& repairs) {
  std::vector<RepairDone> done;
  for (const Repair repair : repairs) {
    const auto count = [&] {
      switch (repair) {
        case Repair::weld:
          return weld_exactly(mesh);
        case Repair::drop_unreferenced:
          return drop_unreferenced_vertices(mesh);
        case Repair::flip_inverted:
          break;
      }
      return flip_inverted(mesh);
    }();
    done.push_back({repair, count});
  }
  return done;
}

}  // namespace condyle
