#include "sample/remesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "condyle/error.hpp"
#include "mesh/editable_mesh.hpp"
#include "sample/edge_queue.hpp"
#include "sample/projection.hpp"

namespace condyle::sample {
namespace {

using mesh::EdgeStar;
using mesh::EditableMesh;

/// Twice the area, along the normal.
Vec3 area_normal(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  return (b - a).cross(c - a);
}

/// Cosine of the largest turn of a triangle's normal that one edit may cause.
constexpr double least_turn_cosine = 0.5;
/// Cosine of the largest angle between a triangle's normal and the surface's normal at a vertex it moved to.
constexpr double least_lay_cosine = 0.2;

bool turned_too_far(const Vec3& before, const Vec3& after) noexcept {
  return before.dot(after) <= least_turn_cosine * before.norm() * after.norm();
}

/// Smallest angle of a triangle, as the cosine of that angle: smaller is better.
double sharpest_cosine(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 ab = (b - a).normalized(), bc = (c - b).normalized(), ca = (a - c).normalized();
  return std::max({-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)});
}

class Remesher {
 public:
  Remesher(const TriMesh& start, const Field& solid, const Sizing& sizing)
      : mesh_(start), solid_(solid), sizing_(sizing), outward_(start.vertices.size()) {}

  void lay_all() {
    for (Index v = 0; v < mesh_.vertex_end(); ++v) {
      if (mesh_.has_vertex(v)) place(v, laid_on(solid_, mesh_.position(v)));
    }
  }

  /// Instead of laying them, for vertices on the surface.
  void orient_faces() {
    for (Index v = 0; v < mesh_.vertex_end(); ++v)
      outward_[v] = solid_(mesh_.position(v)).gradient.normalized();
  }

  /// Edge length, in units of the sizing, at which equilateral triangles make the wanted count.
  double common_length(std::size_t vertex_count) const {
    const double per_triangle = sized_area(mesh_.packed(), sizing_) / (2 * static_cast<double>(vertex_count));
    return std::sqrt(per_triangle * 4 / std::numbers::sqrt3);
  }

  void split_longer_than(double length) {
    for (const auto& [a, b] : mesh_.edges()) {
      if (relative_length(a, b) > length) split(a, b);
    }
  }

  /// Collapses edges shorter than `length`, shortest first, until `least_count` vertices are left.
  void collapse_shorter_than(double length, std::size_t least_count) {
    double longest = std::numeric_limits<double>::min();
    std::vector<EdgeQueue::Edge> at_first;
    for (const auto& [a, b] : mesh_.edges()) {
      const double relative = relative_length(a, b);
      if (!(relative < length)) continue;
      at_first.emplace_back(relative, a, b);
      longest = std::max(longest, relative);
    }
    EdgeQueue shortest(longest);
    for (const auto& edge : at_first) shortest.push(edge);
    while (!shortest.empty() && mesh_.vertex_count() > least_count) {
      const auto [relative, a, b] = shortest.pop();
      // An entry whose ends moved since is stale: its edge was offered again with its new length.
      if (!mesh_.has_vertex(a) || !mesh_.has_vertex(b) || relative != relative_length(a, b)) continue;
      const auto edge = mesh_.star(a, b);
      if (!edge || !collapse(*edge)) continue;
      for (const Index n : mesh_.neighbours(a)) {
        const double now = relative_length(a, n);
        if (now < length) shortest.push({now, std::min(a, n), std::max(a, n)});
      }
    }
  }

