#include "plan/cut_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "mesh/edge_table.hpp"
#include "mesh/vertex_normals.hpp"
#include "mesh/winding_number.hpp"

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
/// The depth along an edge is asked in so many places between its ends; halved so often in each, from so much more than at the ends, mm.
constexpr int along_edge = 7;
constexpr int depth_halvings = 11;
constexpr double more_than_ends_mm = 1;
/// A bend nearer to an end of its edge than this share of its length is come nearer to by halving first, so that no triangle gets narrow; and
/// no piece is shorter than this share of the edges that the surface was made with.
constexpr double nearest_to_end = 0.2;
constexpr double shortest_piece = 0.04;
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
  Vec3 at, below;  ///< and a little farther inwards
};

/// The swept stretch that begins at a probe.
struct CutSurface::Stretch {
  double length = 0;
  bool ends = true;  ///< false if it goes on past the room there is
  std::optional<Need> need = {};
};

namespace {

/// The share of the way along an edge at which two straight lines from its ends meet so that they follow the depths between best.
double bend_of(const std::array<double, along_edge + 2>& depth) {
  const auto along = [](std::size_t i) { return static_cast<double>(i) / (along_edge + 1); };
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int percent = 1; percent < 100; ++percent) {
    const double at = percent / 100.0;
    // Each depth is what the lines have without a bend, and a share of the unknown height of the bend.
    double squares = 0, product = 0, rest = 0;
    for (std::size_t i = 1; i <= along_edge; ++i) {
      const double s = along(i), share = s < at ? s / at : (1 - s) / (1 - at),
                   off = depth[i] - (1 - s) * depth.front() - s * depth.back();
      squares += share * share, product += share * off, rest += off * off;
    }
    const double missed = rest - product * product / squares;
    if (missed < least) least = missed, best = at;
  }
  return best;
}

}  // namespace

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

void CutSurface::go_on_from(const CutSurface& whole, const std::vector<Between>& vertices) {
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const Vertex &from = whole.vertices_[vertices[v].from], &to = whole.vertices_[vertices[v].to];
    const double share = vertices[v].share;
    vertices_[v].inwards = (1 - share) * from.inwards + share * to.inwards;
    if (vertices[v].from != vertices[v].to) continue;
    vertices_[v].depth_mm = from.depth_mm;
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

/// Of each probe the depth at which its swept stretch ends, if it has one only: halved, where stretches() steps.
std::vector<double> CutSurface::depths(const std::vector<Probe>& probes,
                                       const std::vector<SweepTo>& sweeps) const {
  const auto swept = [&](const std::vector<std::size_t>& which, const std::vector<double>& depth) {
    Points points;
    for (const std::size_t i : which) points.push_back(probes[i].from + depth[i] * probes[i].inwards);
    std::vector<std::uint8_t> is(which.size(), 0);
    for (const SweepTo& sweep : sweeps) {
      const std::vector<double> first = sweep.sweep->first_inside(points, sweep.reach);
      for (std::size_t k = 0; k < is.size(); ++k)
        if (std::isfinite(first[k])) is[k] = 1;
    }
    return is;
  };
  std::vector<double> depth(probes.size(), 0);
  std::vector<std::size_t> all(probes.size()), going;
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<std::uint8_t> at_surface = swept(all, depth);
  for (const std::size_t i : all)
    if (at_surface[i]) going.push_back(i);
  std::vector<double> middle = depth, width(probes.size());
  for (const std::size_t i : going) width[i] = probes[i].room;
  for (int halving = 0; halving < depth_halvings && !going.empty(); ++halving) {
    for (const std::size_t i : going) width[i] /= 2, middle[i] = depth[i] + width[i];
    const std::vector<std::uint8_t> is = swept(going, middle);
    for (std::size_t k = 0; k < going.size(); ++k)
      if (is[k]) depth[going[k]] = middle[going[k]];
  }
  return depth;
}

std::vector<double> CutSurface::bends(const std::vector<SweepTo>& sweeps, double missed_mm) {
  std::vector<Index> not_lowered;
  for (const Index v : near_vertices_)
    if (!vertices_[v].bends_seen) not_lowered.push_back(v);
  lower_vertices(not_lowered, sweeps);
  const double shortest = shortest_piece * edge_mm_;
  const mesh::EdgeTable edges(body_.mesh);
  std::vector<double> shares(edges.size(), 0);
  std::vector<std::uint8_t> asked(edges.size(), 0);
  std::vector<std::size_t> candidates;
  for (const Index t : near_)
    for (int k = 0; k < 3; ++k)
      if (const Index e = edges.edge_of(3 * t + k); e != no_index && !asked[e]) {
        asked[e] = 1;
        const auto& [a, b] = edges.ends(e);
        const Vertex &from = vertices_[a], &to = vertices_[b];
        if (!from.kept && !to.kept && !(from.bends_seen && to.bends_seen) &&
            (from.before - to.before).norm() > 2 * shortest)
          candidates.push_back(e);
      }
  for (const Index v : near_vertices_) vertices_[v].bends_seen = true;
  const auto probe = [&](std::size_t e, double s) {
    const auto [a, b] = edges.ends(e);
    const Vertex &from = vertices_[a], &to = vertices_[b];
    return Probe{
        (1 - s) * from.before + s * to.before, (1 - s) * from.inwards + s * to.inwards,
        std::min({from.room_mm, to.room_mm, std::max(from.depth_mm, to.depth_mm) + more_than_ends_mm})};
  };
  // Whether the middle is missed tells most edges apart; both ends of the others are asked too, with the same error.
  const auto ask = [&](const std::vector<std::size_t>& which, int between) {
    std::vector<Probe> probes;
    for (const std::size_t e : which)
      for (int i = 0; i <= between + 1; ++i)
        probes.push_back(probe(e, static_cast<double>(i) / (between + 1)));
    return depths(probes, sweeps);
  };
  const std::vector<double> coarse = ask(candidates, 1);
  std::vector<std::size_t> bent;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    if (std::abs(coarse[3 * c + 1] - (coarse[3 * c] + coarse[3 * c + 2]) / 2) > missed_mm / 4)
      bent.push_back(candidates[c]);
  const std::vector<double> fine = ask(bent, along_edge);
  for (std::size_t c = 0; c < bent.size(); ++c) {
    std::array<double, along_edge + 2> depth{};
    std::copy_n(fine.begin() + static_cast<std::ptrdiff_t>(c * depth.size()), depth.size(), depth.begin());
    double missed = 0;
    for (std::size_t i = 1; i <= along_edge; ++i) {
      const double s = static_cast<double>(i) / (along_edge + 1);
      missed = std::max(missed, std::abs(depth[i] - (1 - s) * depth.front() - s * depth.back()));
    }
    if (missed <= missed_mm) continue;
    const auto [a, b] = edges.ends(bent[c]);
    const double bend = bend_of(depth), share = std::min(bend, 1 - bend) < nearest_to_end ? 0.5 : bend,
                 length = (vertices_[a].before - vertices_[b].before).norm();
    if (std::min(share, 1 - share) * length > shortest) shares[bent[c]] = share;
  }
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
  const std::vector<Stretch> found = stretches(probes, sweeps);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i].need) take(of[i], found[i].length, *found[i].need);
}

