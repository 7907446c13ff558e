#include "io/result/clock_hour.hpp"

#include <fmt/format.h>

#include <cmath>

#include "condyle/clock_face.hpp"

namespace condyle::io {

namespace {

/// In head radii from the joint centre. A rim lies 1.1 to 1.4 radii from it; what is farther, trochanter on ischium say,
/// has no place on the rim's clock.
constexpr double farthest_rim = 1.6;

}  // namespace

std::optional<double> clock_hour(const RomResult& result, const MotionLimit& limit) {
  if (!result.joint.is_hip() || !limit.end.contact) return std::nullopt;
  const Vec3& point = limit.end.contact->fixed_point;
  if (result.bearing.surface && point.norm() > farthest_rim * result.bearing.surface->head.radius)
    return std::nullopt;
  return result.clock.hour_of(point);
}

std::string clock_text(double hour) {
  const long minutes = std::lround(hour * 60) % 720;
  return fmt::format("{}:{:02}", minutes < 60 ? 12 : minutes / 60, minutes % 60);
}

}  // namespace condyle::io
