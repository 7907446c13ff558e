#pragma once

#include <gtest/gtest.h>

#include "condyle/inspect.hpp"

namespace condyle::test {

/// Closed, manifold, wound alike, without degenerate and duplicate elements.
inline void expect_sound(const MeshReport& report) {
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.boundary_edges.count, 0u);
  EXPECT_EQ(report.boundary_loops.count, 0u);
  EXPECT_EQ(report.non_manifold_edges.count, 0u);
  EXPECT_EQ(report.non_manifold_vertices.count, 0u);
  EXPECT_EQ(report.inconsistent_edges.count, 0u);
  EXPECT_EQ(report.duplicate_triangles.count, 0u);
  EXPECT_EQ(report.degenerate_triangles.count, 0u);
  EXPECT_EQ(report.unreferenced_vertices.count, 0u);
  EXPECT_EQ(report.duplicate_vertices.count, 0u);
}

}  // namespace condyle::test
