#include "io/result/clock_contacts.hpp"

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

std::vector<ClockContact> clock_contacts(const RomResult& result) {
  std::vector<ClockContact> contacts;
  for (const MotionLimit& limit : result.limits)
    if (const auto hour = clock_hour(result, limit))
      contacts.push_back({limit.motion.name, *hour, limit.end.kind()});
  return contacts;
}

}  // namespace condyle::io
