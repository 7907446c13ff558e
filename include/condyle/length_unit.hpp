#pragma once

namespace condyle {

/// The unit in which a file gives lengths. Inside the library everything is millimetres.
enum class LengthUnit { millimetres, metres };

constexpr double mm_per(LengthUnit unit) noexcept {
  return unit == LengthUnit::metres ? 1000 : 1;
}

}  // namespace condyle
