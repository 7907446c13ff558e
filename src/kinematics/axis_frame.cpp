#include "condyle/pose.hpp"

#include "condyle/error.hpp"
#include "condyle/mesh.hpp"
#include "core/coordinate_range.hpp"
#include "core/ordered_sums.hpp"

namespace condyle {
namespace {

/// The frame's x for a given z: a coordinate axis where z is one, so that the rotation is then an exact
/// permutation.
Vec3 frame_x(const Vec3& z) {
  int largest = 0;
  z.cwiseAbs().maxCoeff(&largest);
  const Vec3 next = Vec3::Unit((largest + 1) % 3);
  const Vec3 across = next - core::ordered_dot(next, z) * z;
  return across / core::ordered_norm(across);
}

/// Unit vector along v; the coordinate axis itself, exactly, where v lies on one. Scaled first: no overflow
/// on the way.
Vec3 unit(const Vec3& v) {
  const Vec3 scaled = v / v.cwiseAbs().maxCoeff();
  return scaled / core::ordered_norm(scaled);
}

}  // namespace

AxisFrame::AxisFrame(const Vec3& point, const Vec3& direction) : point_(point) {
  if (!point.allFinite() || !direction.allFinite())
    throw UsageError("joint axis: a coordinate is not finite");
  if (point.cwiseAbs().maxCoeff() > core::largest_coordinate)
    throw UsageError("joint axis: its point is beyond 1e30 mm");
  if (direction.isZero(0)) throw UsageError("joint axis: its direction is zero");
  const Vec3 z = unit(direction), x = frame_x(z);
  rotation_.row(0) = x;
  rotation_.row(1) = z.cross(x);
  rotation_.row(2) = z;
}

}  // namespace condyle
