#include "measure/sample_shape.hpp"

#include <cmath>
#include <numbers>

#include "measure/degree.hpp"
#include "sample/hip_bone_shape.hpp"

namespace condyle::test {
double lateral_edge_of_shape(const sample::Field& hip_bone, double R) {
  const auto is_wall = [&](double angle_deg) {
    const Vec3 towards(0, std::cos(angle_deg * measure::degree), std::sin(angle_deg * measure::degree));
    for (double far = R; far < R + 10; far += 0.02)
      if (hip_bone(far * towards).value <= 0) return true;
    return false;
  };
  double wall = 0, none = 70;
  while (none - wall > 0.005) (is_wall((wall + none) / 2) ? wall : none) = (wall + none) / 2;
  return wall;
}

double lateral_edge_by_formula(const sample::HipParameters& hip) {
  // As hip_bone_shape.cpp has them: seams of the rim's plane with the cavity and with the shell, and the wall's thickness, in a socket
  // of 27.5 mm.
  constexpr double inner_seam = 4, outer_seam = 6, wall = 8, nominal = 27.5;
  const sample::Socket socket = sample::socket_of(hip);
  const double S = socket.radius, scale = S / nominal, h = socket.rim_offset;
  // c, the cosine between opening and edge: c (S + s / (1 + c)) = h, or c (S + w - s / (1 - c)) = h.
  const double sign = h >= 0 ? 1 : -1;
  const double far = h >= 0 ? S : S + wall * scale, seam = (h >= 0 ? inner_seam : outer_seam) * scale;
  const double b = far + sign * (seam - h);
  const double c = sign * (std::sqrt(b * b + sign * 4 * far * h) - b) / (2 * far);
  const Vec3& o = socket.opening;
  return (std::atan2(-o.y(), o.z()) + std::asin(c / std::hypot(o.y(), o.z()))) / measure::degree;
}

Vec3 neck_of_shape(const sample::Field& femur, const Vec3& about, double radius) {
  const Vec3 x = about.unitOrthogonal(), y = about.cross(x);
  constexpr int turns = 720;
  Vec3 area = Vec3::Zero();
  for (int k = 0; k < turns; ++k) {
    const double turn = 2 * std::numbers::pi * k / turns;
    const Vec3 side = std::cos(turn) * x + std::sin(turn) * y;
    const auto is_bone = [&](double angle) {
      return femur(radius * (std::cos(angle) * about + std::sin(angle) * side)).value <= 0;
    };
    double bone = 0;
    while (is_bone(bone + measure::degree)) bone += measure::degree;
    double none = bone + measure::degree;
    for (int i = 0; i < 30; ++i) (is_bone((bone + none) / 2) ? bone : none) = (bone + none) / 2;
    // The integrals of sin a cos a and sin^2 a up to there.
    const double s = std::sin(bone), c = std::cos(bone);
    area += s * s / 2 * about + (bone - s * c) / 2 * side;
  }
  return area.normalized();
}

double alpha_of_shape(const sample::Field& femur, double R, const Vec3& neck, const Vec3& out,
                      double tolerance) {
  const auto solid_beyond = [&](double angle) {
    const Vec3 towards = std::cos(angle) * neck + std::sin(angle) * out;
    for (double far = R + tolerance; far < 1.6 * R; far += 0.25)
      if (femur(far * towards).value <= 0) return true;
    return false;
  };
  double angle = 15 * measure::degree;
  while (solid_beyond(angle)) angle += 0.02 * measure::degree;
  double low = angle - 0.02 * measure::degree, high = angle;
  for (int i = 0; i < 20; ++i) (solid_beyond((low + high) / 2) ? low : high) = (low + high) / 2;
  return high / measure::degree;
}

}  // namespace condyle::test
