#include "condyle/pose.hpp"

namespace condyle {

void posed(const Pose& X, PointsView points, Points& out) {
  const std::size_t count = points.size();
  out.x.resize(count), out.y.resize(count), out.z.resize(count);
  for (std::size_t i = 0; i < count; ++i) out.set(i, posed(X, points[i]));
}

Points shifted(Points points, const Vec3& by) {
  for (std::size_t v = 0; v < points.size(); ++v) points.set(v, points[v] + by);
  return points;
}

Points posed(const Pose& X, PointsView points) {
  Points out;
  posed(X, points, out);
  return out;
}

}  // namespace condyle
