#include "plan/swept_interval.hpp"

#include <algorithm>
#include <cmath>

namespace condyle::plan {
namespace {

/// One step is asked for first, as most intervals between vertices end in it, then two, and up to so many at once.
constexpr int most_steps_at_once = 8;
/// How often the last step is halved. An interval that ends before the first of these halvings' last part skips them.
constexpr int halvings = 9, short_halvings = 4;
/// A depth is halved so often; overhangs are looked for in steps of this, mm.
constexpr int depth_halvings = 11;
constexpr double overhang_step_mm = 0.2;

void note(SweptInterval& interval, const Need& need) {
  if (!interval.need || interval.need->from_rad > need.from_rad) interval.need = need;
}

/// Whether bone is swept at these depths of some of the probes.
std::vector<std::uint8_t> swept(const std::vector<Probe>& probes, const std::vector<std::size_t>& which,
                                const std::vector<double>& depth, const std::vector<SweepTo>& sweeps) {
  Points points;
  for (std::size_t k = 0; k < which.size(); ++k) points.push_back(probes[which[k]].at(depth[k]));
  std::vector<std::uint8_t> is(which.size(), 0);
  for (const SweepTo& sweep : sweeps) {
    const std::vector<double> first = sweep.sweep->first_inside(points, sweep.reach);
    for (std::size_t k = 0; k < is.size(); ++k)
      if (std::isfinite(first[k])) is[k] = 1;
  }
  return is;
}

}  // namespace

std::vector<std::optional<Need>> needs_of(const Points& points, const std::vector<SweepTo>& sweeps) {
  std::vector<std::optional<Need>> needs(points.size());
  for (std::size_t s = 0; s < sweeps.size(); ++s) {
    const std::vector<double> first = sweeps[s].sweep->first_inside(points, sweeps[s].reach);
    for (std::size_t i = 0; i < first.size(); ++i)
      if (std::isfinite(first[i]) && (!needs[i] || first[i] < needs[i]->from_rad))
        needs[i] = Need{s, first[i]};
  }
  return needs;
}

std::vector<SweptInterval> swept_intervals(const std::vector<Probe>& probes,
                                           const std::vector<SweepTo>& sweeps, const LeaveOut& leave_out) {
  std::vector<SweptInterval> found(probes.size());
  Points points;
  for (const Probe& probe : probes) points.push_back(probe.from);
  std::vector<std::size_t> going;
  const auto begins = needs_of(points, sweeps);
  for (std::size_t i = 0; i < probes.size(); ++i)
    if (begins[i]) note(found[i], *begins[i]), going.push_back(i);

  // Whole steps, some at once.
  std::vector<std::size_t> between;  // whose interval ends within the next step
  for (int step = 0, steps_at_once = 1; !going.empty();
       step += steps_at_once, steps_at_once = std::min(2 * steps_at_once, most_steps_at_once)) {
    points = {};
    for (const std::size_t i : going)
      for (int k = 1; k <= steps_at_once; ++k)
        points.push_back(probes[i].at(std::min((step + k) * step_mm, probes[i].room)));
    const auto needs = needs_of(points, sweeps);
    std::vector<std::size_t> go_on;
    for (std::size_t g = 0; g < going.size(); ++g) {
      SweptInterval& interval = found[going[g]];
      const double room = probes[going[g]].room;
      int k = 0;
      while (k < steps_at_once && needs[g * steps_at_once + k] && interval.length < room) {
        note(interval, *needs[g * steps_at_once + k]);
        interval.length = std::min((step + ++k) * step_mm, room);
      }
      if (interval.length >= room) continue;
      (k < steps_at_once ? between : go_on).push_back(going[g]);
    }
    going = std::move(go_on);
  }
  // The last step, halved.
  const auto needs_after = [&](const std::vector<std::size_t>& which, double further) {
    points = {};
    for (const std::size_t b : which)
      points.push_back(probes[b].at(std::min(found[b].length + further, probes[b].room)));
    return needs_of(points, sweeps);
  };
  std::vector<std::size_t> open, brief;
  const auto goes_on = needs_after(between, std::ldexp(step_mm, -short_halvings));
  for (std::size_t b = 0; b < between.size(); ++b) (goes_on[b] ? open : brief).push_back(between[b]);
  double half = step_mm / 2;
  for (int i = 0; i < halvings; ++i, half /= 2) {
    if (i == short_halvings) open.insert(open.end(), brief.begin(), brief.end());
    // All that is left to be added, and what that is rounded by.
    if (leave_out) leave_out(open, found, 2.001 * half);
    const auto needs = needs_after(open, half);
    for (std::size_t b = 0; b < open.size(); ++b)
      if (needs[b]) {
        SweptInterval& interval = found[open[b]];
        interval.length = std::min(interval.length + half, probes[open[b]].room);
        note(interval, *needs[b]);
      }
  }
  // Past the last point that is swept.
  for (const std::size_t b : open) found[b].length = std::min(found[b].length + 2 * half, probes[b].room);
  return found;
}

double depth_error_mm(const Probe& probe) noexcept {
  return std::ldexp(probe.room, -depth_halvings);
}

std::vector<double> depths(const std::vector<Probe>& probes, const std::vector<SweepTo>& sweeps) {
  std::vector<double> depth(probes.size(), 0), width(probes.size(), 0);
  std::vector<std::size_t> all(probes.size()), going, scanned;
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  const std::vector<std::uint8_t> at_surface = swept(probes, all, depth, sweeps);
  for (const std::size_t i : all)
    if (at_surface[i]) going.push_back(i), width[i] = probes[i].room;
  // Under an overhang the last step that is swept.
  std::vector<double> scan;
  for (const std::size_t i : all)
    for (double down = overhang_step_mm; !at_surface[i] && down < probes[i].overhang;
         down += overhang_step_mm)
      scanned.push_back(i), scan.push_back(down);
  const std::vector<std::uint8_t> below = swept(probes, scanned, scan, sweeps);
  for (std::size_t k = 0; k < scan.size(); ++k)
    if (below[k]) {
      const std::size_t i = scanned[k];
      if (width[i] == 0) going.push_back(i);
      depth[i] = scan[k], width[i] = overhang_step_mm;
    }
  for (int halving = 0; halving < depth_halvings && !going.empty(); ++halving) {
    std::vector<double> middle;
    for (const std::size_t i : going) width[i] /= 2, middle.push_back(depth[i] + width[i]);
    const std::vector<std::uint8_t> is = swept(probes, going, middle, sweeps);
    for (std::size_t k = 0; k < going.size(); ++k)
      if (is[k]) depth[going[k]] = middle[k];
  }
  return depth;
}

}  // namespace condyle::plan
