#include "io/joint/given_degrees.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>

namespace condyle::io {

/// Two constants and two products round on the way to radians and back: 4 of 2^-53 at most, less than half a unit of the
/// fifteenth digit. So a number of 15 digits is what its own way back rounds to.
double given_degrees(Angle angle) {
  const std::string text = fmt::format("{:.{}g}", angle.degrees(), std::numeric_limits<double>::digits10);
  double shorter = 0;
  std::from_chars(text.data(), text.data() + text.size(), shorter);
  return (Angle::degrees(shorter) == angle ? shorter : angle.degrees()) + 0.0;
}

}  // namespace condyle::io
