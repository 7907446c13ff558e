#include "core/predicates.hpp"

#include "core/exact_integers.hpp"

namespace condyle::core::exact {
namespace {

Integer determinant(const Integer& ax, const Integer& ay, const Integer& az, const Integer& bx,
                    const Integer& by, const Integer& bz, const Integer& cx, const Integer& cy,
                    const Integer& cz) {
  return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
}

}  // namespace

Sign determinant_2x2(double a, double b, double c, double d) noexcept {
  const auto v = to_integers<4>({a, b, c, d});
  return sign_of(Integer(v[0] * v[3] - v[1] * v[2]));
}

Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const auto v = to_integers<9>({a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z()});
  return sign_of(determinant(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]));
}

Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  const auto v =
      to_integers<12>({a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z(), d.x(), d.y(), d.z()});
  return sign_of(determinant(v[9] - v[0], v[10] - v[1], v[11] - v[2], v[3] - v[0], v[4] - v[1], v[5] - v[2],
                             v[6] - v[0], v[7] - v[1], v[8] - v[2]));
}

Sign orientation_2d(double ax, double ay, double bx, double by, double cx, double cy) noexcept {
  const auto v = to_integers<6>({ax, ay, bx, by, cx, cy});
  return sign_of(Integer((v[2] - v[0]) * (v[5] - v[1]) - (v[3] - v[1]) * (v[4] - v[0])));
}

}  // namespace condyle::core::exact
