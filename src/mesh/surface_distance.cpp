#include "mesh/surface_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace condyle::mesh {
namespace {

constexpr Index triangles_per_leaf = 4;

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) noexcept {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (a + t * along - p).norm();
}

double squared_distance_to_box(const Vec3& p, const Vec3& low, const Vec3& high) noexcept {
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

}  // namespace

double distance_to_triangle(const Vec3& p, const TriangleCorners& t) noexcept {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  // Above the face where p lies on the inner side of all three edges, seen along the normal.
  const auto inner = [&](int k) { return (t[(k + 1) % 3] - t[k]).cross(p - t[k]).dot(normal) >= 0; };
  const double length = normal.norm();
  if (length > 0 && inner(0) && inner(1) && inner(2)) return std::abs((p - t[0]).dot(normal)) / length;
  return std::min({distance_to_segment(p, t[0], t[1]), distance_to_segment(p, t[1], t[2]),
                   distance_to_segment(p, t[2], t[0])});
}

SurfaceDistance::SurfaceDistance(const TriMesh& mesh) : mesh_(&mesh), order_(mesh.triangles.size()) {
  assert(!mesh.triangles.empty());
  std::iota(order_.begin(), order_.end(), Index{0});
  std::vector<Vec3> centres(order_.size());
  for (const Index t : order_) centres[t] = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
  nodes_.reserve(order_.size());
  build(0, static_cast<Index>(order_.size()), centres);
}

Index SurfaceDistance::build(Index first, Index last, const std::vector<Vec3>& centres) {
  const auto number = static_cast<Index>(nodes_.size());
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (Index i = first; i < last; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh_->corner(order_[i], k);
      low = low.cwiseMin(p), high = high.cwiseMax(p);
    }
  }
  nodes_.push_back({low, high, first, last, no_index});
  if (last - first <= triangles_per_leaf) return number;
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const Index middle = first + (last - first) / 2;
  std::nth_element(
      order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](Index a, Index b) {
        return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
      });
  build(first, middle, centres);
  const Index right = build(middle, last, centres);
  nodes_[number].right = right;
  return number;
}

double SurfaceDistance::operator()(const Vec3& p) const noexcept {
  double best = std::numeric_limits<double>::infinity();
  const auto worth = [&](Index node) {
    return squared_distance_to_box(p, nodes_[node].low, nodes_[node].high) < best * best;
  };
  // Halving splits keep the tree under 34 levels for 2^32 triangles; one node waits per level.
  std::array<Index, 40> waiting;
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const Index at = waiting[--count];
    if (!worth(at)) continue;
    const Node& node = nodes_[at];
    if (node.right == no_index) {
      for (Index i = node.first; i < node.last; ++i) {
        const Index t = order_[i];
        best = std::min(
            best, distance_to_triangle(p, {mesh_->corner(t, 0), mesh_->corner(t, 1), mesh_->corner(t, 2)}));
      }
      continue;
    }
    Index near = at + 1, far = node.right;
    if (squared_distance_to_box(p, nodes_[far].low, nodes_[far].high) <
        squared_distance_to_box(p, nodes_[near].low, nodes_[near].high)) {
      std::swap(near, far);
    }
    waiting[count++] = far;
    waiting[count++] = near;
  }
  return best;
}

}  // namespace condyle::mesh
