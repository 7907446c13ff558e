#include "measure/analytic_hip.hpp"
#include "measure/degree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace condyle::test {
namespace {

/// Rings of points about an axis between two poles, outwards if they go from the axis's far end to its tip.
TriMesh closed_rings(const Vec3& first, const std::vector<std::vector<Vec3>>& rings, const Vec3& last) {
  TriMesh mesh;
  mesh.vertices.push_back(first);
  for (const auto& ring : rings)
    for (const Vec3& p : ring) mesh.vertices.push_back(p);
  mesh.vertices.push_back(last);
  const auto count = static_cast<Index>(rings.front().size());
  const auto at = [&](std::size_t ring, Index k) { return 1 + static_cast<Index>(ring) * count + k % count; };
  const auto end = static_cast<Index>(mesh.vertices.size() - 1);
  for (Index k = 0; k < count; ++k) {
    mesh.triangles.push_back({0, at(0, k + 1), at(0, k)});
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      mesh.triangles.push_back({at(r, k), at(r, k + 1), at(r + 1, k + 1)});
      mesh.triangles.push_back({at(r, k), at(r + 1, k + 1), at(r + 1, k)});
    }
    mesh.triangles.push_back({at(rings.size() - 1, k), at(rings.size() - 1, k + 1), end});
  }
  return mesh;
}

}  // namespace

TriMesh revolved(const Vec3& axis, const std::vector<ProfilePoint>& profile, int facets) {
  const Vec3 x = axis.unitOrthogonal(), y = axis.cross(x);
  std::vector<std::vector<Vec3>> rings;
  for (std::size_t i = 1; i + 1 < profile.size(); ++i) {
    rings.emplace_back();
    for (int k = 0; k < facets; ++k) {
      const double turn = 2 * std::numbers::pi * k / facets;
      rings.back().push_back(profile[i].along * axis +
                             profile[i].beside * (std::cos(turn) * x + std::sin(turn) * y));
    }
  }
  return closed_rings(profile.front().along * axis, rings, profile.back().along * axis);
}

TriMesh star_shaped(const Vec3& axis, const Vec3& zero,
                    const std::function<double(double from_axis, double turn)>& distance) {
  const Vec3 quarter = axis.cross(zero);
  std::vector<std::vector<Vec3>> rings;
  for (int i = 179; i >= 1; --i) {
    rings.emplace_back();
    for (int k = 0; k < 360; ++k) {
      const double from_axis = i * measure::degree, turn = k * measure::degree;
      rings.back().push_back(distance(from_axis, turn) *
                             (std::cos(from_axis) * axis +
                              std::sin(from_axis) * (std::cos(turn) * zero + std::sin(turn) * quarter)));
    }
  }
  return closed_rings(-distance(std::numbers::pi, 0) * axis, rings, distance(0, 0) * axis);
}

TriMesh head_with_cone(const Vec3& neck, double R, double r0, double m) {
  const double junction = std::asin(r0 / (R * std::sqrt(1 + m * m))) + std::atan(m);
  std::vector<ProfilePoint> profile{{-R, 0}};
  for (int i = 179; i * measure::degree > junction + 0.1 * measure::degree; --i)
    profile.push_back({R * std::cos(i * measure::degree), R * std::sin(i * measure::degree)});
  profile.push_back({R * std::cos(junction), R * std::sin(junction)});
  constexpr double end = 70;
  for (double along = std::ceil(R * std::cos(junction)) + 1; along < end; along += 1)
    profile.push_back({along, r0 + m * along});
  profile.push_back({end, r0 + m * end});
  profile.push_back({end, 0});
  return revolved(neck, profile);
}

TriMesh sharp_cup(const Vec3& opening, double S, double h) {
  const double rim = std::acos(-h / S);  // from -opening
  std::vector<ProfilePoint> profile;
  // Outwards is away from the wall: along the outer side from behind to the rim, and back inside.
  constexpr double thick = 8;
  const int steps = static_cast<int>(std::floor(rim / measure::degree));
  for (int i = 0; i <= steps; ++i) {
    const double at = i * measure::degree, radius = S + thick * (1 - at / rim);
    profile.push_back({-radius * std::cos(at), radius * std::sin(at)});
  }
  profile.push_back({h, S * std::sin(rim)});
  for (int i = steps; i >= 0; --i)
    profile.push_back({-S * std::cos(i * measure::degree), S * std::sin(i * measure::degree)});
  return revolved(opening, profile);
}

Vec3 opening_of(double inclination_deg, double version_deg) {
  const double I = inclination_deg * measure::degree, V = version_deg * measure::degree;
  return {std::sin(I) * std::sin(V), -std::cos(I), std::sin(I) * std::cos(V)};
}

Joint hip_of(TriMesh hip_bone, TriMesh femur) {
  return {
      "hip", JointKind::ball, Side::right, {"hip bone", std::move(hip_bone)}, {"femur", std::move(femur)}};
}

Joint mirrored_hip(const Joint& hip) {
  const auto mirrored = [](TriMesh mesh) {
    for (double& z : mesh.vertices.z) z = -z;
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
  };
  Joint other = hip;
  other.side = hip.side == Side::right ? Side::left : Side::right;
  other.fixed = {hip.fixed.name, mirrored(hip.fixed.mesh)};
  other.mobile = {hip.mobile.name, mirrored(hip.mobile.mesh)};
  return other;
}

}  // namespace condyle::test
