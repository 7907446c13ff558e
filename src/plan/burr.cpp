#include "plan/burr.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/triangle_distance.hpp"
#include "mesh/vertex_normals.hpp"

namespace condyle::plan {
namespace {

/// Balls are placed for what was lowered since, so often at most.
constexpr int most_rounds = 60;
/// A ball that enters bone leans away from it so often.
constexpr int most_leanings = 40;

}  // namespace

struct Burr::Ball {
  Vec3 centre;
  double enters_mm;  ///< bone that may go or not, at the most
};

/// Candidates inside a ball: vertices of near triangles, and other triangles. Decided by their places in the tree, which are no deeper
/// than their own.
struct Burr::Around {
  std::vector<Index> vertices, triangles;
};

Burr::Burr(CutSurface& surface, double radius_mm)
    : surface_(surface),
      radius_(radius_mm),
      before_(surface.body().mesh),
      tree_(before_),
      triangles_of_(surface.body().mesh),
      near_(surface.body().mesh.triangles().size(), 0),
      made_(surface.vertices().size(), 0) {
  for (const Index t : surface.near()) near_[t] = 1;
}

Burr::Around Burr::in_ball(const Vec3& centre) const {
  const double within = radius_ - tolerance_mm;
  Around found;
  std::vector<Index> waiting{0};
  while (!waiting.empty()) {
    const mesh::TriangleTree::Node& node = tree_.nodes()[waiting.back()];
    waiting.pop_back();
    double squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const double beyond =
          std::max(0.0, std::abs(centre[axis] - double(node.centre[k])) - double(node.half[k]));
      squared += beyond * beyond;
    }
    if (squared > within * within) continue;
    if (!node.is_leaf()) {
      waiting.push_back(node.child);
      waiting.push_back(node.child + 1);
      continue;
    }
    for (Index i = node.first; i < node.last; ++i) {
      const Index t = tree_.mesh_triangles()[i];
      if (near_[t])
        for (const Index v : surface_.body().mesh.triangles()[t]) found.vertices.push_back(v);
      else if ((mesh::nearest_on_triangle(centre, tree_.corners(i)) - centre).norm() < within)
        found.triangles.push_back(t);
    }
  }
  std::sort(found.vertices.begin(), found.vertices.end());
  found.vertices.erase(std::unique(found.vertices.begin(), found.vertices.end()), found.vertices.end());
  return found;
}

/// A ball that touches p and enters bone as little as can be: moves away from where it enters most, again and again.
Burr::Ball Burr::freest(const Vec3& p, const Vec3& outwards) const {
  const TriMesh& mesh = surface_.body().mesh;
  Ball ball{p + radius_ * outwards, 0}, best{ball.centre, 2 * radius_};
  for (int i = 0; i < most_leanings; ++i) {
    Vec3 nearest = p;
    double least = radius_;
    const auto consider = [&](const Vec3& q) {
      if (const double distance = (q - ball.centre).norm(); distance < least) least = distance, nearest = q;
    };
    const Around around = in_ball(ball.centre);
    for (const Index v : around.vertices) consider(surface_.at(v));
    for (const Index t : around.triangles)
      consider(
          mesh::nearest_on_triangle(ball.centre, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}));
    ball.enters_mm = radius_ - least;
    if (ball.enters_mm < best.enters_mm) best = ball;
    if (best.enters_mm <= tolerance_mm) break;
    const Vec3 away = (ball.centre - nearest).stableNormalized();
    ball.centre = p + radius_ * (ball.centre + ball.enters_mm * away - p).stableNormalized();
  }
  return best;
}

void Burr::lower_into(const Ball& ball, const Need& need) {
  const TriMesh& mesh = surface_.body().mesh;
  const Around around = in_ball(ball.centre);
  for (const Index v : around.vertices) {
    const Vec3 from_centre = surface_.at(v) - ball.centre;
    if (from_centre.norm() >= radius_ - tolerance_mm) continue;
    const CutSurface::Vertex& vertex = surface_.vertices()[v];
    // To the far side along its inward direction, or as far as it may.
    const double along = from_centre.dot(vertex.inwards), length2 = vertex.inwards.squaredNorm();
    const double further =
        (std::sqrt(along * along + length2 * (radius_ * radius_ - from_centre.squaredNorm())) - along) /
        length2;
    surface_.lower_to(v, vertex.depth_mm + further, need);
    if (const double inside = radius_ - (surface_.at(v) - ball.centre).norm(); inside > tolerance_mm)
      in_kept_mm_ = std::max(in_kept_mm_, inside);
    made_[v] = 1;
    for (const Index t : triangles_of_.of(v))
      for (const Index beside : mesh.triangles[t]) moved_[beside] = 1;
  }
  for (const Index t : around.triangles) {
    const double inside =
        radius_ -
        (mesh::nearest_on_triangle(ball.centre, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}) -
         ball.centre)
            .norm();
    if (inside <= tolerance_mm) continue;
    const auto& corners = mesh.triangles[t];
    if (std::all_of(corners.begin(), corners.end(),
                    [&](Index v) { return surface_.vertices()[v].kept.has_value(); }))
      in_kept_mm_ = std::max(in_kept_mm_, inside);
    else
      elsewhere_.push_back({ball.centre, radius_});
  }
}

/// Whether everything that is lowered is made.
bool Burr::make_once() {
  const Mesh now = surface_.mesh();
  tree_ = before_.moved_to(now.vertices());
  const Points normals = mesh::area_normals(now);
  moved_.assign(made_.size(), 0);
  std::vector<Index> deepest_first;
  for (Index v = 0; v < made_.size(); ++v)
    if (surface_.vertices()[v].depth_mm > 0 && !made_[v]) deepest_first.push_back(v);
  std::stable_sort(deepest_first.begin(), deepest_first.end(), [&](Index a, Index b) {
    return surface_.vertices()[a].depth_mm > surface_.vertices()[b].depth_mm;
  });
  bool all = true;
  for (const Index v : deepest_first) {
    if (made_[v]) continue;
    // The normals of what was lowered since are of the next round.
    if (moved_[v]) {
      all = false;
      continue;
    }
    made_[v] = 1;
    const Vec3 p = surface_.at(v), outwards = normals[v].stableNormalized();
    const Ball ball = freest(p, outwards);
    if (ball.enters_mm > tolerance_mm) lower_into(ball, *surface_.vertices()[v].need);
  }
  return all;
}

bool Burr::make() {
  in_kept_mm_ = 0;
  for (int round = 0; round < most_rounds && elsewhere_.empty(); ++round)
    if (make_once()) break;
  return elsewhere_.empty();
}

}  // namespace condyle::plan
