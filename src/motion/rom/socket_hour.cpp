#include "motion/rom/socket_hour.hpp"

namespace condyle::motion {
namespace {

/// In head radii from the joint centre. A rim lies 1.1 to 1.4 radii from it; what is farther, trochanter on ischium say,
/// has no place on the rim's clock.
constexpr double farthest_rim = 1.6;

}  // namespace

std::optional<double> socket_hour(const ClockFace& clock, const std::optional<BearingSurface>& bearing,
                                  const Vec3& point_F) noexcept {
  if (bearing && point_F.norm() > farthest_rim * bearing->head.radius) return std::nullopt;
  return clock.hour_of(point_F);
}

}  // namespace condyle::motion
