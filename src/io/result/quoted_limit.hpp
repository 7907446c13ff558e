#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "answer/limit_facts.hpp"

namespace condyle::io {

/// ">120": where the range ends without contact; the band behind it where some displaced joints do meet in the range.
inline std::string beyond_range(const motion::MotionLimit& limit, const motion::LimitBand* band) {
  const std::string end = fmt::format(">{:g}", std::round(10 * limit.end.turned.degrees()) / 10);
  if (!band) return end;
  const std::string of_band = quoted_band(*band, limit.motion);
  return of_band == end ? end + "\xC2\xB0" : fmt::format("{}\xC2\xB0 ({})", end, of_band);
}

/// Digits after the point of a limit: the last one is a tenth to a hundredth of its band's width, or 0.01 degrees.
inline int limit_digits(const motion::LimitBand& band) {
  const double width = (band.p95 - band.p5).degrees();
  return width >= 10 ? 0 : width >= 1 ? 1 : 2;
}

/// "131.9° (126–135)": a limit with its band, as it may be quoted.
inline std::string quoted_limit(const motion::MotionLimit& limit, const motion::LimitBand& band) {
  return fmt::format("{:.{}f}\xC2\xB0 ({})", limit.end.turned.degrees(), limit_digits(band),
                     quoted_band(band, limit.motion));
}

}  // namespace condyle::io
