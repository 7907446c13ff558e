#pragma once

#include "support/test_meshes.hpp"

namespace condyle::test {

/// A tube about the z axis of the given length, closed by flat ends: `around` quadrangles by `along`.
inline TriMesh tube(double radius, double length, int around, int along) {
  std::vector<std::array<double, 2>> profile = {{0, length / 2}};
  for (int ring = 0; ring <= along; ++ring) profile.push_back({radius, length * (0.5 - 1.0 * ring / along)});
  profile.push_back({0, -length / 2});
  return turned_solid(profile, static_cast<Index>(around));
}

}  // namespace condyle::test
