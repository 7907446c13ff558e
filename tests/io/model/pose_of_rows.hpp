#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "condyle/pose.hpp"

namespace condyle::test {

/// From 16 numbers, row by row.
inline Pose pose_of_rows(const nlohmann::json& rows) {
  Pose X;
  for (int i = 0; i < 16; ++i) X.matrix()(i / 4, i % 4) = rows[static_cast<std::size_t>(i)].get<double>();
  return X;
}

}  // namespace condyle::test
