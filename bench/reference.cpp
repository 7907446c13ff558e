#include "reference.hpp"

#include <utility>

namespace bench {

using condyle::Index;
using condyle::PointState;

Reference::Reference(const Bodies& bodies, std::vector<condyle::Pose> poses)
    : fixed_(&bodies.fixed),
      mobile_(&bodies.mobile),
      poses_(std::move(poses)),
      winding_(bodies.fixed),
      radial_(bodies.fixed),
      pair_(bodies.fixed, bodies.mobile) {}

const std::vector<Reference::Inside>& Reference::inside(std::size_t pose) {
  const auto [at, is_new] = inside_.try_emplace(pose);
  if (is_new) {
    const auto windings = winding_.at(condyle::posed(poses_[pose], mobile_->vertices.view()));
    for (std::size_t v = 0; v < windings.size(); ++v)
      if (windings[v].state != PointState::outside)
        at->second.push_back({static_cast<Index>(v), windings[v].state == PointState::on_surface});
  }
  return at->second;
}

condyle::Points Reference::inside_points(std::size_t pose) {
  condyle::Points points;
  for (const Inside& i : inside(pose))
    points.push_back(condyle::posed(poses_[pose], mobile_->vertices[i.vertex]));
  return points;
}

const std::vector<double>& Reference::depths(std::size_t pose, DepthKind kind) {
  const auto [at, is_new] = depths_.try_emplace({pose, kind});
  if (!is_new) return at->second;
  const condyle::Points points = inside_points(pose);
  std::vector<double>& depths = at->second;
  switch (kind) {
    case DepthKind::along_ray:
      for (const double gap : radial_.query(points).radial_gap_mm) depths.push_back(-gap);
      break;
    case DepthKind::along_arc:
      if (!rings_) rings_ = std::make_unique<condyle::tangential::RingTable>(*fixed_, arc_axis());
      for (const double gap : rings_->query(points).arc_gap_mm) depths.push_back(-gap);
      break;
    case DepthKind::nearest_surface:
      if (!distance_) distance_ = std::make_unique<condyle::mesh::SurfaceDistance>(*fixed_);
      for (std::size_t i = 0; i < points.size(); ++i) depths.push_back((*distance_)(points[i]));
      break;
    case DepthKind::none:
      break;
  }
  return depths;
}

const std::vector<condyle::contact::TrianglePair>& Reference::pairs(std::size_t pose) {
  const auto [at, is_new] = pairs_.try_emplace(pose);
  if (is_new) at->second = pair_.pairs(poses_[pose]);
  return at->second;
}

}  // namespace bench
