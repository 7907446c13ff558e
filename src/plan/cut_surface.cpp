#include "plan/cut_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "mesh/edge_table.hpp"
#include "mesh/winding_number.hpp"
#include "plan/inward_directions.hpp"

namespace condyle::plan {
namespace {

/// Bone is not thicker: whoever has come so far does not come out.
constexpr double farthest_mm = 40;
/// A triangle is sampled at the points of a lattice with this many to a side: 45 points.
constexpr int lattice = 8;
/// So many triangles are sampled at a time: some 100 MB for each motion.
constexpr std::size_t triangles_at_once = 4096;
/// Remaining protrusions between vertices are lowered this often; less than this is none, mm.
constexpr int rounds = 20;
constexpr double none_mm = 1e-3;
/// A triangle that faces less than this the way it did is taken for turned over: the cosine. Lowered so often at most.
constexpr double least_facing = 0.02;
constexpr int most_unfoldings = 200;
/// Nor do straight lines miss a bend by more than this share of the deepest cut: a shallow cut would be too large by as much.
constexpr double missed_of_deepest = 0.005;
/// No piece of a split edge is shorter than this share of the edges that the surface was made with.
constexpr double shortest_piece = 0.04;
/// The upper edge of a wall stands so far beside it, mm at edges of 1 mm, and as the edges' square: what chords of so long edges cut into a
/// wall with a radius of 1 mm. Within these.
constexpr double beside_wall = 0.12, least_beside_wall_mm = 0.005, largest_beside_wall = 0.2;
/// Nearer to a kept corner or edge than this share of a triangle, its free corners would run away: it is kept bone that meets.
constexpr double least_free = 0.1;
/// Kept bone may stand out by this much before it is reported here: the exact search finds whether it ends a motion.
constexpr double left_mm = 0.02;
/// Depth of the search for it if no corner may go.
constexpr double least_room_mm = 2 * left_mm;

}  // namespace

/// The swept interval below a point of a triangle.
struct CutSurface::Swept {
  SurfacePoint point;
  double length;
  Need need;
  Vec3 at, below;  ///< and a little farther inwards
};

/// By how much vertices are to go deeper, so that points between them are clear.
class CutSurface::Deeper {
 public:
  explicit Deeper(const CutSurface& surface)
      : surface_(surface), by_(surface.vertices_.size(), 0), at_least_(by_), why_(surface.vertices_.size()) {}

  void add(const SurfacePoint& point, double e, const Need& need) {
    visit(point, e, [&](Index v, double by) {
      if (by > by_[v]) by_[v] = by, why_[v] = need;
    });
  }
  /// A point that add() will get goes down by e at least.
  void add_later(const SurfacePoint& point, double e) {
    visit(point, e, [&](Index v, double by) { at_least_[v] = std::max(at_least_[v], by); });
  }
  /// Whether a point that goes down by e at most can still be the one that decides for a vertex.
  bool may_decide(const SurfacePoint& point, double e) const {
    bool may = false;
    visit(point, e, [&](Index v, double by) { may = may || by >= at_least_[v]; });
    return may;
  }
  double by(Index v) const { return by_[v]; }
  const std::optional<Need>& why(Index v) const { return why_[v]; }

 private:
  /// A point goes down by e if each of its corners that may go does by e w / (w . w), w the weights of these: the least that does it.
  template <class Visit>
  void visit(const SurfacePoint& point, double e, const Visit& with) const {
    const auto goes = [&](int k) { return point.weights[k] > 0 && surface_.may_go(point.corners[k]); };
    double squares = 0;
    for (int k = 0; k < 3; ++k)
      if (goes(k)) squares += point.weights[k] * point.weights[k];
    for (int k = 0; k < 3; ++k)
      if (goes(k)) with(point.corners[k], e * point.weights[k] / squares);
  }

