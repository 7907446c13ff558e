#pragma once

#include <limits>
#include <optional>

#include "condyle/pose.hpp"
#include "mesh/triangle_distance.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::mesh {

/// Where two surfaces are nearest to each other.
struct ClosestPoints {
  double distance_mm;            ///< 0 if they meet
  Index a_triangle, b_triangle;  ///< numbers of the meshes
  Vec3 a_point, b_point;  ///< both in the frame of A; where the surfaces meet, points of these triangles
};

/// Closest points of two surfaces, B placed by X_AB; empty if one has no triangles. Whether they meet is decided
/// exactly for B's corners as placed, each coordinate rounded; distances are rounded to 1e-12 of the coordinates.
/// Near linear in the triangles that lie within the answer of each other.
///
/// `at_most_mm`: more than the distance is known to be. The answer is the same, down to which of several nearest pairs it names,
/// and sooner found; empty if the distance is not less.
std::optional<ClosestPoints> closest_points(const TriangleTree& a, const TriangleTree& b, const Pose& X_AB,
                                            double at_most_mm = std::numeric_limits<double>::infinity());

}  // namespace condyle::mesh
