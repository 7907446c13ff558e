#include "plan/cut_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "mesh/vertex_normals.hpp"

namespace condyle::plan {
namespace {

/// Steps along a direction, mm; how often the last one is halved, and how many are asked for at once.
constexpr double step_mm = 0.1;
constexpr int halvings = 7;
constexpr int steps_at_once = 8;
/// Bone is not thicker: whoever has come so far does not come out.
constexpr double farthest_mm = 40;
/// A triangle is looked at in the points of a lattice with so many to a side: 45 points.
constexpr int lattice = 8;
/// What still stands out between vertices is lowered so often; less than this is none, mm.
constexpr int rounds = 20;
constexpr double none_mm = 1e-3;
/// A triangle that faces less than this the way it did is taken for turned over: the cosine. Lowered so often at most.
constexpr double least_facing = 0.02;
constexpr int most_unfoldings = 200;
/// What is kept may stand out by so much before that is said here: the exact search is to find whether it ends a motion.
constexpr double left_mm = 0.02;
/// It is looked for so deep where no corner may go.
constexpr double least_room_mm = 2 * left_mm;

}  // namespace

/// From here inwards: the direction is of about unit length.
struct CutSurface::Probe {
  Vec3 from, inwards;
  double room;
};

/// The swept stretch below a point between the corners of a triangle, whose weights these are.
struct CutSurface::LatticeStretch {
  Index triangle;
  std::array<double, 3> weights;
  double length;
  Need need;
  Vec3 at;
};

/// The swept stretch that begins at a probe.
struct CutSurface::Stretch {
  double length = 0;
  bool ends = true;  ///< false if it goes on past the room there is
  std::optional<Need> need = {};
};

CutSurface::CutSurface(Body body, const std::vector<std::uint8_t>& near,
                       std::vector<std::optional<KeptBy>> kept, std::optional<double> deepest_mm,
                       double edge_mm)
    : body_(std::move(body)), edge_mm_(edge_mm) {
  const Mesh& mesh = body_.mesh;
  vertices_.resize(mesh.vertices().size());
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    Vertex& vertex = vertices_[v];
    vertex.before = mesh.vertices()[v];
    vertex.inwards = Vec3::Zero();
    vertex.kept = kept[v];
    vertex.room_mm = kept[v] ? 0 : deepest_mm.value_or(farthest_mm);
  }
  std::vector<std::uint8_t> used(vertices_.size(), 0);
  for (Index t = 0; t < near.size(); ++t) {
    if (!near[t]) continue;
    near_.push_back(t);
    for (const Index v : mesh.triangles()[t]) used[v] = 1;
  }
  for (Index v = 0; v < used.size(); ++v)
    if (used[v]) near_vertices_.push_back(v);
}

void CutSurface::smooth_directions(double over_mm) {
  const Mesh& mesh = body_.mesh;
  const Points normals = mesh::area_normals(mesh);
  for (const Index v : near_vertices_) vertices_[v].inwards = -normals[v].stableNormalized();
  // Means over neighbours, as far as the near triangles go.
  const double turns = over_mm / edge_mm_;
  std::vector<Vec3> sum(vertices_.size());
  for (int i = 0; i < static_cast<int>(turns * turns); ++i) {
    for (const Index v : near_vertices_) sum[v] = vertices_[v].inwards;
    for (const Index t : near_) {
      const Triangle& corner = mesh.triangles()[t];
      for (int k = 0; k < 3; ++k) sum[corner[k]] += vertices_[corner[(k + 1) % 3]].inwards;
    }
    for (const Index v : near_vertices_) vertices_[v].inwards = sum[v].stableNormalized();
  }
}

void CutSurface::restore() {
  for (Vertex& vertex : vertices_) vertex.depth_mm = 0, vertex.need.reset();
}

void CutSurface::scale_depths(double by) {
  for (Vertex& vertex : vertices_) vertex.depth_mm *= by;
}

Mesh CutSurface::mesh() const {
  Points points = body_.mesh.vertices();
  for (const Index v : near_vertices_)
    if (vertices_[v].depth_mm > 0) points.set(v, at(v));
  return body_.mesh.moved_to(std::move(points));
}