  const CutSurface& surface_;
  std::vector<double> by_, at_least_;
  std::vector<std::optional<Need>> why_;
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
    if (used[v])
      near_vertices_.push_back(v);
    else
      vertices_[v].room_mm = 0;
  for (Index t = 0; t < near.size(); ++t)
    if (const auto& [a, b, c] = mesh.triangles()[t]; used[a] || used[b] || used[c]) moving_.push_back(t);
}

void CutSurface::smooth_directions(double over_mm) {
  // Means over neighbours, as far as the near triangles go.
  const double turns = over_mm / edge_mm_;
  const std::vector<Vec3> inwards =
      inward_directions(body_.mesh, near_vertices_, near_, static_cast<int>(turns * turns));
  for (const Index v : near_vertices_) vertices_[v].inwards = inwards[v];
}

void CutSurface::go_on_from(const CutSurface& whole, const std::vector<Between>& vertices) {
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const Vertex &from = whole.vertices_[vertices[v].from], &to = whole.vertices_[vertices[v].to];
    const double share = vertices[v].share;
    vertices_[v].inwards = (1 - share) * from.inwards + share * to.inwards;
    if (vertices[v].from != vertices[v].to) continue;
    vertices_[v].depth_mm = from.depth_mm;
    vertices_[v].looked_mm = from.looked_mm;
    vertices_[v].bends_seen = from.bends_seen;
  }
}

void CutSurface::restore() {
  for (Vertex& vertex : vertices_) vertex.depth_mm = vertex.looked_mm = 0, vertex.need.reset();
}

void CutSurface::scale_depths(double by) {
  for (Vertex& vertex : vertices_) vertex.depth_mm *= by, vertex.room_mm *= by;
}

void CutSurface::lower_to(Index vertex, double depth_mm, const Need& need) {
  const Vertex& lowered = vertices_[vertex];
  if (std::min(depth_mm, lowered.room_mm) > lowered.depth_mm) take(vertex, depth_mm, need);
}

Mesh CutSurface::mesh() const {
  Points points = body_.mesh.vertices();
  for (const Index v : near_vertices_)
    if (vertices_[v].depth_mm > 0) points.set(v, at(v));
  return body_.mesh.moved_to(std::move(points));
}

std::vector<double> CutSurface::bends(const std::vector<SweepTo>& sweeps, double missed_mm) {
  std::vector<Index> not_lowered;
  for (const Index v : near_vertices_)
    if (!vertices_[v].bends_seen) not_lowered.push_back(v);
  lower_vertices(not_lowered, sweeps);
  lower_overhangs(sweeps);
  double deepest_mm = 0;
  for (const Index v : near_vertices_) deepest_mm = std::max(deepest_mm, vertices_[v].depth_mm);
  missed_mm = std::min(missed_mm, missed_of_deepest * deepest_mm);
  const double shortest = shortest_piece * edge_mm_;
  const mesh::EdgeTable edges(body_.mesh);
  std::vector<std::uint8_t> asked(edges.size(), 0);
  std::vector<std::size_t> candidates;
  std::vector<LoweredEdge> lowered;
  for (const Index t : near_)
    for (int k = 0; k < 3; ++k)
      if (const Index e = edges.edge_of(3 * t + k); e != no_index && !asked[e]) {
        asked[e] = 1;
        const auto& [a, b] = edges.ends(e);
        const Vertex &from = vertices_[a], &to = vertices_[b];
        if (from.kept || to.kept || (from.bends_seen && to.bends_seen)) continue;
        const LoweredEdge edge{from.before,
                               to.before,
                               from.inwards,
                               to.inwards,
                               from.depth_mm,
                               to.depth_mm,
                               std::min(from.room_mm, to.room_mm)};
        if (edge.length() > 2 * shortest) candidates.push_back(e), lowered.push_back(edge);
      }
  for (const Index v : near_vertices_) vertices_[v].bends_seen = true;
  const double beside = std::clamp(beside_wall * edge_mm_ * edge_mm_, least_beside_wall_mm,
                                   std::max(least_beside_wall_mm, largest_beside_wall * edge_mm_));
  const std::vector<double> found = shares_at_bends(lowered, sweeps, {missed_mm, shortest, beside});
  std::vector<double> shares(edges.size(), 0);
  for (std::size_t c = 0; c < candidates.size(); ++c) shares[candidates[c]] = found[c];
  return shares;
}

void CutSurface::take(Index v, double depth, const Need& need) {
  Vertex& vertex = vertices_[v];
  vertex.depth_mm = std::min(depth, vertex.room_mm);
  if (!vertex.need || vertex.need->from_rad > need.from_rad) vertex.need = need;
}

void CutSurface::lower_vertices(const std::vector<Index>& which, const std::vector<SweepTo>& sweeps) {
  std::vector<Probe> probes;
  std::vector<Index> of;
  for (const Index v : which) {
    const Vertex& vertex = vertices_[v];
    if (vertex.kept) continue;
    probes.push_back({vertex.before, vertex.inwards, vertex.room_mm});
    of.push_back(v);
  }
  const std::vector<SweptInterval> found = swept_intervals(probes, sweeps);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i].need) take(of[i], found[i].length, *found[i].need);
}

