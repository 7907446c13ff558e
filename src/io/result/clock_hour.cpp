#include "io/result/clock_hour.hpp"

#include <fmt/format.h>

#include <cmath>

#include "motion/rom/socket_hour.hpp"

namespace condyle::io {

std::optional<double> clock_hour(const RomResult& result, const motion::MotionLimit& limit) {
  if (!result.joint.is_hip() || !limit.end.contact) return std::nullopt;
  return motion::socket_hour(result.answer.clock, result.answer.bearing.surface,
                             limit.end.contact->fixed_point);
}

std::string clock_text(double hour) {
  const long minutes = std::lround(hour * 60) % 720;
  return fmt::format("{}:{:02}", minutes < 60 ? 12 : minutes / 60, minutes % 60);
}

}  // namespace condyle::io
