#pragma once

#include "condyle/pressure.hpp"
#include "support/test.hpp"

/// A ball in a hemispherical cup, whose contact has a closed form.

namespace condyle::test {

inline Pose translated(const Vec3& by) {
  return Pose(Eigen::Translation3d(by));
}

/// A layer with M / h = K, MPa per mm.
inline contact::ElasticLayer layer_of_stiffness(double K) {
  return {K, 0.0, 1.0};
}

/// So that the vertices of one sphere are nowhere in line with those of another.
inline Pose generic_turn() {
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return X;
}

/// The lower half (y < 0) of sphere(0, radius, levels), seen from inside: an open sheet, normals towards the centre.
inline TriMesh cup(double radius, int levels) {
  TriMesh ball = sphere(Vec3::Zero(), radius, levels);
  std::erase_if(ball.triangles, [&](const Triangle& t) {
    return ball.vertices.y[t[0]] + ball.vertices.y[t[1]] + ball.vertices.y[t[2]] > 0;
  });
  return flipped(std::move(ball));
}

/// A ball of radius r in a cup of radius R, moved by d along the cup's axis; pressure K times the overlap along cup radii.
struct BallInCup {
  double R, r, d, K;

  /// Cosine, from the axis, of where the contact ends: |x (R, angle) - d| = r.
  double edge() const { return (R * R + d * d - r * r) / (2 * R * d); }
  double force() const {
    const double x = edge(), s = R - d * x;
    return 2 * std::numbers::pi * R * R * K *
           (d * (1 - x * x * x) / 3 + (r * r * r - s * s * s) / (3 * d * d) - R * (1 - x * x) / 2);
  }
  double peak() const { return K * (d - R + r); }
  double area() const { return 2 * std::numbers::pi * R * R * (1 - edge()); }
};

}  // namespace condyle::test
