#pragma once

#include <fmt/format.h>

#include <string>

#include "condyle/limit_band.hpp"

namespace condyle::io {

/// "131.9° (126–135)": a limit with its band, as it may be quoted.
inline std::string quoted_limit(Angle limit, const LimitBand& band) {
  return fmt::format("{:.1f}\xC2\xB0 ({:.0f}\xE2\x80\x93{:.0f})", limit.degrees(), band.p5.degrees(),
                     band.p95.degrees());
}

}  // namespace condyle::io
