#pragma once

#include <random>

#include "condyle/mesh.hpp"

namespace condyle::test {

/// Triangles of all sizes, each by itself: one in three flat in z, one in three on a coarse lattice, which
/// puts corners on the borders of cells; `shift` away from the axis.
inline TriMesh triangles_of_all_sizes(std::mt19937& random, double shift, double scale) {
  std::uniform_real_distribution<double> uniform(-1, 1), weight(0, 1);
  TriMesh mesh;
  for (Index t = 0; t < 300; ++t) {
    const Vec3 centre(uniform(random) + shift, uniform(random), uniform(random));
    const double size = std::exp2(-6 * weight(random));
    for (Index k = 0; k < 3; ++k) {
      Vec3 p = centre + size * Vec3(uniform(random), uniform(random), t % 3 ? uniform(random) : 0);
      if (t % 3 == 2) p = (p * 4).array().round() / 4;
      mesh.vertices.push_back(scale * p);
    }
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

}  // namespace condyle::test
