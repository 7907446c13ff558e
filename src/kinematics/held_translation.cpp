#include "condyle/joint.hpp"

#include <utility>

namespace condyle {

Joint held_at(const Joint& joint, const Vec3& translation_mm) {
  Joint held = joint;
  if (translation_mm == Vec3::Zero()) return held;
  Points points = joint.fixed.mesh.vertices();
  for (std::size_t v = 0; v < points.size(); ++v) points.set(v, points[v] - translation_mm);
  held.fixed.mesh = joint.fixed.mesh.moved_to(std::move(points));
  if (held.fixed.image)
    for (ImageCut& cut : held.fixed.image->cuts) cut.offset_mm -= cut.normal.dot(translation_mm);
  return held;
}

}  // namespace condyle
