#include "io/result/line_mesh.hpp"

#include <numbers>

#include "core/trigonometry.hpp"

namespace condyle::io {

void add_line(TriMesh& mesh, const Vec3& from, const Vec3& to, double half_width_mm) {
  constexpr int sides = 8;
  const Vec3 along = to - from;
  if (!(along.norm() > 0)) return;
  const Vec3 x = along.unitOrthogonal(), y = along.normalized().cross(x);
  const auto first = static_cast<Index>(mesh.vertices.size());
  for (const Vec3& end : {from, to})
    for (int k = 0; k < sides; ++k) {
      const double turn = 2 * std::numbers::pi * k / sides;
      mesh.vertices.push_back(end + half_width_mm * (core::cosine(turn) * x + core::sine(turn) * y));
    }
  for (Index k = 0; k < sides; ++k) {
    const Index a = first + k, b = first + (k + 1) % sides;
    mesh.triangles.push_back({a, b, b + sides});
    mesh.triangles.push_back({a, b + sides, a + sides});
  }
}

}  // namespace condyle::io
