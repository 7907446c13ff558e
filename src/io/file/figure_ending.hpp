#pragma once

#include <string_view>

namespace condyle::io {

/// Of the formats that condyle.plot draws in, with the point.
inline bool is_figure_ending(std::string_view ending) noexcept {
  return ending == ".pdf" || ending == ".svg" || ending == ".png";
}

}  // namespace condyle::io
