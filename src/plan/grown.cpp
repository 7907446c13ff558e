#include "plan/grown.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/symmetric.hpp"
#include "core/trigonometry.hpp"

namespace condyle::plan {
namespace {

/// A margin's tip around a sharp edge goes no farther than this many margins; directions across which triangles bend less than this
/// share are flat.
constexpr double longest_tip = 2, flat_share = 1e-3;

}  // namespace

Mesh grown(const Mesh& mesh, double by_mm) {
  if (by_mm == 0) return mesh;
  const std::size_t count = mesh.vertices().size();
  std::vector<Eigen::Matrix3d> squares(count, Eigen::Matrix3d::Zero());
  std::vector<Vec3> sums(count, Vec3::Zero());
  const auto normal_of = [&](std::size_t t) {
    return Vec3((mesh.corner(t, 1) - mesh.corner(t, 0))
                    .cross(mesh.corner(t, 2) - mesh.corner(t, 0))
                    .stableNormalized());
  };
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const Triangle& v = mesh.triangles()[t];
    const Vec3 normal = normal_of(t);
    for (int k = 0; k < 3; ++k) {
      const Vec3 to_next = (mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k)).stableNormalized(),
                 to_last = (mesh.corner(t, (k + 2) % 3) - mesh.corner(t, k)).stableNormalized();
      const double angle = core::arccosine(std::clamp(to_next.dot(to_last), -1.0, 1.0));
      squares[v[k]] += angle * normal * normal.transpose();
      sums[v[k]] += angle * normal;
    }
  }
  std::vector<Vec3> tips(count, Vec3::Zero());
  for (std::size_t v = 0; v < count; ++v) {
    const auto [values, axes] = core::axes_of(squares[v]);
    for (int k = 0; k < 3; ++k)
      if (values[k] > flat_share * values[2]) {
        const Vec3 axis = axes.col(k);
        tips[v] += axis.dot(sums[v]) / values[k] * axis;
      }
  }
  std::vector<double> least(count, 1);  // that a plane moves by
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
    if (const Vec3 normal = normal_of(t); normal != Vec3::Zero())
      for (const Index v : mesh.triangles()[t]) least[v] = std::min(least[v], normal.dot(tips[v]));
  Points moved = mesh.vertices();
  for (std::size_t v = 0; v < count; ++v) {
    if (tips[v] == Vec3::Zero()) continue;
    const double most = longest_tip / tips[v].norm(), enough = least[v] > 0 ? 1 / least[v] : most;
    moved.set(v, moved[v] + by_mm * std::min(enough, most) * tips[v]);
  }
  return mesh.moved_to(std::move(moved));
}

}  // namespace condyle::plan
