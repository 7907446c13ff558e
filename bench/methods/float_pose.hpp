#pragma once

#include <array>

#include "condyle/pose.hpp"

namespace bench {

/// A pose in single precision, for libraries that compute in it.
struct FloatPose {
  explicit FloatPose(const condyle::Pose& X) noexcept {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) m[i][j] = static_cast<float>(X.matrix()(i, j));
  }
  float row(int i, float x, float y, float z) const noexcept {
    return m[i][0] * x + m[i][1] * y + m[i][2] * z + m[i][3];
  }
  float m[3][4];
};

}  // namespace bench
