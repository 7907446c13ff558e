#include "plan/removed_bone.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/enclosed_volume.hpp"

namespace condyle::plan {
namespace {

/// Removed bone is sampled in layers of this thickness, mm.
constexpr double layer_mm = 0.15;

bool is_lowered(const CutSurface& surface, Index triangle) {
  const Triangle& corners = surface.body().mesh.triangles()[triangle];
  return std::any_of(corners.begin(), corners.end(),
                     [&](Index v) { return surface.vertices()[v].depth_mm > 0; });
}

/// Area counts where the cut is deeper than this share of its deepest place: triangles across its border are lowered by less.
constexpr double counted_share_of_deepest = 0.01;

/// The share of a triangle on which a linear function of these values at its corners is positive.
double share_above_zero(std::array<double, 3> value) {
  std::sort(value.begin(), value.end());
  const auto& [low, middle, high] = value;
  if (low > 0) return 1;
  if (high <= 0) return 0;
  const double corner = middle > 0 ? low / (low - middle) * (low / (low - high))
                                   : high / (high - middle) * (high / (high - low));
  return middle > 0 ? 1 - corner : corner;
}

}  // namespace

double removed_mm3(const CutSurface& surface) {
  const std::vector<CutSurface::Vertex>& vertices = surface.vertices();
  const auto deepest = std::max_element(vertices.begin(), vertices.end(),
                                        [](const auto& a, const auto& b) { return a.depth_mm < b.depth_mm; });
  const TriMesh& before = surface.body().mesh;
  const Mesh after = surface.mesh();
  mesh::CompensatedSum volume;
  for (const Index t : surface.moving())
    if (is_lowered(surface, t))
      volume.add(mesh::volume_below(before, t, deepest->before) -
                 mesh::volume_below(after, t, deepest->before));
  return volume.value();
}

double removed_mm2(const CutSurface& surface) {
  const TriMesh& before = surface.body().mesh;
  double deepest_mm = 0;
  for (const CutSurface::Vertex& vertex : surface.vertices())
    deepest_mm = std::max(deepest_mm, vertex.depth_mm);
  const double level_mm = counted_share_of_deepest * deepest_mm;
  double area = 0;
  for (const Index t : surface.moving()) {
    if (!is_lowered(surface, t)) continue;
    std::array<double, 3> above{};
    for (int k = 0; k < 3; ++k) above[k] = surface.vertices()[before.triangles[t][k]].depth_mm - level_mm;
    const double whole =
        (before.corner(t, 1) - before.corner(t, 0)).cross(before.corner(t, 2) - before.corner(t, 0)).norm() /
        2;
    area += whole * share_above_zero(above);
  }
  return area;
}

double swept_share(const CutSurface& surface, const std::vector<SweepTo>& targets) {
  Points points;
  std::vector<double> weight;
  for (const Index t : surface.moving()) {
    std::array<Vec3, 3> p{}, d{};
    double deepest = 0;
    for (int k = 0; k < 3; ++k) {
      const CutSurface::Vertex& vertex = surface.vertices()[surface.body().mesh.triangles()[t][k]];
      p[k] = vertex.before, d[k] = vertex.depth_mm * vertex.inwards;
      deepest = std::max(deepest, vertex.depth_mm);
    }
    if (deepest == 0) continue;
    const int layers = static_cast<int>(std::ceil(deepest / layer_mm));
    // The middles of the four triangles that halved sides make.
    constexpr std::array<std::array<double, 2>, 4> middles{
        {{1. / 3, 1. / 3}, {1. / 6, 1. / 6}, {2. / 3, 1. / 6}, {1. / 6, 2. / 3}}};
    for (const auto& [u, v] : middles)
      for (int layer = 0; layer < layers; ++layer) {
        const double s = (layer + 0.5) / layers;
        const Vec3 down = d[0] + u * (d[1] - d[0]) + v * (d[2] - d[0]);
        points.push_back(p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]) + s * down);
        const Vec3 along_u = p[1] - p[0] + s * (d[1] - d[0]), along_v = p[2] - p[0] + s * (d[2] - d[0]);
        weight.push_back(-down.dot(along_u.cross(along_v)) / layers);
      }
  }
  std::vector<std::uint8_t> goes(points.size(), 0);
  for (const SweepTo& target : targets) {
    const std::vector<double> first = target.sweep->first_inside(points, target.reach);
    for (std::size_t k = 0; k < goes.size(); ++k)
      if (std::isfinite(first[k])) goes[k] = 1;
  }
  double all = 0, gone = 0;
  for (std::size_t k = 0; k < goes.size(); ++k) all += weight[k], gone += goes[k] ? weight[k] : 0;
  return all > 0 ? gone / all : 0;
}

}  // namespace condyle::plan