  void reach(std::size_t vertex_count) {
    collapse_shorter_than(std::numeric_limits<double>::infinity(), vertex_count);
    while (mesh_.vertex_count() < vertex_count) {
      std::vector<std::tuple<double, Index, Index>> longest;
      for (const auto& [a, b] : mesh_.edges()) longest.emplace_back(-relative_length(a, b), a, b);
      std::sort(longest.begin(), longest.end());
      // Splitting an edge leaves all others: several can be split before measuring again. Not too many, as
      // their triangles shrink with them.
      const std::size_t missing = vertex_count - mesh_.vertex_count(), at_once = 1 + longest.size() / 100;
      longest.resize(std::min({missing, at_once, longest.size()}));
      for (const auto& [negative_length, a, b] : longest) split(a, b);
    }
    if (mesh_.vertex_count() != vertex_count) {
      throw MeshError(fmt::format("sample: the surface cannot be meshed with {} vertices", vertex_count));
    }
  }

  /// Flips every edge whose flip enlarges the smallest angle of its two triangles. Returns how many.
  int flip_once() {
    int flips = 0;
    for (const auto& [a, b] : mesh_.edges()) {
      const auto edge = mesh_.star(a, b);
      if (edge && mesh_.can_flip(*edge) && flip_improves(*edge)) mesh_.flip(*edge), ++flips;
    }
    return flips;
  }

  void flip_all() {
    constexpr int most_sweeps = 10;
    for (int sweep = 0; sweep < most_sweeps && flip_once() > 0; ++sweep) {
    }
  }

  /// Moves every vertex towards the centroid of its triangles, weighted so that triangles too large for their
  /// place pull it, then back onto the surface.
  void relax_once() {
    for (Index v = 0; v < mesh_.vertex_end(); ++v) {
      if (mesh_.has_vertex(v)) relax(v);
    }
  }

  std::size_t vertex_count() const noexcept { return mesh_.vertex_count(); }
  TriMesh packed() const { return mesh_.packed(); }

 private:
  void place(Index v, const Laid& laid) {
    mesh_.move(v, laid.point);
    outward_[v] = laid.gradient.normalized();
  }

  double relative_length(Index a, Index b) const {
    const Vec3& p = mesh_.position(a);
    const Vec3& q = mesh_.position(b);
    return (p - q).norm() / sizing_((p + q) / 2);
  }

  void split(Index a, Index b) {
    const Laid middle = laid_on(solid_, (mesh_.position(a) + mesh_.position(b)) / 2);
    mesh_.split(*mesh_.star(a, b), middle.point);
    outward_.push_back(middle.gradient.normalized());
  }

  bool collapse(const EdgeStar& edge) {
    if (!mesh_.can_collapse(edge)) return false;
    const auto [p, gradient] = laid_on(solid_, (mesh_.position(edge.a) + mesh_.position(edge.b)) / 2);
    const Vec3 outward = gradient.normalized();
    if (!stays_unfolded(edge.a, edge.b, p, outward) || !stays_unfolded(edge.b, edge.a, p, outward))
      return false;
    mesh_.collapse(edge, p);
    outward_[edge.a] = outward;
    return true;
  }

  /// Whether the triangles at v, but for those at `other`, keep facing outwards when v moves to p, where the
  /// surface's normal is `outward`.
  bool stays_unfolded(Index v, Index other, const Vec3& p, const Vec3& outward) const {
    for (const Index t : mesh_.around(v)) {
      auto corners = mesh_.triangle(t);
      if (std::find(corners.begin(), corners.end(), other) != corners.end()) continue;
      std::array<Vec3, 3> now, then;
      for (int k = 0; k < 3; ++k) {
        now[k] = mesh_.position(corners[k]);
        then[k] = corners[k] == v ? p : now[k];
      }
      const Vec3 before = area_normal(now[0], now[1], now[2]), after = area_normal(then[0], then[1], then[2]);
      if (after.dot(outward) <= least_lay_cosine * after.norm()) return false;
      // A sliver has no normal to speak of: it may turn.
      if (turned_too_far(before, after) && !(sharpest_cosine(now[0], now[1], now[2]) > sliver_cosine))
        return false;
    }
    return true;
  }