std::vector<CutSurface::Stretch> CutSurface::stretches(const std::vector<Probe>& probes,
                                                       const std::vector<SweepTo>& sweeps) const {
  std::vector<Stretch> found(probes.size());
  // Of each point the need of the first target that sweeps over it.
  const auto needs_of = [&](const Points& points) {
    std::vector<std::optional<Need>> needs(points.size());
    for (std::size_t s = 0; s < sweeps.size(); ++s) {
      const std::vector<double> first = sweeps[s].sweep->first_inside(points, sweeps[s].reach);
      for (std::size_t i = 0; i < first.size(); ++i)
        if (std::isfinite(first[i]) && (!needs[i] || first[i] < needs[i]->from_rad))
          needs[i] = Need{s, first[i]};
    }
    return needs;
  };
  const auto note = [](Stretch& stretch, const Need& need) {
    if (!stretch.need || stretch.need->from_rad > need.from_rad) stretch.need = need;
  };

  Points points;
  for (const Probe& probe : probes) points.push_back(probe.from);
  std::vector<std::size_t> going;
  const auto begins = needs_of(points);
  for (std::size_t i = 0; i < probes.size(); ++i)
    if (begins[i]) note(found[i], *begins[i]), going.push_back(i);

  // Whole steps, some at once.
  std::vector<std::size_t> between;  // whose stretch ends within the next step
  for (int step = 0; !going.empty(); step += steps_at_once) {
    points = {};
    for (const std::size_t i : going)
      for (int k = 1; k <= steps_at_once; ++k)
        points.push_back(probes[i].from + std::min((step + k) * step_mm, probes[i].room) * probes[i].inwards);
    const auto needs = needs_of(points);
    std::vector<std::size_t> go_on;
    for (std::size_t g = 0; g < going.size(); ++g) {
      Stretch& stretch = found[going[g]];
      const double room = probes[going[g]].room;
      int k = 0;
      while (k < steps_at_once && needs[g * steps_at_once + k] && stretch.length < room) {
        note(stretch, *needs[g * steps_at_once + k]);
        stretch.length = std::min((step + ++k) * step_mm, room);
      }
      if (stretch.length >= room)
        stretch.ends = false;
      else if (k < steps_at_once)
        between.push_back(going[g]);
      else
        go_on.push_back(going[g]);
    }
    going = std::move(go_on);
  }
  // The last step, halved.
  double half = step_mm / 2;
  for (int i = 0; i < halvings && !between.empty(); ++i, half /= 2) {
    points = {};
    for (const std::size_t b : between)
      points.push_back(probes[b].from + std::min(found[b].length + half, probes[b].room) * probes[b].inwards);
    const auto needs = needs_of(points);
    for (std::size_t b = 0; b < between.size(); ++b)
      if (needs[b]) {
        Stretch& stretch = found[between[b]];
        stretch.length = std::min(stretch.length + half, probes[between[b]].room);
        note(stretch, *needs[b]);
      }
  }
  // Past the last point that is swept.
  for (const std::size_t b : between) found[b].length = std::min(found[b].length + 2 * half, probes[b].room);
  return found;
}

void CutSurface::take(Index v, double depth, const Need& need) {
  Vertex& vertex = vertices_[v];
  vertex.depth_mm = std::min(depth, vertex.room_mm);
  if (!vertex.need || vertex.need->from_rad > need.from_rad) vertex.need = need;
}

void CutSurface::lower_vertices(const std::vector<SweepTo>& sweeps) {
  std::vector<Probe> probes;
  std::vector<Index> of;
  for (const Index v : near_vertices_) {
    const Vertex& vertex = vertices_[v];
    if (vertex.kept) continue;
    probes.push_back({vertex.before, vertex.inwards, vertex.room_mm});
    of.push_back(v);
  }
  const std::vector<Stretch> found = stretches(probes, sweeps);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i].need) take(of[i], found[i].length, *found[i].need);
}

std::vector<CutSurface::LatticeStretch> CutSurface::stretches_between(
    const std::vector<Index>& triangles, const std::vector<SweepTo>& sweeps) const {
  std::vector<std::array<double, 3>> weights;
  for (int i = 0; i <= lattice; ++i)
    for (int j = 0; i + j <= lattice; ++j)
      weights.push_back({double(i) / lattice, double(j) / lattice, double(lattice - i - j) / lattice});
  std::vector<Probe> probes;
  for (const Index t : triangles) {
    const Triangle& corner = body_.mesh.triangles()[t];
    std::array<Vec3, 3> p{};
    double room = least_room_mm;
    bool any_free = false;
    for (int k = 0; k < 3; ++k) {
      p[k] = at(corner[k]);
      const Vertex& vertex = vertices_[corner[k]];
      if (vertex.kept) continue;
      const double free = vertex.room_mm - vertex.depth_mm;
      room = any_free ? std::min(room, free) : free;
      any_free = true;
    }
    for (const auto& w : weights)
      probes.push_back({w[0] * p[0] + w[1] * p[1] + w[2] * p[2],
                        w[0] * vertices_[corner[0]].inwards + w[1] * vertices_[corner[1]].inwards +
                            w[2] * vertices_[corner[2]].inwards,
                        std::max(room, least_room_mm)});
  }
  const std::vector<Stretch> found = stretches(probes, sweeps);
  std::vector<LatticeStretch> swept;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i].need)
      swept.push_back({triangles[i / weights.size()], weights[i % weights.size()], found[i].length,
                       *found[i].need, probes[i].from});
  return swept;
}

