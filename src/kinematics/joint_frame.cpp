#include "condyle/make_joint.hpp"

#include <cmath>
#include <sstream>

#include "condyle/error.hpp"
#include "core/trigonometry.hpp"

namespace condyle {
namespace {

std::string text(double value) {
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // no memory is an error, not half a text
  out.precision(6);
  out << value;
  return out.str();
}

Pose frame(const Vec3& centre, const Vec3& x, const Vec3& y, const Vec3& z) noexcept {
  Pose X = Pose::Identity();
  X.linear() << x, y, z;
  X.translation() = centre;
  return X;
}

/// The direction from one landmark to another.
Vec3 direction(const Vec3& from, const Vec3& to, const char* names) {
  const Vec3 d = to - from;
  const double length = d.norm();
  if (!(length >= smallest_landmark_distance))
    throw UsageError(std::string(names) + " are " + text(length) + " mm apart: they give no direction");
  return d / length;
}

/// A right-handed frame with this axis exactly, and a second axis as near as can be to a landmark direction.
Vec3 perpendicular(const Vec3& axis, const Vec3& towards, const char* names) {
  const Vec3 across = towards - axis.dot(towards) * axis;
  const double sine = across.norm() / towards.norm();
  if (!(sine >= smallest_landmark_sine))
    throw UsageError(std::string(names) + " lie nearly on one line: they give no plane");
  return across.normalized();
}

}  // namespace

AxisErrors axis_errors(const Vec3& anterior, const Vec3& superior) noexcept {
  return {std::abs(anterior.norm() - 1), std::abs(superior.norm() - 1), std::abs(anterior.dot(superior))};
}

Pose frame_from_axes(const Vec3& centre, const Vec3& anterior, const Vec3& superior) {
  const auto error = axis_errors(anterior, superior);
  if (error.none()) return frame(centre, anterior, superior, anterior.cross(superior));
  if (!(error.anterior_length <= axis_tolerance))
    throw UsageError("anterior has length " + text(anterior.norm()) + ", not 1");
  if (!(error.superior_length <= axis_tolerance))
    throw UsageError("superior has length " + text(superior.norm()) + ", not 1");
  if (!(error.right_angle <= 2 * axis_tolerance)) {
    const double degrees = Angle::radians(core::arccosine(anterior.dot(superior))).degrees();
    throw UsageError("anterior and superior are " + text(degrees) + " degrees apart, not 90 (off by " +
                     text(std::abs(degrees - 90)) + ")");
  }
  // Half of the remaining angle is taken from each of the two, so that neither is preferred. What is left
  // after one such step is of the order of the square of the angle: below 4e-12, removed by the second.
  Vec3 x = anterior.normalized(), y = superior.normalized();
  for (int step = 0; step < 2; ++step) {
    const double half = x.dot(y) / 2;
    const Vec3 rotated = (x - half * y).normalized();
    y = (y - half * x).normalized();
    x = rotated;
  }
  return frame(centre, x, y, x.cross(y));
}

Pose frame_from_landmarks(const Vec3& centre, const PelvisLandmarks& landmarks) {
  const Vec3 z = direction(landmarks.left_asis, landmarks.right_asis, "left_asis and right_asis");
  const Vec3 asis = (landmarks.left_asis + landmarks.right_asis) / 2;
  const Vec3 psis = (landmarks.left_psis + landmarks.right_psis) / 2;
  const Vec3 forwards = direction(psis, asis, "the midpoints of the two psis and of the two asis");
  const Vec3 x = perpendicular(z, forwards, "the two asis and the midpoint of the psis");
  return frame(centre, x, z.cross(x), z);
}

Pose frame_from_landmarks(const Vec3& centre, const AnteriorPelvicPlane& landmarks) {
  const Vec3 z = direction(landmarks.left_asis, landmarks.right_asis, "left_asis and right_asis");
  const Vec3 asis = (landmarks.left_asis + landmarks.right_asis) / 2;
  const Vec3 upwards =
      direction(landmarks.pubic_symphysis, asis, "pubic_symphysis and the midpoint of the asis");
  const Vec3 y = perpendicular(z, upwards, "the two asis and pubic_symphysis");
  return frame(centre, y.cross(z), y, z);
}

Pose frame_from_landmarks(const Vec3& hip_centre, Side side, const FemurLandmarks& landmarks) {
  const auto& [medial, lateral] = landmarks;
  const Vec3 middle = (medial + lateral) / 2;
  const Vec3 y = direction(middle, hip_centre, "the midpoint of the epicondyles and the hip centre");
  const Vec3 outwards = direction(medial, lateral, "medial_epicondyle and lateral_epicondyle");
  const Vec3 z = perpendicular(y, side == Side::right ? outwards : Vec3(-outwards),
                               "the epicondyles and the hip centre");
  return frame(hip_centre, y.cross(z), y, z);
}

Pose frame_from_landmarks(Side side, const TransepicondylarAxis& landmarks) {
  const auto& [medial, lateral, hip_centre] = landmarks;
  const Vec3 middle = (medial + lateral) / 2;
  const Vec3 outwards = direction(medial, lateral, "medial_epicondyle and lateral_epicondyle");
  const Vec3 z = side == Side::right ? outwards : Vec3(-outwards);
  const Vec3 upwards = direction(middle, hip_centre, "the midpoint of the epicondyles and the hip centre");
  const Vec3 y = perpendicular(z, upwards, "the epicondyles and the hip centre");
  return frame(middle, y.cross(z), y, z);
}

}  // namespace condyle
