#pragma once

#include "condyle/io/label_file.hpp"
#include "support/test.hpp"

namespace condyle::test {

/// Voxels of both hips of a body, in the numbers of TotalSegmentator's total.
struct WholePelvis {
  VoxelGrid grid;
  std::vector<std::uint8_t> labels;  ///< 75 and 76 the left and the right femur, 77 and 78 the hip bones
};

/// A right hip (labels 76 and 78), in a grid whose i runs to the left, with its mirror image as the left hip beside it.
inline WholePelvis with_mirror_image(const io::LabelMap& right) {
  const auto [ni, nj, nk] = right.grid.size;
  WholePelvis pelvis{right.grid, {}};
  pelvis.grid.size[0] = 2 * ni;
  pelvis.labels.reserve(static_cast<std::size_t>(2 * ni * nj * nk));
  for (std::int64_t row = 0; row < nj * nk; ++row)
    for (std::int64_t i = 0; i < 2 * ni; ++i) {
      const bool is_right = i < ni;
      const std::int64_t from = ni * row + (is_right ? i : 2 * ni - 1 - i);
      const std::uint32_t label = right.labels[right.layers[0][static_cast<std::size_t>(from)]];
      pelvis.labels.push_back(static_cast<std::uint8_t>(label == 0 || is_right ? label : label - 1));
    }
  return pelvis;
}

}  // namespace condyle::test
