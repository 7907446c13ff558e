#include "condyle/brush.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/ordered_sums.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/require_solid.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/vertex_triangles.hpp"
#include "plan/inward_directions.hpp"
#include "plan/moved_triangles.hpp"

namespace condyle::plan {
namespace {

/// Inward directions are mean normals over about this length, so many means at most.
constexpr double brush_smoothing_mm = 3;
constexpr int most_brush_means = 100;
/// Weight of a stroke: whole up to this share of its radius, and where inward directions make an angle of at least this cosine.
constexpr double whole_share_of_radius = 0.5, whole_facing = 0.5;
/// A vertex that would turn a triangle over or run through another goes less deep by this share, repeatedly; not at all below the least.
constexpr double share_held_back = 0.8, least_share = 0.05;

/// s(t) = 3 t^2 - 2 t^3 from 0 to 1.
double smooth_step(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

void check_size_of_brush(double mm, double largest_mm, const char* what) {
  if (!(mm > 0 && mm <= largest_mm))
    throw UsageError(core::formatted("brush: its %s must be above 0 and at most %g mm", what, largest_mm));
}

double mean_edge_mm(const TriMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) sum += core::ordered_norm(mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3));
  return mesh.triangles.empty() ? 0 : sum / static_cast<double>(3 * mesh.triangles.size());
}

std::vector<Index> numbers_to(std::size_t count) {
  std::vector<Index> numbers(count);
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

std::vector<Vec3> inward_directions_of(const Mesh& before, double edge_mm) {
  const double reach = edge_mm > 0 ? brush_smoothing_mm / edge_mm : 1;
  const int means = std::clamp(static_cast<int>(std::min(reach * reach, 1e6)), 1, most_brush_means);
  return plan::inward_directions(before, numbers_to(before.vertices().size()),
                                 numbers_to(before.triangles().size()), means);
}

/// A vertex on its way from one depth to another, of which it goes a share.
struct DepthChange {
  Index vertex;
  double from_mm, to_mm;
  double share = 1;

  double depth_mm() const { return share == 1 ? to_mm : from_mm + share * (to_mm - from_mm); }
};

/// Vertices as they were before a stroke, bit by bit.
struct BrushStep {
  std::vector<Index> vertices;
  std::vector<Vec3> points;
  std::vector<double> along_mm, depth_mm;
};

/// Weights of a stroke by vertex, and the vertices where it is not 0, ascending.
struct BrushWeights {
  std::vector<double> of;
  std::vector<Index> vertices;
};

}  // namespace

struct Brush::Parts {
  std::string name;
  Mesh before;
  Points now;
  std::vector<std::uint8_t> stays;
  double edge_mm;
  mesh::VertexTriangles triangles_of;
  std::shared_ptr<const mesh::TriangleTree> tree;  ///< of the surface before
  MovedTriangles moved_triangles;
  std::vector<Vec3> inwards;
  std::vector<double> along_mm;  ///< of each vertex: how far it lies inwards along its direction
  std::vector<double> depth_mm;  ///< and its distance from the surface before
  std::vector<BrushStep> steps = {};

  Parts(const Body& bone, Mesh surface_before, std::vector<std::uint8_t> marks)
      : name(bone.name),
        before(std::move(surface_before)),
        now(bone.mesh.vertices()),
        stays(std::move(marks)),
        edge_mm(mean_edge_mm(before)),
        triangles_of(before),
        tree(mesh::tree_of(before)),
        moved_triangles(before),
        inwards(inward_directions_of(before, edge_mm)),
        along_mm(now.size(), 0),
        depth_mm(now.size(), 0) {
    if (stays.empty()) stays.resize(now.size(), 0);
    if (stays.size() != now.size())
      throw UsageError("brush: " + std::to_string(stays.size()) + " marks of vertices for the " +
                       std::to_string(now.size()) + " of " + name);
    take_cut();
  }

  /// Vertices that were moved before were cut along directions of their own.
  void take_cut() {
    BrushStep cut;
    for (Index v = 0; v < now.size(); ++v) {
      const Vec3 from = before.vertices()[v], moved = now[v] - from;
      if (moved == Vec3::Zero()) continue;
      note(cut, v, from);
      along_mm[v] = core::ordered_norm(moved);
      inwards[v] = moved / along_mm[v];
      measure(v);
    }
    if (!cut.vertices.empty()) steps.push_back(std::move(cut));
  }

