#include "io/result/normal_range.hpp"

#include <array>

namespace condyle::io {

std::optional<Angle> normal_hip_range(std::string_view motion) noexcept {
  struct Range {
    std::string_view motion;
    double degrees;
  };
  static constexpr std::array ranges{Range{"flexion", 120},          Range{"extension", 30},
                                     Range{"abduction", 45},         Range{"adduction", 30},
                                     Range{"internal_rotation", 45}, Range{"external_rotation", 45}};
  for (const Range& range : ranges)
    if (range.motion == motion) return Angle::degrees(range.degrees);
  return std::nullopt;
}

}  // namespace condyle::io
