#include "support/voxelised.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "condyle/label_surface.hpp"

namespace condyle::test {

VoxelGrid grid_around(const TriMesh& a, const TriMesh& b, const Eigen::Matrix3d& steps, const Vec3& through,
                      int margin) {
  const Eigen::Matrix3d to_index = steps.inverse();
  Vec3 low = Vec3::Constant(HUGE_VAL), high = -low;
  for (const TriMesh* mesh : {&a, &b})
    for (std::size_t v = 0; v < mesh->vertices.size(); ++v) {
      const Vec3 p = to_index * (mesh->vertices[v] - through);
      low = low.cwiseMin(p), high = high.cwiseMax(p);
    }
  VoxelGrid grid;
  Vec3 first;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = std::floor(low[axis]) - margin;
    grid.size[static_cast<std::size_t>(axis)] =
        static_cast<std::int64_t>(std::ceil(high[axis]) + margin - first[axis]) + 1;
  }
  grid.X_WI.linear() = steps;
  grid.X_WI.translation() = through + steps * first;
  return grid;
}

Body body_of(std::string name, const VoxelMask& mask) {
  LabelSurface surface = surface_of(mask);
  BodyImage image{mask.image.X_WI.linear(), {}};
  for (const CapPlane& cap : surface.caps) image.cuts.push_back({cap.normal, cap.offset});
  return {.name = std::move(name), .mesh = std::move(surface.mesh), .image = std::move(image)};
}

}  // namespace condyle::test
