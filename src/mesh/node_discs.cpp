#include "mesh/node_discs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/float_bounds.hpp"
#include "core/parallel.hpp"
#include "mesh/triangle_intersection.hpp"

namespace condyle::mesh {
namespace {

/// Bounds are wider by this part of the coordinates: more than distances to triangles are rounded by.
constexpr double widening = 0x1p-24;

}  // namespace

NodeDiscs::NodeDiscs(const TriangleTree& tree) : tree_(tree), discs_(tree.nodes().size()) {
  std::vector<Vec3> normals(discs_.size());
  const auto set_normal = [&](Index node, const Vec3& normal) {
    normals[node] = normal;
    const Vec3 direction = direction_of(normal);
    for (std::size_t k = 0; k < 3; ++k)
      discs_[node].normal[k] = static_cast<float>(direction[static_cast<int>(k)]);
  };
  core::parallel_chunks(discs_.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (auto i = static_cast<Index>(first); i < last; ++i) {
      const TriangleTree::Node& node = tree.nodes()[i];
      if (!node.is_leaf()) continue;
      Vec3 normal = Vec3::Zero();
      for (Index t = node.first; t < node.last; ++t) {
        const TriangleCorners c = tree.corners(t);
        normal += (c[1] - c[0]).cross(c[2] - c[0]);
      }
      set_normal(i, normal);
      bound_leaf(i);
    }
  });
  // Children come after their parent.
  for (auto i = static_cast<Index>(discs_.size()); i-- > 0;) {
    const TriangleTree::Node& node = tree.nodes()[i];
    if (node.is_leaf()) continue;
    set_normal(i, normals[node.child] + normals[node.child + 1]);
    bound_children(i);
  }
}

/// 0 for no direction.
Vec3 NodeDiscs::direction_of(const Vec3& normal) {
  const double length = normal.norm();
  return length > 0 && std::isfinite(length) ? Vec3(normal * ((1 - shorter) / length)) : Vec3(Vec3::Zero());
}

void NodeDiscs::bound_leaf(Index i) {
  const TriangleTree::Node& node = tree_.nodes()[i];
  const Vec3 c = centre(i), direction = discs_[i].direction();
  double low = std::numeric_limits<double>::infinity(), high = -low, squared_radius = 0;
  for (Index t = node.first; t < node.last; ++t)
    for (const Vec3& q : tree_.corners(t)) {
      const double along = direction.dot(q - c);
      low = std::min(low, along), high = std::max(high, along);
      squared_radius = std::max(squared_radius, (q - c).squaredNorm());
    }
  set_bounds(i, low, high, std::sqrt(squared_radius));
}

/// A child's points are its centre, a step along its normal, and at most its radius across that.
void NodeDiscs::bound_children(Index i) {
  const TriangleTree::Node& node = tree_.nodes()[i];
  const Vec3 c = centre(i), direction = discs_[i].direction();
  const double length = direction.norm();
  double low = std::numeric_limits<double>::infinity(), high = -low, radius = 0;
  for (const Index child : {node.child, node.child + 1}) {
    const Disc& disc = discs_[child];
    const Vec3 from = centre(child) - c, other = disc.direction();
    const double other_length = other.norm(), child_radius = double{disc.radius};
    const double both = length * other_length, cosine = both > 0 ? direction.dot(other) / both : 0;
    const double across = length * std::sqrt(std::max(0.0, 1 - cosine * cosine)) * child_radius;
    const double per_step = other_length > 0 ? cosine * length / other_length : 0;
    const auto [least, most] = std::minmax({per_step * double{disc.low}, per_step * double{disc.high}});
    low = std::min(low, direction.dot(from) + least - across);
    high = std::max(high, direction.dot(from) + most + across);
    radius = std::max(radius, from.norm() + child_radius);
  }
  const auto& half = node.half;
  set_bounds(i, low, high, std::min(radius, Vec3(half[0], half[1], half[2]).norm()));
}

void NodeDiscs::set_bounds(Index i, double low, double high, double radius) {
  const double wider = widening * (centre(i).norm() + radius);
  discs_[i].low = core::float_below(low - wider);
  discs_[i].high = core::float_above(high + wider);
  discs_[i].radius = core::float_above(radius + wider);
}

}  // namespace condyle::mesh
