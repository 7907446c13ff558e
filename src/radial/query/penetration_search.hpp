#pragma once

#include "condyle/pose.hpp"
#include "radial/query/penetration_passes.hpp"
#include "radial/query/point_blocks.hpp"

namespace condyle::radial {

/// One question on its way through the passes: what they read, and the room that they write to.
struct PenetrationSearch {
  CubeView cube;
  PointColumns columns;
  FloatPose pose;
  float form_bound;  ///< for inside_points
  NearPoints near;
  FoundPoints found;
};

/// The pose about the points' own centre.
FloatPose float_pose(const Pose& X, const Vec3& centre);

PointColumns points_of(const PointBlocks& points);
BlockColumns blocks_of(const PointBlocks& points, std::size_t level);

}  // namespace condyle::radial
