#include "kinematics/facing_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinematics/surface_points.hpp"

namespace condyle::kinematics {
namespace {

/// Points of the other bone that are looked at: on a whole tibia some 8 mm apart.
constexpr std::size_t most_others = 2000;

std::vector<Vec3> thinned(const std::vector<SurfacePoint>& points) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / most_others);
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < points.size(); i += step) kept.push_back(points[i].position);
  return kept;
}

}  // namespace

std::optional<FacingPart> facing_part(const TriMesh& bone, const TriMesh& other) {
  const auto points = surface_points(bone, {});
  const auto others = thinned(surface_points(other, {}));
  if (points.empty() || others.empty()) return std::nullopt;
  std::vector<double> squared(points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const Vec3& q : others) squared[i] = std::min(squared[i], (points[i].position - q).squaredNorm());
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

}  // namespace condyle::kinematics
