#include "sample/topology.hpp"

#include "support/test.hpp"

namespace condyle::test {

Topology topology(const TriMesh& mesh) {
  Topology found = {true, true, 0, 0, 0};
  std::map<std::pair<Index, Index>, int> directed;
  std::vector<std::vector<std::pair<Index, Index>>> opposite(mesh.vertices.size());
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      ++directed[{t[k], t[(k + 1) % 3]}];
      opposite[t[k]].emplace_back(t[(k + 1) % 3], t[(k + 2) % 3]);
    }
  }
  for (const auto& [edge, count] : directed) {
    const auto other = directed.find({edge.second, edge.first});
    if (count != 1 || other == directed.end()) found.is_closed_and_consistent = false;
  }

  // Walking from one opposite edge to the next must come round after all of them.
  for (const auto& edges : opposite) {
    const std::map<Index, Index> next(edges.begin(), edges.end());
    if (edges.empty() || next.size() != edges.size()) {
      found.has_manifold_vertices = false;
      continue;
    }
    std::size_t steps = 0;
    Index at = next.begin()->first;
    do {
      const auto step = next.find(at);
      if (step == next.end()) break;
      at = step->second;
      ++steps;
    } while (at != next.begin()->first && steps <= edges.size());
    if (steps != edges.size()) found.has_manifold_vertices = false;
  }

  std::vector<bool> seen(mesh.vertices.size());
  for (Index start = 0; start < mesh.vertices.size(); ++start) {
    if (seen[start]) continue;
    ++found.components;
    std::vector<Index> open = {start};
    seen[start] = true;
    while (!open.empty()) {
      const Index v = open.back();
      open.pop_back();
      for (const auto& [a, b] : opposite[v]) {
        for (const Index n : {a, b}) {
          if (!seen[n]) seen[n] = true, open.push_back(n);
        }
      }
    }
  }

  const auto v = static_cast<long>(mesh.vertices.size()), f = static_cast<long>(mesh.triangles.size());
  found.genus = static_cast<int>((2 - (v - static_cast<long>(directed.size()) / 2 + f)) / 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    found.signed_volume += mesh.corner(t, 0).dot(mesh.corner(t, 1).cross(mesh.corner(t, 2))) / 6;
  }
  return found;
}

std::vector<double> smallest_angles_deg(const TriMesh& mesh) {
  std::vector<double> angles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double smallest = std::numbers::pi;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh.corner(t, k), u = mesh.corner(t, (k + 1) % 3) - p,
                 v = mesh.corner(t, (k + 2) % 3) - p;
      smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)));
    }
    angles.push_back(smallest * 180 / std::numbers::pi);
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

void expect_sound(const TriMesh& mesh, int genus) {
  const Topology found = topology(mesh);
  EXPECT_TRUE(found.is_closed_and_consistent);
  EXPECT_TRUE(found.has_manifold_vertices);
  EXPECT_EQ(found.components, 1);
  EXPECT_EQ(found.genus, genus);
  EXPECT_GT(found.signed_volume, 0);
}

}  // namespace condyle::test
