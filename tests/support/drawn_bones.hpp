#pragma once

#include "condyle/label_surface.hpp"
#include "condyle/mesh.hpp"
#include "support/test.hpp"
#include "support/voxel_masks.hpp"

/// Bones drawn as solids with known axes, extracted from voxels of 1.5 mm: X anterior, Y superior, Z to the right, the
/// joint centre at the origin, of a right joint.

namespace condyle::test {

/// Whether p lies in a straight rod of this radius between two points.
inline bool in_rod(const Vec3& p, const Vec3& from, const Vec3& to, double radius) {
  const Vec3 along = to - from, q = p - from;
  const double t = q.dot(along) / along.squaredNorm();
  return t >= 0 && t <= 1 && (q - t * along).norm() <= radius;
}

template <class IsInside>
TriMesh drawn(const Vec3& low, const Vec3& high, const IsInside& is_inside) {
  constexpr double voxel = 1.5;
  Eigen::Affine3d X_WI = Eigen::Affine3d::Identity();
  X_WI.linear() *= voxel;
  X_WI.translation() = low;
  const Vec3 size = (high - low) / voxel;
  const Voxels3 voxels{static_cast<std::int64_t>(size.x()), static_cast<std::int64_t>(size.y()),
                       static_cast<std::int64_t>(size.z())};
  return surface_of(mask_where(
                        voxels, [&](const Vec3& p) { return is_inside(X_WI * p); }, X_WI))
      .mesh;
}

struct DrawnFemur {
  double radius = 20;
  double length = 110;      ///< of the shaft above the axis
  double lean_deg = 6;      ///< of the shaft, to the side
  double ridge = 4;         ///< by which the trochlea's lateral side stands in front
  double shaft_ahead = 22;  ///< of the shaft's line in front of the axis
};

/// Two discs about Z with a notch between, a block that joins them in front, a shaft above.
inline TriMesh femur_of(const DrawnFemur& femur) {
  const double lean = std::tan(femur.lean_deg * std::numbers::pi / 180);
  return drawn({-32, -30, -42}, {52, femur.length + 6, 48}, [&](const Vec3& p) {
    const double beside = std::abs(p.z());
    if (beside >= 10 && beside <= 33 && std::hypot(p.x(), p.y()) <= femur.radius) return true;
    const double front = p.z() > 6 ? 36 + femur.ridge : p.z() < -6 ? 36 : 33;
    if (beside <= 33 && p.x() >= 4 && p.x() <= front && p.y() >= -8 && p.y() <= 36) return true;
    return in_rod(p, Vec3(femur.shaft_ahead, 20, 20 * lean),
                  Vec3(femur.shaft_ahead, femur.length, femur.length * lean), 15);
  });
}

inline TriMesh tibia_of_knee() {
  return drawn({-40, -110, -42}, {48, -18, 42}, [](const Vec3& p) {
    return (std::abs(p.z()) <= 36 && p.x() >= -28 && p.x() <= 24 && p.y() <= -23 && p.y() >= -45) ||
           in_rod(p, Vec3(2, -40, 0), Vec3(2, -104, 0), 14);
  });
}

/// A body with a saddle-free dome of radius 20 about Z, a head in front.
inline TriMesh talus(double head = 34) {
  return drawn({-34, -32, -24}, {52, 28, 24}, [&](const Vec3& p) {
    const bool dome = std::abs(p.z()) <= 15 && p.y() >= 3 && std::hypot(p.x(), p.y()) <= 20;
    const bool body = std::abs(p.z()) <= 15 && std::abs(p.x()) <= 19 && p.y() >= -18 && p.y() <= 4;
    return dome || body || in_rod(p, Vec3(10, -6, 0), Vec3(head, -12, 0), 9);
  });
}

inline TriMesh tibia_of_ankle(double length = 120) {
  return drawn({-30, 2, -30}, {30, length + 6, 30}, [&](const Vec3& p) {
    return std::hypot(p.x(), p.y()) >= 23 && (in_rod(p, Vec3(0, 10, 0), Vec3(0, 45, 0), 21) ||
                                              in_rod(p, Vec3(0, 30, 0), Vec3(0, length, 0), 13));
  });
}

inline TriMesh humerus_at_shoulder() {
  return drawn({-34, -130, -34}, {34, 30, 40}, [](const Vec3& p) {
    return p.norm() <= 24 || in_rod(p, Vec3(0, -8, 8), Vec3(0, -124, 8), 12);
  });
}

/// A plate with a hollow of radius 30 that faces the humerus, to the right.
inline TriMesh scapula(double hollow = 30) {
  return drawn({-26, -84, -78}, {26, 30, -18}, [&](const Vec3& p) {
    const bool neck = std::abs(p.x()) <= 14 && std::abs(p.y()) <= 18 && p.z() <= -20 && p.z() >= -45;
    const bool blade = std::abs(p.x()) <= 6 && p.y() <= 24 && p.y() >= -78 && p.z() <= -38 && p.z() >= -72;
    return (neck && (p - Vec3(0, 0, hollow - 27)).norm() >= hollow) || blade;
  });
}

/// A trochlea about Z of radius 10, in front of the shaft.
inline TriMesh humerus_at_elbow(double length = 120) {
  return drawn({-34, -16, -30}, {18, length + 6, 30}, [&](const Vec3& p) {
    const bool trochlea = std::abs(p.z()) <= 22 && std::hypot(p.x(), p.y()) <= 10;
    const bool flare = std::abs(p.z()) <= 20 && p.x() >= -14 && p.x() <= -2 && p.y() >= 4 && p.y() <= 30;
    return trochlea || flare || in_rod(p, Vec3(-9, 20, 0), Vec3(-9, length, 0), 10);
  });
}

inline TriMesh ulna() {
  return drawn({-30, -100, -20}, {30, 24, 20}, [](const Vec3& p) {
    const double from_axis = std::hypot(p.x(), p.y());
    const bool notch =
        std::abs(p.z()) <= 11 && from_axis >= 12 && from_axis <= 22 && (p.x() < 0 || p.y() < 0) && p.x() < 14;
    return notch || (from_axis >= 12 && in_rod(p, Vec3(0, -16, 0), Vec3(0, -94, 0), 8));
  });
}

/// The mirror image, in Z: a left joint of a right one.
inline TriMesh mirrored(TriMesh mesh) {
  for (double& z : mesh.vertices.z) z = -z;
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Turned, moved, and each coordinate of each vertex off by a normal error of this deviation, mm.
inline TriMesh scanned(TriMesh mesh, const Pose& X, double noise, unsigned seed) {
  std::mt19937_64 random(seed);
  // The sum of twelve is near enough to normal, and the same everywhere.
  const auto normal = [&] {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random() >> 11) * 0x1p-53;
    return sum;
  };
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double x = normal(), y = normal(), z = normal();
    mesh.vertices.set(v, X * Vec3(mesh.vertices[v] + noise * Vec3(x, y, z)));
  }
  return mesh;
}

/// Poses all over, the same everywhere.
inline Pose any_pose(unsigned i) {
  const Eigen::Quaterniond turn(std::sin(1.0 + i), std::cos(2.3 * i), std::sin(0.7 * i + 0.4),
                                std::cos(1.9 * i + 0.2));
  Pose X = Pose::Identity();
  X.linear() = turn.normalized().toRotationMatrix();
  X.translation() = Vec3(40.0 * i, -70, 12.5 * i);
  return X;
}

inline double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

}  // namespace condyle::test
