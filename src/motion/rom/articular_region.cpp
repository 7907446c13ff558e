#include "condyle/articular_region.hpp"

#include <cmath>

#include "condyle/error.hpp"
#include "condyle/fit.hpp"

namespace condyle {
namespace {

/// A head within a radius of the centre lies within two of the largest radii that find_sphere() looks for;
/// fewer vertices to search cost less.
constexpr double largest_head_reach = 90;

}  // namespace

bool ArticularRegion::holds(const Vec3& p) const noexcept {
  if (p.norm() > radius_mm) return false;
  if (!cone) return true;
  const double angle = std::atan2(cone->axis.cross(p).norm(), cone->axis.dot(p));
  return angle <= cone->half_angle.radians();
}

std::optional<ArticularRegion> find_articular_region(const Joint& joint) {
  if (joint.kind != JointKind::ball) return std::nullopt;
  try {
    const SphereSearch search{.within = Sphere{Vec3::Zero(), largest_head_reach}};
    const Sphere head = find_sphere(joint.mobile.mesh, search).fit.sphere;
    if (head.centre.norm() > head.radius) return std::nullopt;
    return ArticularRegion{articular_radii_of_head * head.radius};
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

}  // namespace condyle
