#include "radial/exact/ray_scan.hpp"

#include <algorithm>
#include <cmath>

#include "core/exact_integers.hpp"
#include "core/trigonometry.hpp"
#include "radial/exact/triangle_plane.hpp"

namespace condyle::radial {
namespace {

double fraction_along_ray(const Vec3& v, const Cone& t) noexcept {
  const double past = core::filtered_determinant(v - t.a, t.b - t.a, t.c - t.a).value;  // v . N - D
  const double full = core::filtered_determinant(v, t.b - t.a, t.c - t.a).value;        // v . N
  return full != 0 ? 1 - past / full : 1;
}

/// (D - v . N) / (v . N): the signed way from v to the triangle's plane along the ray, in units of |v|.
double exact_relative_gap(const Vec3& v, const Cone& t) {
  const auto n = core::exact::to_integers<12>(
      {v.x(), v.y(), v.z(), t.a.x(), t.a.y(), t.a.z(), t.b.x(), t.b.y(), t.b.z(), t.c.x(), t.c.y(), t.c.z()});
  std::array<core::exact::Integer, 3> ab, ac, normal;
  for (std::size_t k = 0; k < 3; ++k) ab[k] = n[6 + k] - n[3 + k], ac[k] = n[9 + k] - n[3 + k];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    normal[k] = ab[i] * ac[j] - ab[j] * ac[i];
  }
  core::exact::Integer to_plane = 0, full = 0;
  for (std::size_t k = 0; k < 3; ++k) to_plane += (n[3 + k] - n[k]) * normal[k], full += n[k] * normal[k];
  return core::exact::quotient(to_plane, full);
}

}  // namespace

/// Nearly always the triangle's plane decides. Beyond that, both determinants err by at most 12u times a
/// product of lengths: 8u for their own operations, and u for each of the rounded differences in them. Where
/// that could show in the quotient (a ray within a degree or so of the surface, a sliver), the quotient is
/// taken in integers.
///
/// A point so near the centre that its square would vanish has the plane's distance along its ray, and its own, which that
/// does not feel, less.
double distance_along_ray(const Vec3& v, const Cone& t) {
  if (const double reach = v.cwiseAbs().maxCoeff(); reach < 0x1p-500 && reach > 0) {
    const int power = -std::ilogb(reach);
    const Vec3 direction(std::ldexp(v.x(), power), std::ldexp(v.y(), power), std::ldexp(v.z(), power));
    return distance_along_ray(direction, t) + direction.norm();
  }
  if (const double gap = gap_to_plane(v, scaled_normal(t.a, t.b, t.c)); !std::isnan(gap)) return gap;
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, av = v - t.a;
  const double past = core::filtered_determinant(av, ab, ac).value,
               full = core::filtered_determinant(v, ab, ac).value;
  // Written out: Eigen's norm sums in another order where it does not vectorise.
  const double radius = std::sqrt((v.x() * v.x() + v.y() * v.y()) + v.z() * v.z());
  const double error = 12 * core::rounding_unit * ab.norm() * ac.norm() * (radius + av.norm());
  constexpr double accepted = 3e-13;
  const double relative = error <= accepted * std::abs(full) ? -past / full : exact_relative_gap(v, t);
  return relative * radius;
}

Angle angle_to_normal(const Vec3& v, const Cone& t) noexcept {
  const Vec3 normal = (t.b - t.a).cross(t.c - t.a);
  return Angle::radians(core::arctangent(v.cross(normal).norm(), std::abs(v.dot(normal))));
}

RayScan::RayScan(const TriMesh& mesh, int winding_at_centre)
    : mesh_(mesh), winding_at_centre_(winding_at_centre) {}

void RayScan::add(const RayCrossing& crossing, Index triangle) {
  if (crossing.point_on_triangle) on_triangle_ = std::min(on_triangle_, triangle);
  if (crossing.outwards != core::Sign::zero)
    crossings_.push_back({0, crossing.outwards, crossing.before_point, triangle});
}

int RayScan::winding() const noexcept {
  int w = winding_at_centre_;
  for (const auto& crossing : crossings_) {
    if (crossing.before_point) w -= static_cast<int>(crossing.outwards);
  }
  return w;
}

PointState RayScan::collected_state() const noexcept {
  return on_triangle_ != no_index ? PointState::on_surface
         : winding() > 0          ? PointState::inside
                                  : PointState::outside;
}

void RayScan::sort_crossings(const Vec3& v) {
  const auto before = static_cast<std::size_t>(std::count_if(
      crossings_.begin(), crossings_.end(), [](const Crossing& crossing) { return crossing.before_point; }));
  if (before > 1 || crossings_.size() - before > 1)
    for (Crossing& crossing : crossings_)
      crossing.fraction = fraction_along_ray(v, cone_of(mesh_, crossing.triangle));
  std::sort(crossings_.begin(), crossings_.end());
}

RayScan::Neighbours RayScan::boundary_crossings(const Vec3& v) {
  if (crossings_.size() > 1) sort_crossings(v);
  Neighbours nearest;
  int w = winding_at_centre_;
  for (const auto& crossing : crossings_) {
    const bool was_inside = w > 0;
    w -= static_cast<int>(crossing.outwards);
    if (was_inside == (w > 0)) continue;
    if (crossing.before_point) {
      nearest.before = crossing.triangle;
    } else if (nearest.after == no_index) {
      nearest.after = crossing.triangle;
    }
  }
  return nearest;
}

RayAnswer RayScan::answer(const Vec3& v, std::span<const Index> triangles) {
  return answer(
      v, triangles,
      [&](Index t) {
        const Cone cone = cone_of(mesh_, t);
        return ray_crossing(v, cone.a, cone.b, cone.c);
      },
      [&](Index t) { return distance_along_ray(v, cone_of(mesh_, t)); });
}

}  // namespace condyle::radial