/// A point between corners goes deeper by e where each corner goes by e w / (w . w), w its weights: the least that does.
std::vector<Index> CutSurface::lower_between_vertices(const std::vector<Index>& triangles,
                                                      const std::vector<SweepTo>& sweeps) {
  std::vector<double> more(vertices_.size(), 0);
  std::vector<std::optional<Need>> why(vertices_.size());
  for (const LatticeStretch& point : stretches_between(triangles, sweeps)) {
    const Triangle& corner = body_.mesh.triangles()[point.triangle];
    const auto& w = point.weights;
    const double scale = point.length / (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    for (int k = 0; k < 3; ++k) {
      const Index v = corner[k];
      const double by = scale * w[k];
      if (vertices_[v].depth_mm < vertices_[v].room_mm && by > more[v]) more[v] = by, why[v] = point.need;
    }
  }
  std::vector<std::uint8_t> moved(vertices_.size(), 0);
  for (const Index v : near_vertices_) {
    if (!why[v]) continue;
    // Beside what is kept a triangle cannot be lowered as a whole: its free corners would run away.
    const double before = vertices_[v].depth_mm;
    take(v, before + std::min(more[v], edge_mm_), *why[v]);
    moved[v] = vertices_[v].depth_mm > before + none_mm;
  }
  std::vector<Index> changed;
  for (const Index t : near_)
    if (const auto& [a, b, c] = body_.mesh.triangles()[t]; moved[a] || moved[b] || moved[c])
      changed.push_back(t);
  return changed;
}

std::vector<InTheWay> CutSurface::left_in_the_way(const std::vector<SweepTo>& sweeps) const {
  std::vector<InTheWay> left;
  for (const LatticeStretch& point : stretches_between(near_, sweeps)) {
    if (point.length <= left_mm) continue;
    // All corners are kept, or at the end of their room; where one is free the exact search decides.
    std::optional<KeptBy> by = KeptBy::depth;
    for (const Index v : body_.mesh.triangles()[point.triangle])
      if (vertices_[v].kept) by = vertices_[v].kept;
    for (const Index v : body_.mesh.triangles()[point.triangle])
      if (vertices_[v].depth_mm < vertices_[v].room_mm) by.reset();
    if (by) left.push_back({point.need.target, point.need.from_rad, *by, point.at});
  }
  return left;
}

std::vector<InTheWay> CutSurface::lower(const std::vector<SweepTo>& sweeps) {
  lower_vertices(sweeps);
  std::vector<Index> changed = near_;
  for (int round = 0; round < rounds && !changed.empty(); ++round)
    changed = lower_between_vertices(changed, sweeps);
  return left_in_the_way(sweeps);
}

bool CutSurface::unfold() {
  const std::vector<Triangle>& triangles = body_.mesh.triangles();
  for (int round = 0; round < most_unfoldings; ++round) {
    bool any_turned = false, any_lowered = false;
    for (const Index t : near_) {
      const auto& [a, b, c] = triangles[t];
      const Vec3 before = (vertices_[b].before - vertices_[a].before)
                              .cross(vertices_[c].before - vertices_[a].before),
                 now = (at(b) - at(a)).cross(at(c) - at(a));
      if (before.dot(now) >= least_facing * before.norm() * now.norm()) continue;
      any_turned = true;
      const Index deepest =
          *std::max_element(triangles[t].begin(), triangles[t].end(),
                            [&](Index i, Index j) { return vertices_[i].depth_mm < vertices_[j].depth_mm; });
      for (const Index v : triangles[t]) {
        const double deeper = vertices_[deepest].depth_mm - vertices_[v].depth_mm;
        if (!(deeper > 0 && vertices_[v].depth_mm < vertices_[v].room_mm)) continue;
        take(v, vertices_[v].depth_mm + std::max(deeper / 4, none_mm), *vertices_[deepest].need);
        any_lowered = true;
      }
    }
    if (!any_turned) return true;
    if (!any_lowered) return false;
  }
  return false;
}

CutSurface::Lowered CutSurface::lower_feature(const Feature& feature, const Need& need, double by_mm) {
  std::array<Index, 3> corners{feature.id, no_index, no_index};
  if (feature.kind == FeatureKind::edge) corners[1] = feature.other_end;
  if (feature.kind == FeatureKind::face) corners = body_.mesh.triangles()[feature.id];
  const auto may_go = [&](Index v) { return vertices_[v].depth_mm < vertices_[v].room_mm; };
  std::vector<Index> lowered;
  for (const Index v : corners) {
    if (v == no_index) continue;
    if (!std::binary_search(near_vertices_.begin(), near_vertices_.end(), v)) return Lowered::elsewhere;
    if (may_go(v)) lowered.push_back(v);
  }
  if (lowered.empty() && vertices_[corners[0]].kept == KeptBy::bearing)
    for (const Index t : near_) {
      const Triangle& triangle = body_.mesh.triangles()[t];
      const auto has = [&](Index v) {
        return std::find(triangle.begin(), triangle.end(), v) != triangle.end();
      };
      if (has(corners[0]) && (corners[1] == no_index || has(corners[1])))
        std::copy_if(triangle.begin(), triangle.end(), std::back_inserter(lowered), may_go);
    }
  for (const Index v : lowered) take(v, vertices_[v].depth_mm + by_mm, need);
  return lowered.empty() ? Lowered::kept : Lowered::some;
}

}  // namespace condyle::plan
