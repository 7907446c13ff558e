#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace condyle::core {

/// "1 frame", "3 frames".
inline std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

}  // namespace condyle::core
