#include "mesh/triangle_distance.hpp"

#include <algorithm>

namespace condyle::mesh {
namespace {

using Corners3 = std::array<Vec3, 3>;

NearestPoints between(const Vec3& a, const Vec3& b) noexcept {
  return {a, b, (a - b).squaredNorm()};
}

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) noexcept {
  const Vec3 u = b - a;
  const double length = u.squaredNorm();
  return length > 0 ? Vec3(a + std::clamp((p - a).dot(u) / length, 0.0, 1.0) * u) : a;
}

}  // namespace

Vec3 nearest_on_triangle(const Vec3& p, const Corners3& t) noexcept {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double size = n.squaredNorm();
  const auto inwards = [&](const Vec3& a, const Vec3& b) { return n.cross(b - a).dot(p - a) >= 0; };
  if (size > 0 && inwards(t[0], t[1]) && inwards(t[1], t[2]) && inwards(t[2], t[0]))
    return p - ((p - t[0]).dot(n) / size) * n;
  Vec3 best = nearest_on_segment(p, t[2], t[0]);
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3 candidate = nearest_on_segment(p, t[k], t[k + 1]);
    if ((candidate - p).squaredNorm() < (best - p).squaredNorm()) best = candidate;
  }
  return best;
}

NearestPoints between_segments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  const Vec3 u = b - a, w = d - c, across = u.cross(w);
  const double size = across.squaredNorm();
  if (size > 0) {
    const double s = (c - a).cross(w).dot(across) / size, r = (c - a).cross(u).dot(across) / size;
    if (s >= 0 && s <= 1 && r >= 0 && r <= 1) return between(a + s * u, c + r * w);
  }
  NearestPoints best = between(a, nearest_on_segment(a, c, d));
  for (const NearestPoints& other :
       {between(b, nearest_on_segment(b, c, d)), between(nearest_on_segment(c, a, b), c),
        between(nearest_on_segment(d, a, b), d)})
    if (other.squared_distance < best.squared_distance) best = other;
  return best;
}

NearestPoints between_triangles(const Corners3& a, const Corners3& b) noexcept {
  NearestPoints best = between(a[0], nearest_on_triangle(a[0], b));
  const auto keep = [&](const NearestPoints& other) {
    if (other.squared_distance < best.squared_distance) best = other;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    keep(between(a[i], nearest_on_triangle(a[i], b)));
    keep(between(nearest_on_triangle(b[i], a), b[i]));
    for (std::size_t k = 0; k < 3; ++k) keep(between_segments(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
  }
  return best;
}

}  // namespace condyle::mesh
