#pragma once

#include <vector>

#include "plan/swept_interval.hpp"

namespace condyle::plan {

/// An edge of a surface that is lowered: its ends, as deep as they are, and the inward directions there.
struct LoweredEdge {
  Vec3 from, to, inwards_from, inwards_to;
  double depth_from, depth_to, room;

  double length() const { return (to - from).norm(); }
};

/// Where edges are to be split so that triangles follow the bottom of a cut: 0 where one stays whole, else a share of the way from its first
/// end. A straight line between the ends misses the depth between by more than `missed_mm`; then at the bend of two lines that follow it
/// best, or in the middle if an end is near. No piece is shorter than `shortest_mm`.
///
///      ----.  A            At a wall, where depths jump, `beside_mm` from it: first outside (A), then at its foot (B), so that the wall
///          |               stands between the two. Far enough that chords between places like A do not cut what is swept.
///        B '----
struct BendOptions {
  double missed_mm, shortest_mm, beside_mm;
};
std::vector<double> shares_at_bends(const std::vector<LoweredEdge>& edges, const std::vector<SweepTo>& sweeps,
                                    const BendOptions& options);

}  // namespace condyle::plan