  void note(BrushStep& step, Index v, const Vec3& point) const {
    step.vertices.push_back(v);
    step.points.push_back(point);
    step.along_mm.push_back(along_mm[v]);
    step.depth_mm.push_back(depth_mm[v]);
  }

  void measure(Index v) { depth_mm[v] = along_mm[v] > 0 ? mesh::distance_to_surface(*tree, now[v]) : 0; }

  void check(const BrushStroke& stroke) const {
    if (stroke.along.empty()) throw UsageError("brush: a stroke needs a vertex that it passes over");
    for (const Index v : stroke.along)
      if (v >= now.size())
        throw UsageError("brush: vertex " + std::to_string(v) + " of the " + std::to_string(now.size()) +
                         " of " + name);
    check_size_of_brush(stroke.radius_mm, largest_brush_radius_mm, "radius");
    if (stroke.action == BrushAction::lower)
      check_size_of_brush(stroke.depth_mm, largest_brush_depth_mm, "depth");
  }

  /// Weight of one vertex of the path at another vertex.
  double weight(Index middle, Index v, double radius_mm) const {
    const double d = core::ordered_norm(before.vertices()[v] - before.vertices()[middle]) / radius_mm;
    const double beside = (d - whole_share_of_radius) / (1 - whole_share_of_radius);
    return (1 - smooth_step(beside)) *
           smooth_step(core::ordered_dot(inwards[middle], inwards[v]) / whole_facing);
  }

  /// The larger weights around one vertex of the path, over all that hangs together with it.
  void add_weights(Index middle, double radius_mm, std::vector<Index>& seen_from,
                   BrushWeights& weights) const {
    std::vector<Index> open{middle};
    seen_from[middle] = middle;
    while (!open.empty()) {
      const Index v = open.back();
      open.pop_back();
      const double here = weight(middle, v, radius_mm);
      if (!(here > 0)) continue;
      if (weights.of[v] == 0) weights.vertices.push_back(v);
      weights.of[v] = std::max(weights.of[v], here);
      for (const Index t : triangles_of.of(v))
        for (const Index next : before.triangles()[t])
          if (seen_from[next] != middle) seen_from[next] = middle, open.push_back(next);
    }
  }

  BrushWeights weights_of(const BrushStroke& stroke) const {
    BrushWeights weights{std::vector<double>(now.size(), 0), {}};
    std::vector<Index> seen_from(now.size(), no_index);
    for (const Index middle : stroke.along) {
      if (seen_from[middle] == middle) continue;
      add_weights(middle, stroke.radius_mm, seen_from, weights);
    }
    std::sort(weights.vertices.begin(), weights.vertices.end());
    return weights;
  }

  std::vector<DepthChange> changes_of(const BrushStroke& stroke, const BrushWeights& weights) const {
    std::vector<DepthChange> changes;
    for (const Index v : weights.vertices) {
      const double from = along_mm[v], w = weights.of[v];
      const double to =
          stroke.action == BrushAction::lower ? std::max(from, w * stroke.depth_mm) : from * (1 - w);
      if (!stays[v] && to != from) changes.push_back({v, from, to});
    }
    return changes;
  }

  void place(const DepthChange& change, const Points& was) {
    const Index v = change.vertex;
    const double depth = change.depth_mm();
    const Vec3 from = before.vertices()[v];
    now.set(v, change.share == 0 ? Vec3(was[v]) : depth == 0 ? from : Vec3(from + depth * inwards[v]));
    along_mm[v] = depth;
  }

  /// Goes as deep as keeps the surface sound.
  void move(std::vector<DepthChange>& changes, const Points& was) {
    std::vector<Index> vertices;
    for (const DepthChange& change : changes) vertices.push_back(change.vertex);
    const std::vector<Index> around = triangles_of.of(vertices);
    for (bool sound = false; !sound;) {
      for (const DepthChange& change : changes) place(change, was);
      const Places places{was, now};
      std::vector<Index> wrong = moved_triangles.turned(around, places);
      if (wrong.empty()) wrong = moved_triangles.crossing(around, places);
      sound = wrong.empty();
      hold_back(wrong, changes);
    }
  }