/// What is swept below bone that is not: beside a deeper vertex the last swept point down to its depth, and a little more, tells how deep the
/// vertex goes. Each piece of what is swept reaches the surface, so this goes on from there, vertex by vertex.
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
    // To the end of the stretch that the last swept point lies in.
    std::vector<Probe> probes;
    std::vector<Index> lowered;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const Vertex& vertex = vertices_[of[i].first];
      if (of[i].second != vertex.depth_mm) continue;
      probes.push_back({at(of[i].first), vertex.inwards, vertex.room_mm - vertex.depth_mm});
      lowered.push_back(of[i].first);
    }
    const std::vector<Stretch> rest = stretches(probes, sweeps);
    for (std::size_t i = 0; i < rest.size(); ++i)
      if (rest[i].need) take(lowered[i], vertices_[lowered[i]].depth_mm + rest[i].length, *rest[i].need);
  }
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
                       *found[i].need, probes[i].from, probes[i].from + left_mm * probes[i].inwards});
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
  std::optional<mesh::WindingNumber> before;
  const auto is_bone = [&](const Vec3& p) {
    if (!before) before.emplace(body_.mesh);
    return before->at(p).winding != 0;
  };
  for (const LatticeStretch& point : stretches_between(near_, sweeps)) {
    if (point.length <= left_mm) continue;
    // All corners are kept, or at the end of their room; where one is free the exact search decides.
    const Triangle& corners = body_.mesh.triangles()[point.triangle];
    if (std::any_of(corners.begin(), corners.end(),
                    [&](Index v) { return vertices_[v].depth_mm < vertices_[v].room_mm; }))
      continue;
    KeptBy by = KeptBy::depth;
    for (const Index v : corners) by = vertices_[v].kept.value_or(by);
    // Whoever was lowered through the whole bone looks at what lies behind it, which is in nobody's way.
    if (is_bone(point.below)) left.push_back({point.need.target, point.need.from_rad, by, point.at});
  }
  return left;
}

std::vector<InTheWay> CutSurface::lower(const std::vector<SweepTo>& sweeps) {
  lower_vertices(near_vertices_, sweeps);
  lower_overhangs(sweeps);
  std::vector<Index> changed = near_;
  for (int round = 0; round < rounds && !changed.empty(); ++round)
    changed = lower_between_vertices(changed, sweeps);
  return left_in_the_way(sweeps);
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
