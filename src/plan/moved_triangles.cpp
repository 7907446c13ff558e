#include "plan/moved_triangles.hpp"

#include <algorithm>
#include <array>

#include "core/ordered_sums.hpp"
#include "mesh/triangle_intersection.hpp"

namespace condyle::plan {
namespace {

/// Cosine of the angle between a triangle and how it lay before, from which on it counts as turned over.
constexpr double least_kept_facing = 0.02;

mesh::TriangleCorners corners_at(const Triangle& triangle, const Points& vertices) {
  return {vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]};
}

Vec3 double_area(const mesh::TriangleCorners& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

/// 1 for a triangle that faced nowhere, 0 for one that does so now.
double cosine_between(const Vec3& before, const Vec3& now) {
  if (before == Vec3::Zero()) return 1;
  return now == Vec3::Zero()
             ? 0
             : core::ordered_dot(before, now) / (core::ordered_norm(before) * core::ordered_norm(now));
}

struct CornerBox {
  Vec3 low, high;

  explicit CornerBox(const mesh::TriangleCorners& t)
      : low(t[0].cwiseMin(t[1]).cwiseMin(t[2])), high(t[0].cwiseMax(t[1]).cwiseMax(t[2])) {}

  bool meets(const CornerBox& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  bool meets(const mesh::TriangleTree::Node& node) const {
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double centre = node.centre[i], half = node.half[i];
      if (centre - half > high[k] || centre + half < low[k]) return false;
    }
    return true;
  }
};

/// By their numbers or their places: vertices at one place are one.
bool share_a_vertex(const Triangle& a, const Triangle& b, const Points& vertices) {
  for (const Index v : a)
    for (const Index w : b)
      if (v == w || vertices[v] == vertices[w]) return true;
  return false;
}

}  // namespace

MovedTriangles::MovedTriangles(const Mesh& before) : before_(before), tree_(mesh::tree_of(before)) {}

std::vector<Index> MovedTriangles::turned(std::span<const Index> moved, const Places& places) const {
  std::vector<Index> found;
  for (const Index t : moved) {
    const Triangle& triangle = before_.triangles()[t];
    const Vec3 before = double_area(corners_at(triangle, before_.vertices()));
    const double now = cosine_between(before, double_area(corners_at(triangle, places.now)));
    if (now < least_kept_facing &&
        now < cosine_between(before, double_area(corners_at(triangle, places.was))))
      found.push_back(t);
  }
  return found;
}

bool MovedTriangles::crosses_anew(Index triangle, Index other, const Places& places) const {
  const Triangle &t = before_.triangles()[triangle], &u = before_.triangles()[other];
  if (share_a_vertex(t, u, places.now)) return false;
  return mesh::triangles_intersect(corners_at(t, places.now), corners_at(u, places.now)) &&
         !mesh::triangles_intersect(corners_at(t, places.was), corners_at(u, places.was));
}

std::vector<Index> MovedTriangles::crossing(std::span<const Index> moved, const Places& places) const {
  std::vector<Index> found;
  if (tree_->empty()) return found;
  const mesh::TriangleTree tree = tree_->moved_to(places.now);
  for (const Index t : moved) {
    const CornerBox box(corners_at(before_.triangles()[t], places.now));
    std::vector<Index> open{0};
    while (!open.empty()) {
      const mesh::TriangleTree::Node& node = tree.nodes()[open.back()];
      open.pop_back();
      if (!box.meets(node)) continue;
      if (!node.is_leaf()) {
        open.insert(open.end(), {node.child, node.child + 1});
        continue;
      }
      for (Index place = node.first; place < node.last; ++place) {
        const Index u = tree.mesh_triangles()[place];
        if (u == t || !box.meets(CornerBox(corners_at(before_.triangles()[u], places.now)))) continue;
        if (crosses_anew(t, u, places)) found.insert(found.end(), {t, u});
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace condyle::plan
