#include "tangential/circle_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/brute_force.hpp"

namespace condyle::test {
namespace {

using Real = long double;
using Real3 = Eigen::Matrix<Real, 3, 1>;

bool near_triangle(const Real3& a, const Real3& b, const Real3& c, const Real3& normal, const Real3& p) {
  const Real slack = 1e-6L * normal.squaredNorm();
  return (b - a).cross(p - a).dot(normal) >= -slack && (c - b).cross(p - b).dot(normal) >= -slack &&
         (a - c).cross(p - c).dot(normal) >= -slack;
}

}  // namespace

Vec3 rotated(const Vec3& p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()};
}

std::vector<CirclePiece> circle_pieces(const TriMesh& mesh, const Vec3& point) {
  const Real shrink = 1 - 1e-10L / std::hypot(Real(point.x()), Real(point.y()));
  const Real3 v(point.x() * shrink, point.y() * shrink, point.z() - 1e-13L);
  constexpr Real full_turn = 2 * std::numbers::pi_v<Real>;
  std::vector<Real> angles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Real3 a = mesh.corner(t, 0).cast<Real>(), b = mesh.corner(t, 1).cast<Real>(),
                c = mesh.corner(t, 2).cast<Real>();
    const Real3 n = (b - a).cross(c - a);
    // n.(R v - a) = A cos + B sin + C.
    const Real A = n.x() * v.x() + n.y() * v.y(), B = n.y() * v.x() - n.x() * v.y();
    const Real C = n.z() * v.z() - n.dot(a), r = std::hypot(A, B);
    if (r == 0 || std::abs(C) > r) continue;
    for (const int sign : {-1, 1}) {
      const Real angle = std::atan2(B, A) + sign * std::atan2(std::sqrt((r - C) * (r + C)), -C);
      const Real3 p(std::cos(angle) * v.x() - std::sin(angle) * v.y(),
                    std::sin(angle) * v.x() + std::cos(angle) * v.y(), v.z());
      if (near_triangle(a, b, c, n, p)) angles.push_back(std::fmod(angle + 2 * full_turn, full_turn));
    }
  }
  std::sort(angles.begin(), angles.end());
  if (angles.empty()) angles.push_back(0);
  std::vector<CirclePiece> pieces;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const Real end = i + 1 < angles.size() ? angles[i + 1] : angles[0] + full_turn;
    const Vec3 middle = rotated(v.cast<double>(), static_cast<double>((angles[i] + end) / 2));
    pieces.push_back({static_cast<double>(angles[i]), static_cast<double>(end), 0});
    // Pieces as short as rounding are never compared.
    if (end - angles[i] > 1e-3L) pieces.back().winding = winding_number(mesh, middle).winding;
  }
  return pieces;
}

}  // namespace condyle::test
