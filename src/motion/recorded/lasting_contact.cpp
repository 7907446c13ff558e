#include "motion/recorded/lasting_contact.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/predicates.hpp"
#include "mesh/triangle_distance.hpp"

namespace condyle::motion {
namespace {

using core::Sign;
using MeshCorners = std::array<Vec3, 3>;

/// In mm, as of clearance(): more than all rounding on the way, for coordinates up to 10 m.
constexpr double crossing_rounding_mm = 1e-9;

/// Pairs evaluated, spread evenly over all: at some microseconds each as costly as finding the pairs.
constexpr std::size_t most_pairs = 256;

MeshCorners corners_of(const Mesh& mesh, Index triangle) {
  return {mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2)};
}

/// Whether the segment goes through the inside of the triangle from one side to the other; touching is not enough.
bool crosses(const Vec3& p, const Vec3& q, const MeshCorners& t) {
  const Sign at_p = core::orientation(t[0], t[1], t[2], p), at_q = core::orientation(t[0], t[1], t[2], q);
  if (at_p == Sign::zero || at_q != -at_p) return false;
  const Sign side = core::orientation(p, q, t[0], t[1]);
  return side != Sign::zero && core::orientation(p, q, t[1], t[2]) == side &&
         core::orientation(p, q, t[2], t[0]) == side;
}

/// How far everything may move before the segment no longer crosses the triangle; 0 if it does not.
double reserve(const Vec3& p, const Vec3& q, const MeshCorners& t) {
  if (!crosses(p, q, t)) return 0;
  double least =
      std::min((mesh::nearest_on_triangle(p, t) - p).norm(), (mesh::nearest_on_triangle(q, t) - q).norm());
  for (std::size_t k = 0; k < 3; ++k)
    least = std::min(least, std::sqrt(mesh::between_segments(p, q, t[k], t[(k + 1) % 3]).squared_distance));
  return std::max(0.0, least - crossing_rounding_mm);
}

/// Where the segment's line meets the triangle's plane, the two being known to cross.
Vec3 crossing(const Vec3& p, const Vec3& q, const MeshCorners& t) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double at_p = n.dot(p - t[0]), at_q = n.dot(q - t[0]);
  return p + std::clamp(at_p / (at_p - at_q), 0.0, 1.0) * (q - p);
}

}  // namespace

LastingContact lasting_contact(const Mesh& fixed, const Mesh& mobile, const Pose& X_FM,
                               std::span<const contact::TrianglePair> pairs, const Speed& speed) {
  assert(!pairs.empty());
  const auto witness = [&](const contact::TrianglePair& pair, const Vec3& on_fixed, const Vec3& on_mobile) {
    return ContactWitness{{FeatureKind::face, pair.fixed},
                          {FeatureKind::face, pair.mobile},
                          on_fixed,
                          posed(inverted(X_FM), on_mobile)};
  };
  const auto placed = [&](const MeshCorners& own) -> MeshCorners {
    return {posed(X_FM, own[0]), posed(X_FM, own[1]), posed(X_FM, own[2])};
  };

  // Triangles that touch and do not cross meet where they are nearest.
  const mesh::NearestPoints touch = mesh::between_triangles(corners_of(fixed, pairs.front().fixed),
                                                            placed(corners_of(mobile, pairs.front().mobile)));
  LastingContact best{0, witness(pairs.front(), touch.a, touch.b)};
  const std::size_t step = (pairs.size() + most_pairs - 1) / most_pairs;
  for (std::size_t i = 0; i < pairs.size(); i += step) {
    const MeshCorners f = corners_of(fixed, pairs[i].fixed), own = corners_of(mobile, pairs[i].mobile),
                      m = placed(own);
    const double radius = std::max({own[0].norm(), own[1].norm(), own[2].norm()});
    const auto keep = [&](const Vec3& p, const Vec3& q, const MeshCorners& t) {
      const double lasts_for = reserve(p, q, t) / (speed.rotation * radius + speed.origin_mm);
      if (!(lasts_for > best.lasts_for)) return;
      const Vec3 at = crossing(p, q, t);
      best = {lasts_for, witness(pairs[i], at, at)};
    };
    for (std::size_t k = 0; k < 3; ++k) {
      keep(m[k], m[(k + 1) % 3], f);
      keep(f[k], f[(k + 1) % 3], m);
    }
  }
  return best;
}

}  // namespace condyle::motion