/// Swept bone below bone that is not swept: beside a deeper vertex, the last swept point down to its depth, and a little more, decides how deep the
/// vertex goes. Each swept component reaches the surface, so this proceeds from there, vertex by vertex.
void CutSurface::lower_overhangs(const std::vector<SweepTo>& sweeps) {
  const std::vector<Triangle>& triangles = body_.mesh.triangles();
  for (bool any = true; any;) {
    any = false;
    std::vector<double> deepest(vertices_.size(), 0);
    for (const Index t : near_) {
      const auto& [a, b, c] = triangles[t];
      const double deep = std::max({vertices_[a].depth_mm, vertices_[b].depth_mm, vertices_[c].depth_mm});
      if (deep == 0) continue;
      for (const Index v : triangles[t]) deepest[v] = std::max(deepest[v], deep);
    }
    Points points;
    std::vector<std::pair<Index, double>> of;
    for (const Index v : near_vertices_) {
      Vertex& vertex = vertices_[v];
      const double down = std::min(deepest[v] + edge_mm_, vertex.room_mm);
      // Asked once more only if a neighbour has gone deeper since.
      if (vertex.kept || deepest[v] <= std::max(vertex.looked_mm, vertex.depth_mm)) continue;
      for (double depth = vertex.depth_mm + step_mm; depth <= down; depth += step_mm) {
        points.push_back(vertex.before + depth * vertex.inwards);
        of.emplace_back(v, depth);
      }
      vertex.looked_mm = deepest[v];
    }
    for (std::size_t s = 0; s < sweeps.size(); ++s) {
      const std::vector<double> first = sweeps[s].sweep->first_inside(points, sweeps[s].reach);
      for (std::size_t i = 0; i < first.size(); ++i) {
        const auto& [v, depth] = of[i];
        if (!std::isfinite(first[i]) || depth <= vertices_[v].depth_mm) continue;
        take(v, depth, {s, first[i]});
        any = true;
      }
    }
    // To the end of the interval that the last swept point lies in.
    std::vector<Probe> probes;
    std::vector<Index> lowered;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const Vertex& vertex = vertices_[of[i].first];
      if (of[i].second != vertex.depth_mm) continue;
      probes.push_back({at(of[i].first), vertex.inwards, vertex.room_mm - vertex.depth_mm});
      lowered.push_back(of[i].first);
    }
    const std::vector<SweptInterval> rest = swept_intervals(probes, sweeps);
    for (std::size_t i = 0; i < rest.size(); ++i)
      if (rest[i].need) take(lowered[i], vertices_[lowered[i]].depth_mm + rest[i].length, *rest[i].need);
  }
}

/// With `deeper`, intervals are as long as they are only if they decide there.
std::vector<CutSurface::Swept> CutSurface::swept_between(const std::vector<Index>& triangles,
                                                         const std::vector<SweepTo>& sweeps,
                                                         Deeper* deeper) const {
  std::vector<std::array<double, 3>> weights;
  for (int i = 0; i <= lattice; ++i)
    for (int j = 0; i + j <= lattice; ++j)
      weights.push_back({double(i) / lattice, double(j) / lattice, double(lattice - i - j) / lattice});
  std::vector<Swept> swept;
  for (std::size_t first = 0; first < triangles.size(); first += triangles_at_once) {
    std::vector<SurfacePoint> points;
    for (std::size_t i = first; i < std::min(first + triangles_at_once, triangles.size()); ++i)
      for (const auto& w : weights) points.push_back({body_.mesh.triangles()[triangles[i]], w});
    std::vector<Probe> probes;
    for (const SurfacePoint& point : points) probes.push_back(probe_below(point));
    const auto leave_out = [&](std::vector<std::size_t>& which, const std::vector<SweptInterval>& so_far,
                               double longer_by) {
      for (const std::size_t i : which) deeper->add_later(points[i], so_far[i].length);
      std::erase_if(
          which, [&](std::size_t i) { return !deeper->may_decide(points[i], so_far[i].length + longer_by); });
    };
    const std::vector<SweptInterval> found =
        swept_intervals(probes, sweeps, deeper ? LeaveOut(leave_out) : LeaveOut());
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i].need)
        swept.push_back({points[i], found[i].length, *found[i].need, probes[i].from, probes[i].at(left_mm)});
  }
  return swept;
}

