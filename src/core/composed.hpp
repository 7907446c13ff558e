#pragma once

#include "condyle/pose.hpp"

namespace condyle::core {

/// One pose after another, p_A = X_AB * (X_BC * p_C), its sums in the fixed order that Eigen's have when it vectorises: as inverted().
inline Pose composed(const Pose& X_AB, const Pose& X_BC) noexcept {
  const auto &a = X_AB.matrix(), &b = X_BC.matrix();
  Pose out = Pose::Identity();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 4; ++k) {
      const double x = a(i, 0) * b(0, k), y = a(i, 1) * b(1, k), z = a(i, 2) * b(2, k);
      const double sum = i < 2 ? (x + y) + z : x + (y + z);
      out.matrix()(i, k) = k < 3 ? sum : sum + a(i, 3);
    }
  return out;
}

}  // namespace condyle::core
