#include "mesh/label_surface/simplify.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "mesh/editable_mesh.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/label_surface/roundness.hpp"
#include "mesh/self_crossings.hpp"
#include "mesh/surface_distance.hpp"

namespace condyle::mesh {
namespace {

/// Sum of squared distances from planes and points, weighted: p.A p + 2 b.p + c.
struct Quadric {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Vec3 b = Vec3::Zero();
  double c = 0;

  /// From the plane with unit normal n through p.
  void add_plane(const Vec3& n, const Vec3& p, double weight) {
    const double d = -n.dot(p);
    A += weight * n * n.transpose();
    b += weight * d * n;
    c += weight * d * d;
  }
  void add_point(const Vec3& p, double weight) {
    A.diagonal().array() += weight;
    b -= weight * p;
    c += weight * p.squaredNorm();
  }
  Quadric& operator+=(const Quadric& other) {
    A += other.A, b += other.b, c += other.c;
    return *this;
  }
  double operator()(const Vec3& p) const { return p.dot(A * p) + 2 * b.dot(p) + c; }

  /// Where it is least, as near to `start` as the planes leave open.
  Vec3 least(const Vec3& start) const {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(A);
    const Vec3 slope = A * start + b;
    const double smallest = 1e-3 * solver.eigenvalues()[2];
    Vec3 p = start;
    for (int i = 0; i < 3; ++i) {
      if (solver.eigenvalues()[i] <= smallest) continue;
      const Vec3 direction = solver.eigenvectors().col(i);
      p -= slope.dot(direction) / solver.eigenvalues()[i] * direction;
    }
    return p;
  }
};

/// Share of a vertex's planes that the vertex itself has as a point: keeps vertices of flat parts where they are, about.
constexpr double point_share = 1e-3;
/// Cosine of the largest turn of a triangle's normal in one step.
constexpr double least_turn_cosine = 0.35;
/// Triangles less round than this are not made of rounder ones; 0.29 is the roundest.
constexpr double least_roundness = 0.03;

/// Sheets of the surface that a vertex is in: bit 0 for the bone, bit s for cap s.
using Sheets = std::uint8_t;

class Simplifier {
 public:
  Simplifier(const Contour& contour, const std::vector<bool>& frozen)
      : contour_(contour),
        frozen_(frozen),
        mesh_(contour.mesh),
        quadric_(contour.mesh.vertices.size()),
        sheets_(contour.mesh.vertices.size()),
        version_(contour.mesh.vertices.size()) {
    const TriMesh& m = contour.mesh;
    const BoundingBox bounds = bounds_of_surface(m);
    centre_ = (bounds.low + bounds.high) / 2;
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      const Vec3 a = m.corner(t, 0) - centre_, b = m.corner(t, 1) - centre_, c = m.corner(t, 2) - centre_;
      const Vec3 normal = (b - a).cross(c - a);
      const double area = normal.norm() / 2;
      if (!(area > 0)) continue;
      for (const Index v : m.triangles[t]) {
        quadric_[v].add_plane(normal.normalized(), a, area / 3);
        quadric_[v].add_point(m.vertices[v] - centre_, point_share * area / 3);
        sheets_[v] = static_cast<Sheets>(sheets_[v] | 1u << contour.cap[t]);
      }
    }
  }

  /// False if it was stopped.
  bool run(std::size_t triangles, const std::stop_token& stop) {
    for (const auto& [a, b] : mesh_.edges()) offer(a, b);
    // A closed surface of genus g has 2 (vertices - 2 + 2 g) triangles: two less with each vertex.
    std::size_t left = contour_.mesh.triangles.size();
    for (std::size_t step = 0; left > triangles && !queue_.empty(); ++step) {
      if (step % 4096 == 0 && stop.stop_requested()) return false;
      const Offer offered = queue_.top();
      queue_.pop();
      const auto [cost, a, b, version_a, version_b] = offered;
      if (!mesh_.has_vertex(a) || !mesh_.has_vertex(b) || version_[a] != version_a ||
          version_[b] != version_b)
        continue;
      const auto edge = mesh_.star(a, b);
      if (!edge) continue;
      const auto target = target_of(a, b);
      if (!target || !mesh_.can_collapse(*edge) || !is_along_its_sheets(*edge)) continue;
      if (!stays_unfolded(a, b, target->second) || !stays_unfolded(b, a, target->second)) continue;
      quadric_[a] += quadric_[b];
      sheets_[a] = static_cast<Sheets>(sheets_[a] | sheets_[b]);
      mesh_.collapse(*edge, target->second + centre_);
      left -= 2;
      ++version_[a];
      for (const Index n : mesh_.neighbours(a)) offer(std::min(a, n), std::max(a, n));
    }
    return true;
  }

  Contour result() const {
    Contour made;
    made.mesh = mesh_.packed();
    for (Index t = 0; t < contour_.mesh.triangles.size(); ++t)
      if (mesh_.has_triangle(t)) made.cap.push_back(contour_.cap[t]);
    return made;
  }

 private:
  using Offer = std::tuple<double, Index, Index, std::uint32_t, std::uint32_t>;

  Vec3 at(Index v) const { return mesh_.position(v) - centre_; }

  void offer(Index a, Index b) {
    if (const auto target = target_of(a, b)) queue_.emplace(target->first, a, b, version_[a], version_[b]);
  }

