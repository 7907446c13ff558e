#include "support/test_meshes.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace condyle::test {

TriMesh box(const Vec3& low, const Vec3& high) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back({(i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z()});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TriMesh plane(double half, int n) {
  TriMesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      mesh.vertices.push_back({-half + 2 * half * i / n, 0, -half + 2 * half * j / n});
  for (Index i = 0; i < static_cast<Index>(n); ++i) {
    for (Index j = 0; j < static_cast<Index>(n); ++j) {
      const Index a = i * static_cast<Index>(n + 1) + j, b = a + static_cast<Index>(n + 1);
      mesh.triangles.push_back({a, a + 1, b});
      mesh.triangles.push_back({b, a + 1, b + 1});
    }
  }
  return mesh;
}

TriMesh sphere(const Vec3& centre, double radius, int levels) {
  std::vector<Vec3> directions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<Triangle> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                     {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<Index, Index>, Index> midpoint;
    const auto middle = [&](Index a, Index b) {
      const auto [at, is_new] =
          midpoint.try_emplace(std::minmax(a, b), static_cast<Index>(directions.size()));
      if (is_new) directions.push_back((directions[a] + directions[b]).normalized());
      return at->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  TriMesh mesh;
  for (const auto& d : directions) mesh.vertices.push_back(centre + radius * d);
  mesh.triangles = std::move(triangles);
  return mesh;
}

TriMesh socket(const Vec3& centre, double inner, double outer, int levels) {
  const TriMesh unit = sphere(Vec3::Zero(), 1, levels);
  TriMesh mesh;
  std::map<std::pair<Index, bool>, Index> number;
  const auto vertex = [&](Index v, bool is_outer) {
    const auto [at, is_new] = number.try_emplace({v, is_outer}, static_cast<Index>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(centre + (is_outer ? outer : inner) * unit.vertices[v]);
    return at->second;
  };
  for (const auto& [a, b, c] : unit.triangles) {
    if ((unit.vertices[a] + unit.vertices[b] + unit.vertices[c]).y() <= 0) continue;
    mesh.triangles.push_back({vertex(a, true), vertex(b, true), vertex(c, true)});
    mesh.triangles.push_back({vertex(a, false), vertex(c, false), vertex(b, false)});
    for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      // An edge of the hemisphere's rim lies in the plane y = 0.
      if (unit.vertices[p].y() != 0 || unit.vertices[q].y() != 0) continue;
      mesh.triangles.push_back({vertex(q, true), vertex(p, true), vertex(p, false)});
      mesh.triangles.push_back({vertex(q, true), vertex(p, false), vertex(q, false)});
    }
  }
  return mesh;
}

TriMesh torus(double major, double minor, int around, int across) {
  TriMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double rho = major + minor * std::cos(v);
      mesh.vertices.push_back({rho * std::cos(u), rho * std::sin(u), minor * std::sin(v)});
    }
  }
  const auto number = [&](int i, int j) { return static_cast<Index>((i % around) * across + j % across); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      mesh.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
  return mesh;
}

TriMesh joined(const TriMesh& a, const TriMesh& b) {
  TriMesh mesh = a;
  const auto offset = static_cast<Index>(a.vertices.size());
  for (std::size_t i = 0; i < b.vertices.size(); ++i) mesh.vertices.push_back(b.vertices[i]);
  for (const auto& [p, q, r] : b.triangles) mesh.triangles.push_back({p + offset, q + offset, r + offset});
  return mesh;
}

TriMesh flipped(TriMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

TriMesh in_axis_frame(const AxisFrame& axis, TriMesh mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.vertices.set(v, axis.to_axis(mesh.vertices[v]));
  return mesh;
}

}  // namespace condyle::test
