#include "plan/bends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace condyle::plan {
namespace {

/// The depth along an edge is asked in so many places between its ends, from so much more than at the ends, mm.
constexpr int along_edge = 7;
constexpr double more_than_ends_mm = 1;
/// A bend nearer to an end of its edge than this share of its length is come nearer to by halving first, so that no triangle gets narrow.
constexpr double nearest_to_end = 0.2;
/// A wall is steeper than this, and higher, mm; its place is halved so often.
constexpr double wall_slope = 4, least_wall_mm = 0.1;
constexpr int wall_halvings = 6;

using Profile = std::array<double, along_edge + 2>;

constexpr double share_of(std::size_t place) {
  return static_cast<double>(place) / (along_edge + 1);
}

/// The share of the way along an edge at which two straight lines from its ends meet so that they follow the depths between best.
double bend_of(const Profile& depth) {
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int percent = 1; percent < 100; ++percent) {
    const double at = percent / 100.0;
    // Each depth is what the lines have without a bend, and a share of the unknown height of the bend.
    double squares = 0, product = 0, rest = 0;
    for (std::size_t i = 1; i <= along_edge; ++i) {
      const double s = share_of(i), share = s < at ? s / at : (1 - s) / (1 - at),
                   off = depth[i] - (1 - s) * depth.front() - s * depth.back();
      squares += share * share, product += share * off, rest += off * off;
    }
    const double missed = rest - product * product / squares;
    if (missed < least) least = missed, best = at;
  }
  return best;
}

/// By how much a straight line between the ends misses the depth at the most.
double missed_by_line(const Profile& depth) {
  double missed = 0;
  for (std::size_t i = 1; i <= along_edge; ++i) {
    const double s = share_of(i);
    missed = std::max(missed, std::abs(depth[i] - (1 - s) * depth.front() - s * depth.back()));
  }
  return missed;
}

Probe probe_at(const LoweredEdge& edge, double s) {
  const double deeper = std::max(edge.depth_from, edge.depth_to);
  return {(1 - s) * edge.from + s * edge.to, (1 - s) * edge.inwards_from + s * edge.inwards_to,
          std::min(edge.room, deeper + more_than_ends_mm), deeper > step_mm ? deeper + step_mm : 0};
}

/// A line that misses depths by no more than this does not show a bend: their own error may be as large.
double missed_at_least(const LoweredEdge& edge, double missed_mm) {
  return std::max(missed_mm, depth_error_mm(probe_at(edge, 0)));
}

/// A place along an edge where the depth jumps: shares of the way just before and past it, and the depths there.
struct Wall {
  double before, past, depth_before, depth_past;

  double height() const { return std::abs(depth_past - depth_before); }
};

/// Between two of the places that were asked.
Wall steepest(const Profile& depth) {
  Wall wall{0, 0, 0, 0};
  for (std::size_t i = 0; i <= along_edge; ++i)
    if (const Wall here{share_of(i), share_of(i + 1), depth[i], depth[i + 1]}; here.height() > wall.height())
      wall = here;
  return wall;
}

/// Halves what holds the walls, in the half that rises more.
void narrow(std::vector<Wall>& walls, const std::vector<LoweredEdge>& edges,
            const std::vector<SweepTo>& sweeps) {
  for (int halving = 0; halving < wall_halvings; ++halving) {
    std::vector<Probe> probes;
    for (std::size_t i = 0; i < walls.size(); ++i)
      probes.push_back(probe_at(edges[i], (walls[i].before + walls[i].past) / 2));
    const std::vector<double> middle = depths(probes, sweeps);
    for (std::size_t i = 0; i < walls.size(); ++i) {
      Wall& wall = walls[i];
      const double s = (wall.before + wall.past) / 2;
      if (std::abs(middle[i] - wall.depth_before) > std::abs(wall.depth_past - middle[i]))
        wall.past = s, wall.depth_past = middle[i];
      else
        wall.before = s, wall.depth_before = middle[i];
    }
  }
}

/// Beside a wall, first above it and then at its foot; 0 where an end of the edge is so near already.
double share_beside(const Wall& wall, double beside) {
  const bool rises = wall.depth_past < wall.depth_before;  // towards the end
  const double above = rises ? 1 - wall.past : wall.before, foot = rises ? wall.before : 1 - wall.past;
  if (above > 2 * beside) return rises ? wall.past + beside : wall.before - beside;
  if (foot > 2 * beside) return rises ? wall.before : wall.past;
  return 0;
}

double share_at_bend(const Profile& depth, double length, double shortest) {
  const double bend = bend_of(depth), share = std::min(bend, 1 - bend) < nearest_to_end ? 0.5 : bend;
  return std::min(share, 1 - share) * length > shortest ? share : 0;
}

}  // namespace

std::vector<double> shares_at_bends(const std::vector<LoweredEdge>& edges, const std::vector<SweepTo>& sweeps,
                                    const BendOptions& options) {
  const auto ask = [&](const std::vector<std::size_t>& which, int between) {
    std::vector<Probe> probes;
    for (const std::size_t e : which)
      for (int i = 0; i <= between + 1; ++i)
        probes.push_back(probe_at(edges[e], static_cast<double>(i) / (between + 1)));
    return depths(probes, sweeps);
  };
  // Whether the middle is missed decides most edges; for the others both ends are tested too, with the same error.
  std::vector<std::size_t> all(edges.size()), bent;
  for (std::size_t e = 0; e < all.size(); ++e) all[e] = e;
  const std::vector<double> coarse = ask(all, 1);
  for (const std::size_t e : all)
    if (std::abs(coarse[3 * e + 1] - (coarse[3 * e] + coarse[3 * e + 2]) / 2) >
        missed_at_least(edges[e], options.missed_mm / 4))
      bent.push_back(e);
  const std::vector<double> fine = ask(bent, along_edge);

  std::vector<double> shares(edges.size(), 0);
  std::vector<Wall> walls;
  std::vector<std::size_t> with_wall;
  std::vector<LoweredEdge> of_walls;
  for (std::size_t c = 0; c < bent.size(); ++c) {
    Profile depth{};
    std::copy_n(fine.begin() + static_cast<std::ptrdiff_t>(c * depth.size()), depth.size(), depth.begin());
    if (missed_by_line(depth) <= missed_at_least(edges[bent[c]], options.missed_mm)) continue;
    const double length = edges[bent[c]].length();
    shares[bent[c]] = share_at_bend(depth, length, options.shortest_mm);
    const Wall wall = steepest(depth);
    if (wall.height() < std::max(least_wall_mm, wall_slope * (wall.past - wall.before) * length)) continue;
    walls.push_back(wall), with_wall.push_back(bent[c]), of_walls.push_back(edges[bent[c]]);
  }
  narrow(walls, of_walls, sweeps);
  for (std::size_t i = 0; i < walls.size(); ++i)
    if (walls[i].height() > least_wall_mm)
      shares[with_wall[i]] = share_beside(walls[i], options.beside_mm / of_walls[i].length());
  return shares;
}

}  // namespace condyle::plan
