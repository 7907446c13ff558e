#pragma once

#include <bit>

#include "condyle/mesh.hpp"
#include "support/test.hpp"

/// Apart from test_meshes.hpp, which programs without a test framework build too.

namespace condyle::test {

/// Equal to the bit, the sign of 0 included.
inline void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b,
                             std::string_view where = "") {
  ASSERT_EQ(a.size(), b.size()) << where;
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i])) << where << ", " << i;
}

inline void expect_same_bits(const TriMesh& a, const TriMesh& b, std::string_view where = "") {
  expect_same_bits(a.vertices.x, b.vertices.x, where);
  expect_same_bits(a.vertices.y, b.vertices.y, where);
  expect_same_bits(a.vertices.z, b.vertices.z, where);
  EXPECT_EQ(a.triangles, b.triangles) << where;
}

}  // namespace condyle::test
