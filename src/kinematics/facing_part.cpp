#include "kinematics/facing_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinematics/surface_points.hpp"

namespace condyle::kinematics {
namespace {

/// Vertices of a bone that is thinned: on a whole tibia some 8 mm apart, and 11 mm where it matters less.
constexpr std::size_t most_points = 2000, most_points_roughly = 1000;

std::vector<SurfacePoint> thinned(const std::vector<SurfacePoint>& points, std::size_t most) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / most);
  std::vector<SurfacePoint> kept;
  for (std::size_t i = 0; i < points.size(); i += step) kept.push_back(points[i]);
  return kept;
}

std::optional<FacingPart> facing_others(const std::vector<SurfacePoint>& points,
                                        const std::vector<SurfacePoint>& others) {
  if (points.empty() || others.empty()) return std::nullopt;
  std::vector<double> squared(points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const SurfacePoint& other : others)
      squared[i] = std::min(squared[i], (points[i].position - other.position).squaredNorm());
  const double nearest = std::sqrt(*std::min_element(squared.begin(), squared.end()));
  Vec3 moment = Vec3::Zero();
  double area = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::sqrt(squared[i]) <= nearest + facing_depth_mm) {
      moment += points[i].area * points[i].position;
      area += points[i].area;
    }
  const Vec3 centre = moment / area;
  if (!centre.allFinite()) return std::nullopt;  // coordinates beyond those of bones
  return FacingPart{centre, nearest};
}

}  // namespace

std::optional<FacingPart> facing_part(const TriMesh& bone, const TriMesh& other) {
  return facing_others(surface_points(bone, {}), thinned(surface_points(other, {}), most_points));
}

std::optional<FacingPart> facing_part_roughly(const TriMesh& bone, const TriMesh& other,
                                              const Pose& X_bone_other) {
  auto others = thinned(surface_points(other, {}), most_points_roughly);
  for (SurfacePoint& point : others) point.position = X_bone_other * point.position;
  return facing_others(thinned(surface_points(bone, {}), most_points_roughly), others);
}

}  // namespace condyle::kinematics
