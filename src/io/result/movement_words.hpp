#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "io/result/map_result.hpp"

namespace condyle::io {

/// Blanks for underscores.
inline std::string spaced(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

inline std::string movement_words(JointAngle angle, RotationSense sense, Anatomy joint) {
  return spaced(movement_name(angle, sense, joint));
}

}  // namespace condyle::io
