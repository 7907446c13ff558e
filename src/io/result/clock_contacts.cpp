#include "io/result/clock_contacts.hpp"

#include "condyle/clock_face.hpp"

namespace condyle::io {

std::optional<double> clock_hour(const Joint& joint, const MotionLimit& limit) {
  if (joint.kind != JointKind::ball || !limit.end.contact) return std::nullopt;
  return sagittal_clock().hour_of(limit.end.contact->fixed_point);
}

std::vector<ClockContact> clock_contacts(const RomResult& result) {
  std::vector<ClockContact> contacts;
  for (const MotionLimit& limit : result.limits)
    if (const auto hour = clock_hour(result.joint, limit))
      contacts.push_back({limit.motion.name, *hour, limit.end.kind()});
  return contacts;
}

}  // namespace condyle::io
