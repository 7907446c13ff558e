#include "support/test_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace condyle::test {

TriMesh mesh_of(std::initializer_list<Vec3> vertices, std::vector<Triangle> triangles) {
  TriMesh mesh;
  for (const Vec3& p : vertices) mesh.vertices.push_back(p);
  mesh.triangles = std::move(triangles);
  return mesh;
}

TriMesh box(const Vec3& low, const Vec3& high) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({(i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z()});
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

TriMesh turned_solid(const std::vector<std::array<double, 2>>& profile, Index around) {
  TriMesh mesh;
  const auto rings = static_cast<Index>(profile.size() - 2);
  mesh.vertices.push_back({0, 0, profile.front()[1]});
  for (Index r = 1; r <= rings; ++r)
    for (Index k = 0; k < around; ++k) {
      // From +Y on, so that there the profile is exact.
      const double turn = 2 * std::numbers::pi * k / around;
      mesh.vertices.push_back(
          {-profile[r][0] * std::sin(turn), profile[r][0] * std::cos(turn), profile[r][1]});
    }
  mesh.vertices.push_back({0, 0, profile.back()[1]});
  const auto at = [&](Index ring, Index k) { return 1 + ring * around + k % around; };
  const Index last = 1 + rings * around;
  for (Index k = 0; k < around; ++k) {
    mesh.triangles.push_back({0, at(0, k), at(0, k + 1)});
    for (Index r = 0; r + 1 < rings; ++r) {
      mesh.triangles.push_back({at(r, k), at(r + 1, k), at(r + 1, k + 1)});
      mesh.triangles.push_back({at(r, k), at(r + 1, k + 1), at(r, k + 1)});
    }
    mesh.triangles.push_back({last, at(rings - 1, k + 1), at(rings - 1, k)});
  }
  return mesh;
}

void append(TriMesh& all, const TriMesh& mesh) {
  const auto offset = static_cast<Index>(all.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) all.vertices.push_back(mesh.vertices[i]);
  for (const auto& [p, q, r] : mesh.triangles) all.triangles.push_back({p + offset, q + offset, r + offset});
}

TriMesh joined(const TriMesh& a, const TriMesh& b) {
  TriMesh mesh = a;
  append(mesh, b);
  return mesh;
}

TriMesh flipped(TriMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

TriMesh mapped(TriMesh mesh, const std::function<Vec3(const Vec3&)>& place) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.vertices.set(v, place(mesh.vertices[v]));
  return mesh;
}

TriMesh scaled_by(const TriMesh& mesh, double factor) {
  return mapped(mesh, [&](const Vec3& p) { return Vec3(factor * p); });
}

TriMesh turned(const TriMesh& mesh, const Eigen::Matrix3d& by) {
  TriMesh out = mapped(mesh, [&](const Vec3& p) { return Vec3(by * p); });
  return by.determinant() < 0 ? flipped(std::move(out)) : out;
}

TriMesh shifted_by(const TriMesh& mesh, const Vec3& by) {
  return mapped(mesh, [&](const Vec3& p) { return Vec3(p + by); });
}

TriMesh in_floats(TriMesh mesh) {
  mesh = mapped(std::move(mesh), [](const Vec3& p) { return Vec3(p.cast<float>().cast<double>()); });
  mesh.vertices.x[0] = -0.0;
  return mesh;
}

double farthest(const PointsView& a, const PointsView& b) {
  if (a.size() != b.size()) return HUGE_VAL;
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, (a[v] - b[v]).norm());
  return largest;
}

TriMesh in_axis_frame(const AxisFrame& axis, TriMesh mesh) {
  return mapped(std::move(mesh), [&](const Vec3& p) { return axis.to_axis(p); });
}

}  // namespace condyle::test
