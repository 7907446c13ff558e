#pragma once

#include <array>

#include "condyle/pose.hpp"

namespace condyle::mesh {

using TriangleCorners = std::array<Vec3, 3>;

/// Whether two closed triangles share a point; touching in one point counts. Exact for the doubles given.
///
/// Two triangles meet exactly where an edge of one meets the other, so up to six segment-triangle tests
/// decide, each of them signs of orientations; triangles wholly on one side of the other's plane leave first.
/// A triangle of exactly zero area meets nothing here: its points all belong to its neighbours in a closed
/// mesh.
bool triangles_intersect(const TriangleCorners& a, const TriangleCorners& b) noexcept;

/// Whether p, exactly in the plane of the triangle, lies in the closed triangle. False for a triangle of zero
/// area.
bool contains_coplanar(const TriangleCorners& t, const Vec3& p) noexcept;

}  // namespace condyle::mesh
