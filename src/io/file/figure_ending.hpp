#pragma once

#include <string_view>

namespace condyle::io {

/// Whether this is an extension, with its point, of a format that condyle.plot draws in.
inline bool is_figure_ending(std::string_view ending) noexcept {
  return ending == ".pdf" || ending == ".svg" || ending == ".png";
}

}  // namespace condyle::io