  void hold_back(const std::vector<Index>& triangles, std::vector<DepthChange>& changes) const {
    std::vector<std::uint8_t> wrong(now.size(), 0);
    for (const Index t : triangles)
      for (const Index v : before.triangles()[t]) wrong[v] = 1;
    for (DepthChange& change : changes) {
      if (!wrong[change.vertex]) continue;
      change.share *= share_held_back;
      if (change.share < least_share) change.share = 0;
    }
  }
};

Brush::Brush(const Body& bone, std::vector<std::uint8_t> stays)
    : Brush(bone, bone.mesh.vertices(), std::move(stays)) {}

Brush::Brush(const Body& bone, const Points& before, std::vector<std::uint8_t> stays) {
  if (!bone.mesh.is_closed())
    throw MeshError(bone.name + ": its mesh is open, and no bone can be removed from it");
  mesh::require_oriented(bone.mesh, bone.name);
  parts_ = std::make_unique<Parts>(
      bone, before == bone.mesh.vertices() ? bone.mesh : bone.mesh.moved_to(before), std::move(stays));
}

Brush::~Brush() = default;
Brush::Brush(Brush&&) noexcept = default;
Brush& Brush::operator=(Brush&&) noexcept = default;

StrokeOutcome Brush::stroke(const BrushStroke& stroke) {
  parts_->check(stroke);
  const BrushWeights weights = parts_->weights_of(stroke);
  std::vector<DepthChange> changes = parts_->changes_of(stroke, weights);
  BrushStep step;
  for (const DepthChange& change : changes) parts_->note(step, change.vertex, parts_->now[change.vertex]);
  const Points was = parts_->now;
  if (!changes.empty()) parts_->move(changes, was);
  StrokeOutcome outcome;
  for (const Index v : weights.vertices) outcome.kept += parts_->stays[v];
  for (const DepthChange& change : changes) {
    parts_->measure(change.vertex);
    outcome.moved += change.share > 0;
    outcome.limited += change.share < 1;
  }
  parts_->steps.push_back(std::move(step));
  return outcome;
}

bool Brush::undo() {
  if (parts_->steps.empty()) return false;
  const BrushStep step = std::move(parts_->steps.back());
  parts_->steps.pop_back();
  for (std::size_t i = 0; i < step.vertices.size(); ++i) {
    const Index v = step.vertices[i];
    parts_->now.set(v, step.points[i]);
    parts_->along_mm[v] = step.along_mm[i];
    parts_->depth_mm[v] = step.depth_mm[i];
  }
  return true;
}

std::size_t Brush::steps() const noexcept {
  return parts_->steps.size();
}
const Points& Brush::vertices() const noexcept {
  return parts_->now;
}
const Points& Brush::before() const noexcept {
  return parts_->before.vertices();
}
const std::vector<double>& Brush::depth_mm() const noexcept {
  return parts_->depth_mm;
}
double Brush::edge_mm() const noexcept {
  return parts_->edge_mm;
}

BrushedBone Brush::removed() const {
  const std::vector<double>& depths = parts_->depth_mm;
  BrushedBone removed;
  const auto deepest = std::max_element(depths.begin(), depths.end());
  if (deepest == depths.end() || *deepest == 0) return removed;
  removed.deepest_mm = *deepest;
  removed.deepest_vertex = static_cast<Index>(deepest - depths.begin());
  const Vec3 middle = before()[*removed.deepest_vertex];
  const TriMesh after{vertices(), parts_->before.triangles()};
  mesh::CompensatedSum volume;
  for (std::size_t t = 0; t < after.triangles.size(); ++t) {
    const auto& [a, b, c] = after.triangles[t];
    if (parts_->along_mm[a] > 0 || parts_->along_mm[b] > 0 || parts_->along_mm[c] > 0)
      volume.add(mesh::volume_below(parts_->before, t, middle) - mesh::volume_below(after, t, middle));
  }
  removed.volume_mm3 = volume.value();
  return removed;
}

}  // namespace condyle::plan