bool CutSurface::any_may_go(Index triangle) const {
  const Triangle& corners = body_.mesh.triangles()[triangle];
  return std::any_of(corners.begin(), corners.end(), [&](Index v) { return may_go(v); });
}

/// As far inwards as all its free corners may go.
Probe CutSurface::probe_below(const SurfacePoint& point) const {
  Probe probe{Vec3::Zero(), Vec3::Zero(), std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 3; ++k) {
    if (point.corners[k] == no_index) continue;
    const Vertex& vertex = vertices_[point.corners[k]];
    probe.from += point.weights[k] * at(point.corners[k]);
    probe.inwards += point.weights[k] * vertex.inwards;
    if (!vertex.kept) probe.room = std::min(probe.room, vertex.room_mm - vertex.depth_mm);
  }
  if (!std::isfinite(probe.room)) probe.room = 0;
  probe.room = std::max(probe.room, least_room_mm);
  return probe;
}

std::vector<Index> CutSurface::lower_between_vertices(const std::vector<Index>& triangles,
                                                      const std::vector<SweepTo>& sweeps) {
  std::vector<Index> lowerable;
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(lowerable),
               [&](Index t) { return any_may_go(t); });
  Deeper deeper(*this);
  for (const Swept& below : swept_between(lowerable, sweeps, &deeper))
    deeper.add(below.point, below.length, below.need);
  std::vector<std::uint8_t> moved(vertices_.size(), 0);
  for (const Index v : near_vertices_) {
    if (!deeper.why(v)) continue;
    // Beside what is kept a triangle cannot be lowered as a whole: its free corners would run away.
    const double before = vertices_[v].depth_mm;
    take(v, before + std::min(deeper.by(v), edge_mm_), *deeper.why(v));
    moved[v] = vertices_[v].depth_mm > before + none_mm;
  }
  std::vector<Index> changed;
  for (const Index t : near_)
    if (const auto& [a, b, c] = body_.mesh.triangles()[t]; moved[a] || moved[b] || moved[c])
      changed.push_back(t);
  return changed;
}

std::vector<Obstruction> CutSurface::left_obstructions(const std::vector<Index>& triangles,
                                                       const std::vector<SweepTo>& sweeps) const {
  std::vector<Obstruction> left;
  std::optional<mesh::WindingNumber> before;
  const auto is_bone = [&](const Vec3& p) {
    if (!before) before.emplace(body_.mesh);
    return before->at(p).winding != 0;
  };
  // All corners are kept, or at the end of their room; where one is free the exact search decides.
  std::vector<Index> ended;
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(ended),
               [&](Index t) { return !any_may_go(t); });
  for (const Swept& stands_out : swept_between(ended, sweeps)) {
    if (stands_out.length <= left_mm) continue;
    // A vertex lowered through the whole bone samples the surface behind it, which obstructs nothing.
    if (is_bone(stands_out.below))
      left.push_back(
          {stands_out.need.target, stands_out.need.from_rad, kept_by(stands_out.point), stands_out.at});
  }
  return left;
}

std::vector<Obstruction> CutSurface::lower(const std::vector<SweepTo>& sweeps) {
  lower_vertices(near_vertices_, sweeps);
  lower_overhangs(sweeps);
  std::vector<Index> changed = near_;
  for (int round = 0; round < rounds && !changed.empty(); ++round)
    changed = lower_between_vertices(changed, sweeps);
  return left_obstructions(near_, sweeps);
}

std::vector<Obstruction> CutSurface::left_at_room(const std::vector<SweepTo>& sweeps) const {
  std::vector<Index> ended;
  for (const Index t : near_) {
    const Triangle& corners = body_.mesh.triangles()[t];
    if (std::all_of(corners.begin(), corners.end(),
                    [&](Index v) { return !vertices_[v].kept && vertices_[v].depth_mm > 0 && !may_go(v); }))
      ended.push_back(t);
  }
  return left_obstructions(ended, sweeps);
}

