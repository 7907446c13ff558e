#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "condyle/io/recorded_motion.hpp"

namespace condyle::io {

/// A note on the frames that are gaps, if any: how many, and where the first is.
template <class Value>
void note_gaps(const MotionTable& table, const std::vector<std::optional<Value>>& frames,
               std::vector<std::string>& processing) {
  std::size_t gaps = 0, first = 0;
  for (std::size_t row = frames.size(); row-- > 0;)
    if (!frames[row]) ++gaps, first = row;
  if (gaps > 0)
    processing.push_back(
        fmt::format("{} of {} frames are gaps, the first in line {}: they are left out, not interpolated",
                    gaps, frames.size(), table.line_of_row[first]));
}

}  // namespace condyle::io
