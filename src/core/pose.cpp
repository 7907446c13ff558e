#include "condyle/pose.hpp"

namespace condyle {

void posed(const Pose& X, PointsView points, Points& out) {
  const std::size_t count = points.size();
  out.x.resize(count), out.y.resize(count), out.z.resize(count);
  for (std::size_t i = 0; i < count; ++i) out.set(i, posed(X, points[i]));
}

Points posed(const Pose& X, PointsView points) {
  Points out;
  posed(X, points, out);
  return out;
}

}  // namespace condyle