  bool flip_improves(const EdgeStar& edge) const {
    const Vec3 &a = mesh_.position(edge.a), &b = mesh_.position(edge.b);
    const Vec3 &left = mesh_.position(edge.left), &right = mesh_.position(edge.right);
    const double before = std::max(sharpest_cosine(a, b, left), sharpest_cosine(b, a, right));
    const double after = std::max(sharpest_cosine(a, right, left), sharpest_cosine(b, left, right));
    constexpr double noticeable = 1e-6;
    if (!(after < before - noticeable)) return false;
    // The flipped pair must still follow the surface: it may not turn away, nor span a ridge.
    const Vec3 old_normal = area_normal(a, b, left).normalized() + area_normal(b, a, right).normalized();
    if (turned_too_far(old_normal, area_normal(a, right, left))) return false;
    if (turned_too_far(old_normal, area_normal(b, left, right))) return false;
    const auto off_surface = [&](const Vec3& p, const Vec3& q) {
      return std::abs(solid_((p + q) / 2).value);
    };
    constexpr double allowed_sag = 0.05;  // of the new edge's length: a circle of 2.5 edge lengths radius
    return off_surface(left, right) <= std::max(off_surface(a, b), allowed_sag * (left - right).norm());
  }

  void relax(Index v) {
    Vec3 sum = Vec3::Zero();
    double total = 0;
    for (const Index t : mesh_.around(v)) {
      const auto& [i, j, k] = mesh_.triangle(t);
      const Vec3 &a = mesh_.position(i), &b = mesh_.position(j), &c = mesh_.position(k);
      const Vec3 centroid = (a + b + c) / 3;
      const double size = sizing_(centroid);
      const double weight = area_normal(a, b, c).norm() / (size * size);
      sum += weight * centroid;
      total += weight;
    }
    if (!(total > 0)) return;
    const Vec3& now = mesh_.position(v);
    const Vec3& outward = outward_[v];
    const Vec3 pull = sum / total - now;
    const Laid laid = laid_on(solid_, now + (pull - pull.dot(outward) * outward));
    if (stays_unfolded(v, no_index, laid.point, laid.gradient.normalized())) place(v, laid);
  }

  /// Cosine of 10 degrees: a triangle with a smaller angle than that is a sliver.
  static constexpr double sliver_cosine = 0.984807753012208;

  EditableMesh mesh_;
  const Field& solid_;
  const Sizing& sizing_;
  std::vector<Vec3> outward_;  ///< the surface's normal at each vertex
};

}  // namespace

TriMesh remeshed(const TriMesh& start, const Field& solid, const Sizing& sizing, std::size_t vertex_count) {
  Remesher remesher(start, solid, sizing);
  remesher.lay_all();
  double length = remesher.common_length(vertex_count);
  constexpr int rounds = 8;
  for (int round = 0; round < rounds; ++round) {
    remesher.split_longer_than(length * 4 / 3);
    remesher.collapse_shorter_than(length * 4 / 5, 0);
    remesher.flip_all();
    remesher.relax_once();
    // Lengths settle around, not at, the wanted one: correct it by the count that came out.
    length *= std::sqrt(static_cast<double>(remesher.vertex_count()) / static_cast<double>(vertex_count));
  }
  remesher.reach(vertex_count);
  constexpr int final_sweeps = 20;
  for (int sweep = 0; sweep < final_sweeps; ++sweep) {
    remesher.flip_all();
    remesher.relax_once();
  }
  remesher.flip_all();
  return remesher.packed();
}

TriMesh refined(const TriMesh& mesh, const Field& solid, const Sizing& sizing, std::size_t vertex_count) {
  Remesher remesher(mesh, solid, sizing);
  remesher.orient_faces();
  remesher.reach(vertex_count);
  remesher.flip_all();
  remesher.relax_once();
  return remesher.packed();
}

double sized_area(const TriMesh& mesh, const Sizing& sizing) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    const double size = sizing((a + b + c) / 3);
    area += area_normal(a, b, c).norm() / 2 / (size * size);
  }
  return area;
}

}  // namespace condyle::sample
