#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "condyle/limit_band.hpp"

namespace condyle::io {

/// ">120": where the range ends without contact; the band behind it where some displaced joints do meet in the range.
inline std::string beyond_range(Angle range, const motion::LimitBand* band) {
  const std::string end = fmt::format(">{:g}", std::round(10 * range.degrees()) / 10);
  if (!band) return end;
  const std::string p5 = fmt::format("{:.0f}", band->p5.degrees()),
                    p95 = fmt::format("{:.0f}", band->p95.degrees());
  return p5 == p95 ? end + "\xC2\xB0" : fmt::format("{}\xC2\xB0 ({}\xE2\x80\x93{})", end, p5, p95);
}

/// Digits after the point of a limit: the last one is a tenth to a hundredth of its band's width, or 0.01 degrees.
inline int limit_digits(const motion::LimitBand& band) {
  const double width = (band.p95 - band.p5).degrees();
  return width >= 10 ? 0 : width >= 1 ? 1 : 2;
}

/// "131.9° (126–135)": a limit with its band, as it may be quoted.
inline std::string quoted_limit(Angle limit, const motion::LimitBand& band) {
  return fmt::format("{:.{}f}\xC2\xB0 ({:.0f}\xE2\x80\x93{:.0f})", limit.degrees(), limit_digits(band),
                     band.p5.degrees(), band.p95.degrees());
}

}  // namespace condyle::io
