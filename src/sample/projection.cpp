#include "sample/projection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "condyle/error.hpp"

namespace condyle::sample {
namespace {

/// Longest single step, mm: less than half of the thinnest plate.
constexpr double longest_step = 2;
constexpr int newton_steps = 60;

/// The surface between two points on its two sides.
Vec3 bisected(const Field& solid, Vec3 inside, Vec3 outside) {
  while ((outside - inside).norm() > laid_tolerance / 4) {
    const Vec3 middle = (inside + outside) / 2;
    (solid(middle).value < 0 ? inside : outside) = middle;
  }
  return (inside + outside) / 2;
}

}  // namespace

Laid laid_on(const Field& solid, const Vec3& p) {
  Vec3 at = p;
  std::optional<Vec3> inside, outside;
  for (int i = 0; i < newton_steps; ++i) {
    const auto [value, gradient] = solid(at);
    const double slope = gradient.norm();
    if (std::abs(value) <= laid_tolerance / 4 * slope) return {at, gradient};
    if (!(slope > 0)) break;
    (value < 0 ? inside : outside) = at;
    at -= std::clamp(value / slope, -longest_step, longest_step) / slope * gradient;
  }
  if (!inside || !outside) throw MeshError("sample: a point could not be laid on the surface");
  const Vec3 point = bisected(solid, *inside, *outside);
  return {point, solid(point).gradient};
}

}  // namespace condyle::sample
