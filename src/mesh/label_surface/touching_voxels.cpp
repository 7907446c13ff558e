#include <algorithm>
#include <array>

#include "condyle/error.hpp"
#include "condyle/label_surface.hpp"
#include "mesh/label_surface/mask_checks.hpp"

namespace condyle {
namespace {

using Voxel = std::array<std::int64_t, 3>;

bool is_inside(const VoxelMask& mask, const Voxel& image_voxel) {
  std::array<std::int64_t, 3> at;
  for (std::size_t a = 0; a < 3; ++a) {
    at[a] = image_voxel[a] - mask.first[a];
    if (at[a] < 0 || at[a] >= mask.size[a]) return false;
  }
  return mask.inside[static_cast<std::size_t>((at[2] * mask.size[1] + at[1]) * mask.size[0] + at[0])] != 0;
}

}  // namespace

TouchingVoxels touching_voxels(const VoxelMask& a, const VoxelMask& b) {
  mesh::check_mask(a);
  mesh::check_mask(b);
  if (a.image.size != b.image.size || a.image.X_WI.matrix() != b.image.X_WI.matrix())
    throw UsageError("labels: they are of different images");
  // Voxels of a with a neighbour in the box of b.
  Voxel low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::max(a.first[i], b.first[i] - 1);
    high[i] = std::min(a.first[i] + a.size[i], b.first[i] + b.size[i] + 1);
  }
  TouchingVoxels found;
  Vec3 sum = Vec3::Zero();
  for (std::int64_t k = low[2]; k < high[2]; ++k) {
    for (std::int64_t j = low[1]; j < high[1]; ++j) {
      for (std::int64_t i = low[0]; i < high[0]; ++i) {
        const Voxel at{i, j, k};
        if (!is_inside(a, at)) continue;
        found.shared += is_inside(b, at);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          for (const int step : {-1, 1}) {
            Voxel next = at;
            next[axis] += step;
            if (!is_inside(b, next)) continue;
            ++found.faces;
            for (Eigen::Index c = 0; c < 3; ++c) {
              const auto n = static_cast<std::size_t>(c);
              sum[c] += static_cast<double>(at[n] + next[n]) / 2;
            }
          }
        }
      }
    }
  }
  if (found.faces > 0) found.centre = a.image.X_WI * (sum / static_cast<double>(found.faces));
  return found;
}

}  // namespace condyle