  /// Error and place if the edge is collapsed; none if it must not be.
  std::optional<std::pair<double, Vec3>> target_of(Index a, Index b) const {
    const bool a_stays = frozen_[a], b_stays = frozen_[b];
    if (a_stays && b_stays) return std::nullopt;
    const auto both = static_cast<Sheets>(sheets_[a] | sheets_[b]);
    const bool a_has_all = both == sheets_[a], b_has_all = both == sheets_[b];
    if (!a_has_all && !b_has_all) return std::nullopt;
    const bool may_be_at_a = a_has_all && !b_stays, may_be_at_b = b_has_all && !a_stays;
    if (!may_be_at_a && !may_be_at_b) return std::nullopt;
    Quadric sum = quadric_[a];
    sum += quadric_[b];
    const Vec3 p = at(a), q = at(b), middle = (p + q) / 2;
    if (may_be_at_a && may_be_at_b && both == 1) {
      const Vec3 best = sum.least(middle);
      // Beyond the ends' surroundings the planes are nearly parallel.
      if ((best - middle).norm() <= 2 * (p - q).norm()) return std::pair{std::max(0.0, sum(best)), best};
    }
    std::pair<double, Vec3> best{INFINITY, middle};
    const auto consider = [&](const Vec3& place) {
      const double cost = std::max(0.0, sum(place));
      if (cost < best.first) best = {cost, place};
    };
    if (may_be_at_a) consider(p);
    if (may_be_at_b) consider(q);
    // Two ends of all the same sheets: their middle is in the same planes.
    if (may_be_at_a && may_be_at_b) consider(middle);
    return best;
  }

  /// Whether an edge between two vertices of several sheets is where these meet, not a chord over one of them.
  bool is_along_its_sheets(const EdgeStar& edge) const {
    const auto common = static_cast<Sheets>(sheets_[edge.a] & sheets_[edge.b]);
    if ((common & (common - 1)) == 0) return true;
    unsigned beside = 0;
    for (const Index t : mesh_.around(edge.a)) {
      const Triangle& corners = mesh_.triangle(t);
      if (std::find(corners.begin(), corners.end(), edge.b) != corners.end()) beside |= 1u << contour_.cap[t];
    }
    return beside == common;
  }

  /// Whether the triangles at v but for those at `other` neither turn nor lose their shape if v moves to p.
  bool stays_unfolded(Index v, Index other, const Vec3& p) const {
    for (const Index t : mesh_.around(v)) {
      const Triangle& corners = mesh_.triangle(t);
      if (std::find(corners.begin(), corners.end(), other) != corners.end()) continue;
      std::array<Vec3, 3> now, then;
      for (std::size_t k = 0; k < 3; ++k) {
        now[k] = at(corners[k]);
        then[k] = corners[k] == v ? p : now[k];
      }
      const Vec3 before = (now[1] - now[0]).cross(now[2] - now[0]),
                 after = (then[1] - then[0]).cross(then[2] - then[0]);
      if (!(before.dot(after) > least_turn_cosine * before.norm() * after.norm())) return false;
      const double shape = roundness(then[0], then[1], then[2]);
      if (shape < least_roundness && shape < roundness(now[0], now[1], now[2])) return false;
    }
    return true;
  }

  const Contour& contour_;
  const std::vector<bool>& frozen_;
  EditableMesh mesh_;
  std::vector<Quadric> quadric_;
  std::vector<Sheets> sheets_;
  std::vector<std::uint32_t> version_;
  Vec3 centre_;
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> queue_;
};

/// Freezes the vertices of `before` that are as near to a crossing triangle of `after` as its size.
void freeze_about_crossings(const TriMesh& before, const TriMesh& after, const SelfCrossings& crossings,
                            std::vector<bool>& frozen) {
  for (std::size_t t = 0; t < after.triangles.size(); ++t) {
    if (!crossings.crosses[t]) continue;
    Vec3 low = after.corner(t, 0), high = low;
    for (int k = 1; k < 3; ++k) {
      low = low.cwiseMin(after.corner(t, k));
      high = high.cwiseMax(after.corner(t, k));
    }
    const Vec3 margin = Vec3::Constant((high - low).norm() / 2);
    low -= margin, high += margin;
    for (std::size_t v = 0; v < before.vertices.size(); ++v) {
      const Vec3 p = before.vertices[v];
      if ((p.array() >= low.array()).all() && (p.array() <= high.array()).all()) frozen[v] = true;
    }
  }
}

double largest_distance(const TriMesh& from, const TriMesh& to) {
  const SurfaceDistance distance(to);
  std::vector<double> found(from.vertices.size());
  core::parallel_chunks(found.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) found[v] = distance(from.vertices[v]);
  });
  return found.empty() ? 0 : *std::max_element(found.begin(), found.end());
}

}  // namespace

std::optional<Simplified> simplified(const Contour& contour, std::size_t triangles,
                                     const std::stop_token& stop) {
  if (contour.mesh.triangles.size() <= triangles) return Simplified{contour, 0};
  std::vector<bool> frozen(contour.mesh.vertices.size(), false);
  constexpr int most_tries = 6;
  for (int attempt = 0; attempt < most_tries; ++attempt) {
    Simplifier simplifier(contour, frozen);
    if (!simplifier.run(triangles, stop)) return std::nullopt;
    Simplified made{simplifier.result(), 0};
    const Mesh mesh(made.surface.mesh);
    const SelfCrossings& crossings = self_crossings_of(mesh);
    if (crossings.pairs == 0) {
      made.largest_error = largest_distance(contour.mesh, made.surface.mesh);
      return made;
    }
    if (stop.stop_requested()) return std::nullopt;
    freeze_about_crossings(contour.mesh, made.surface.mesh, crossings, frozen);
  }
  return Simplified{contour, 0};
}

}  // namespace condyle::mesh
