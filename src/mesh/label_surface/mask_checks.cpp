#include "mesh/label_surface/mask_checks.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "condyle/error.hpp"

namespace condyle::mesh {

void check_mask(const VoxelMask& mask) {
  const auto& X_WI = mask.image.X_WI.matrix();
  const double det = mask.image.X_WI.linear().determinant();
  if (!X_WI.allFinite() || !std::isfinite(det) || det == 0)
    throw UsageError("label: the grid's matrix is not finite or not invertible");
  std::int64_t voxels = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t first = mask.first[a], size = mask.size[a], image = mask.image.size[a];
    if (!(size > 0 && first >= 0 && image >= size && first <= image - size))
      throw UsageError("label: the box of its voxels is not within the image along axis " +
                       std::to_string(a));
    // More than any computer holds.
    if (size > (std::int64_t{1} << 40) / voxels) throw UsageError("label: the box has more than 2^40 voxels");
    voxels *= size;
  }
  if (mask.inside.size() != static_cast<std::size_t>(voxels))
    throw UsageError("label: " + std::to_string(mask.inside.size()) + " voxels for a box of " +
                     std::to_string(voxels));
  const auto bad = std::find_if(mask.inside.begin(), mask.inside.end(), [](std::uint8_t v) { return v > 1; });
  if (bad != mask.inside.end())
    throw UsageError("label: voxel " + std::to_string(bad - mask.inside.begin()) +
                     " of the box is neither 0 nor 1");
}

}  // namespace condyle::mesh
