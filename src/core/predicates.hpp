#pragma once

#include <cmath>

#include "condyle/pose.hpp"

/// Signs that decide, exact for the doubles they are given, always: first in double with an error bound, and
/// where that is too close to call, in integers of unlimited size. Works for all finite input, subnormal and
/// huge alike.

namespace condyle::core {

enum class Sign : signed char { negative = -1, zero = 0, positive = 1 };

constexpr Sign operator-(Sign s) noexcept {
  return static_cast<Sign>(-static_cast<int>(s));
}
constexpr Sign operator*(Sign a, Sign b) noexcept {
  return static_cast<Sign>(static_cast<int>(a) * static_cast<int>(b));
}
constexpr Sign sign_of(double value) noexcept {
  return value > 0 ? Sign::positive : value < 0 ? Sign::negative : Sign::zero;
}

namespace exact {
Sign determinant_2x2(double a, double b, double c, double d) noexcept;
Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c) noexcept;
Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept;
Sign orientation_2d(double ax, double ay, double bx, double by, double cx, double cy) noexcept;
}  // namespace exact

/// Half the distance from 1 to the next double: the relative rounding error of one operation.
inline constexpr double rounding_unit = 0x1p-53;

/// Below this a bound made of products may itself have lost digits to underflow: decide exactly instead.
inline constexpr double filter_floor = 0x1p-900;

/// Sign of a d - b c.
///
/// Two products and a difference err by at most (1 + u)(2u) (|ad| + |bc|); 4u covers the rounding of the sum
/// too.
inline Sign determinant_2x2(double a, double b, double c, double d) noexcept {
  const double ad = a * d, bc = b * c, value = ad - bc;
  const double magnitude = std::abs(ad) + std::abs(bc);
  if (std::abs(value) > 4 * rounding_unit * magnitude && magnitude > filter_floor) return sign_of(value);
  return exact::determinant_2x2(a, b, c, d);
}

/// Value of a . (b x c), with its sign certain where `certain`.
struct FilteredDeterminant {
  double value;
  bool certain;
};

/// det[a b c] = a . (b x c): six times the volume of the tetrahedron 0 a b c. Exchanging two arguments
/// negates `value` to the last bit: (b x c) is formed from products rounded one by one.
///
/// Each of the three terms a_i (b_j c_k - b_k c_j) errs by at most 3u of its magnitude, two additions add 2u:
/// 8u covers that and the rounding of the bound itself (Shewchuk 1997, section 4, has the tighter constants).
inline FilteredDeterminant filtered_determinant(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const double yz = b.y() * c.z(), zy = b.z() * c.y();
  const double zx = b.z() * c.x(), xz = b.x() * c.z();
  const double xy = b.x() * c.y(), yx = b.y() * c.x();
  const double value = (a.x() * (yz - zy) + a.y() * (zx - xz)) + a.z() * (xy - yx);
  const double magnitude =
      (std::abs(a.x()) * (std::abs(yz) + std::abs(zy)) + std::abs(a.y()) * (std::abs(zx) + std::abs(xz))) +
      std::abs(a.z()) * (std::abs(xy) + std::abs(yx));
  return {value, std::abs(value) > 8 * rounding_unit * magnitude && magnitude > filter_floor};
}

/// Sign of det[a b c].
inline Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const auto filtered = filtered_determinant(a, b, c);
  return filtered.certain ? sign_of(filtered.value) : exact::orientation(a, b, c);
}

/// Sign of (b - a) x (c - a) . (d - a): positive where d lies on the side to which triangle abc, seen
/// counter-clockwise, points its normal.
///
/// Bound of Shewchuk 1997 for orient3d, (7 + 56u) u, rounded up to 8u.
inline Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  const auto filtered = filtered_determinant(d - a, b - a, c - a);
  return filtered.certain ? sign_of(filtered.value) : exact::orientation(a, b, c, d);
}

/// Sign of (b - a) x (c - a) in the plane: positive where a, b, c are counter-clockwise.
inline Sign orientation_2d(double ax, double ay, double bx, double by, double cx, double cy) noexcept {
  const double left = (bx - ax) * (cy - ay), right = (by - ay) * (cx - ax), value = left - right;
  const double magnitude = std::abs(left) + std::abs(right);
  if (std::abs(value) > 4 * rounding_unit * magnitude && magnitude > filter_floor) return sign_of(value);
  return exact::orientation_2d(ax, ay, bx, by, cx, cy);
}

}  // namespace condyle::core
