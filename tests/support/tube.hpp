#pragma once

#include <cmath>

#include "condyle/angle.hpp"
#include "condyle/mesh.hpp"

namespace condyle::test {

/// A tube about the z axis of the given length, closed by flat ends: `around` quadrangles by `along`.
inline TriMesh tube(double radius, double length, int around, int along) {
  TriMesh mesh;
  const auto vertex = [&](int ring, int k) { return static_cast<Index>(ring * around + k % around); };
  for (int ring = 0; ring <= along; ++ring)
    for (int k = 0; k < around; ++k) {
      const double turn = two_pi * k / around;
      mesh.vertices.push_back(
          {radius * std::cos(turn), radius * std::sin(turn), length * (1.0 * ring / along - 0.5)});
    }
  for (int ring = 0; ring < along; ++ring)
    for (int k = 0; k < around; ++k) {
      mesh.triangles.push_back({vertex(ring, k), vertex(ring, k + 1), vertex(ring + 1, k + 1)});
      mesh.triangles.push_back({vertex(ring, k), vertex(ring + 1, k + 1), vertex(ring + 1, k)});
    }
  for (int k = 1; k + 1 < around; ++k) {
    mesh.triangles.push_back({vertex(0, 0), vertex(0, k + 1), vertex(0, k)});
    mesh.triangles.push_back({vertex(along, 0), vertex(along, k), vertex(along, k + 1)});
  }
  return mesh;
}

}  // namespace condyle::test
