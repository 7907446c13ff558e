#include "reference.hpp"

#include <algorithm>
#include <queue>
#include <utility>

namespace bench {

using condyle::Index;
using condyle::PointState;

namespace {

using condyle::Vec3;

/// A body that points are held against.
struct Solid {
  const condyle::mesh::WindingNumber& winding;
  const condyle::mesh::SurfaceDistance& distance;
  Eigen::AlignedBox3d box;

  double signed_depth(const Vec3& p) const {
    const double off = distance(p);
    return winding.at(p).state == PointState::inside ? off : -off;
  }
};

Eigen::AlignedBox3d box_of(const condyle::TriMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) box.extend(mesh.vertices[v]);
  return box;
}

/// A part of a triangle; no point of it is deeper than `bound`.
struct Part {
  std::array<Vec3, 3> corners;
  double bound;
  friend bool operator<(const Part& a, const Part& b) { return a.bound < b.bound; }
};

Reference::DepthBounds deepest(const condyle::TriMesh& surface, const Solid& in, double tolerance_mm) {
  double low = 0;
  std::priority_queue<Part> parts;
  const auto consider = [&](const std::array<Vec3, 3>& c) {
    const Vec3 middle = (c[0] + c[1] + c[2]) / 3;
    const double depth = in.signed_depth(middle);
    low = std::max(low, depth);
    double reach = 0;
    for (const Vec3& corner : c) reach = std::max(reach, (corner - middle).norm());
    if (depth + reach > low) parts.push({c, depth + reach});
  };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const std::array<Vec3, 3> c{surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2)};
    if (in.box.intersects(Eigen::AlignedBox3d(c[0]).extend(c[1]).extend(c[2]))) consider(c);
  }
  while (!parts.empty() && parts.top().bound > low + tolerance_mm) {
    const auto [a, b, c] = parts.top().corners;
    parts.pop();
    const Vec3 ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    for (const std::array<Vec3, 3>& part : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      consider(part);
  }
  return {low, parts.empty() ? low : std::max(low, parts.top().bound)};
}

}  // namespace

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
      for (std::size_t i = 0; i < points.size(); ++i) depths.push_back(distance()(points[i]));
      break;
    case DepthKind::none:
      break;
  }
  return depths;
}

const condyle::mesh::SurfaceDistance& Reference::distance() {
  if (!distance_) distance_ = std::make_unique<condyle::mesh::SurfaceDistance>(*fixed_);
  return *distance_;
}

Reference::DepthBounds Reference::depth(std::size_t pose) {
  constexpr double tolerance_mm = 0.01;
  if (!mobile_winding_) {
    mobile_winding_ = std::make_unique<condyle::mesh::WindingNumber>(*mobile_);
    mobile_distance_ = std::make_unique<condyle::mesh::SurfaceDistance>(*mobile_);
  }
  const condyle::Pose& X_FM = poses_[pose];
  const DepthBounds mobile =
      deepest(condyle::posed(X_FM, *mobile_), {winding_, distance(), box_of(*fixed_)}, tolerance_mm);
  const DepthBounds fixed = deepest(condyle::posed(X_FM.inverse(), *fixed_),
                                    {*mobile_winding_, *mobile_distance_, box_of(*mobile_)}, tolerance_mm);
  return {std::max(mobile.low_mm, fixed.low_mm), std::max(mobile.high_mm, fixed.high_mm)};
}

const std::vector<condyle::contact::TrianglePair>& Reference::pairs(std::size_t pose) {
  const auto [at, is_new] = pairs_.try_emplace(pose);
  if (is_new) at->second = pair_.pairs(poses_[pose]);
  return at->second;
}

}  // namespace bench
