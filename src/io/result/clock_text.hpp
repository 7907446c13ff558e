#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace condyle::io {

/// "1:30" of 1.5: hours and minutes of the clock face, 12 for the first hour.
inline std::string clock_text(double hour) {
  const long minutes = std::lround(hour * 60) % 720;
  return fmt::format("{}:{:02}", minutes < 60 ? 12 : minutes / 60, minutes % 60);
}

}  // namespace condyle::io