bool CutSurface::unfold() {
  const std::vector<Triangle>& triangles = body_.mesh.triangles();
  for (int round = 0; round < most_unfoldings; ++round) {
    bool any_turned = false, any_lowered = false;
    for (const Index t : moving_) {
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

SurfacePoint CutSurface::on_surface(const motion::Feature& feature, const Vec3& point) const {
  if (feature.kind == motion::FeatureKind::vertex) return {{feature.id, no_index, no_index}, {1, 0, 0}};
  if (feature.kind == motion::FeatureKind::edge) {
    const Vec3 from = at(feature.id), along = at(feature.other_end) - from;
    const double share =
        along == Vec3::Zero() ? 0 : std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return {{feature.id, feature.other_end, no_index}, {1 - share, share, 0}};
  }
  const Triangle& corners = body_.mesh.triangles()[feature.id];
  const Vec3 a = at(corners[0]), b = at(corners[1]), c = at(corners[2]), across = (b - a).cross(c - a);
  const auto share = [&](const Vec3& from, const Vec3& to) {
    return std::max(0.0, (from - point).cross(to - point).dot(across));
  };
  const double wa = share(b, c), wb = share(c, a), wc = share(a, b), sum = wa + wb + wc;
  if (!(sum > 0)) return {corners, {1. / 3, 1. / 3, 1. / 3}};
  return {corners, {wa / sum, wb / sum, wc / sum}};
}

Vec3 CutSurface::before(const SurfacePoint& point) const {
  Vec3 at = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (point.corners[k] != no_index) at += point.weights[k] * vertices_[point.corners[k]].before;
  return at;
}

CutSurface::MayGo CutSurface::may_go(const SurfacePoint& point) const {
  double free = 0;
  for (int k = 0; k < 3; ++k) {
    const Index v = point.corners[k];
    if (v == no_index) continue;
    if (!std::binary_search(near_vertices_.begin(), near_vertices_.end(), v)) return MayGo::elsewhere;
    if (may_go(v)) free += point.weights[k];
  }
  return free > least_free || !beside(point).empty() ? MayGo::some : MayGo::kept;
}

KeptBy CutSurface::kept_by(const SurfacePoint& point) const {
  for (const Index v : point.corners)
    if (v != no_index && vertices_[v].kept) return *vertices_[v].kept;
  return KeptBy::depth;
}

/// The removable vertices of the triangles that contain a point of the bearing surface.
std::vector<Index> CutSurface::beside(const SurfacePoint& point) const {
  std::vector<Index> found;
  if (vertices_[point.corners[0]].kept != KeptBy::bearing) return found;
  for (const Index t : near_) {
    const Triangle& triangle = body_.mesh.triangles()[t];
    const auto has = [&](Index v) {
      return v == no_index || std::find(triangle.begin(), triangle.end(), v) != triangle.end();
    };
    if (has(point.corners[0]) && has(point.corners[1]) && has(point.corners[2]))
      std::copy_if(triangle.begin(), triangle.end(), std::back_inserter(found),
                   [&](Index v) { return may_go(v); });
  }
  return found;
}

void CutSurface::lower_met(const std::vector<Met>& met, const std::vector<SweepTo>& sweeps, double by_mm) {
  std::vector<Probe> probes;
  for (const Met& each : met) probes.push_back(probe_below(each.point));
  const std::vector<SweptInterval> below = swept_intervals(probes, sweeps);
  Deeper deeper(*this);
  for (std::size_t i = 0; i < met.size(); ++i) {
    const SurfacePoint& point = met[i].point;
    const auto may = [&](Index v) { return v != no_index && may_go(v); };
    if (std::any_of(point.corners.begin(), point.corners.end(), may))
      deeper.add(point, below[i].length + by_mm, met[i].need);
    else
      for (const Index v : beside(point))
        deeper.add({{v, no_index, no_index}, {1, 0, 0}}, below[i].length + by_mm, met[i].need);
  }
  for (const Index v : near_vertices_)
    if (deeper.why(v)) take(v, vertices_[v].depth_mm + deeper.by(v), *deeper.why(v));
}

std::vector<Index> CutSurface::beside_changed(const std::vector<Vertex>& before,
                                              const std::vector<Met>& met) const {
  std::vector<std::uint8_t> marks(vertices_.size(), 0);
  for (const Index v : near_vertices_) marks[v] = vertices_[v].depth_mm != before[v].depth_mm;
  for (const Met& each : met)
    for (const Index v : each.point.corners)
      if (v != no_index) marks[v] = 1;
  std::vector<Index> beside;
  for (const Index t : moving_)
    if (const auto& [a, b, c] = body_.mesh.triangles()[t]; marks[a] || marks[b] || marks[c])
      beside.push_back(t);
  return beside;
}

}  // namespace condyle::plan
