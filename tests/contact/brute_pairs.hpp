#pragma once

#include <vector>

#include "condyle/contact.hpp"
#include "support/brute_force.hpp"

namespace condyle::test {

/// Every pair of triangles that meet, each tested with each.
inline std::vector<contact::TrianglePair> brute_pairs(const TriMesh& fixed, const TriMesh& posed_mobile) {
  std::vector<contact::TrianglePair> pairs;
  for (const auto& [f, m] : intersecting_pairs(fixed, posed_mobile)) pairs.push_back({f, m});
  return pairs;
}

}  // namespace condyle::test
