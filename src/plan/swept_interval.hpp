#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "plan/sweep.hpp"

/// How far the swept region reaches below a point.

namespace condyle::plan {

/// A motion and how far it shall go.
struct SweepTo {
  const Sweep* sweep;
  Angle reach;
};

/// Which target needs a piece of bone, and from which angle of its motion on.
struct Need {
  std::size_t target = 0;
  double from_rad = std::numeric_limits<double>::infinity();
};

/// From here inwards, as far as there is room, mm: the direction is of about unit length.
struct Probe {
  Vec3 from, inwards;
  double room;
  double overhang = 0;  ///< so deep it is looked for what is swept under bone that is not

  Vec3 at(double depth) const { return from + depth * inwards; }
};

/// The swept interval that begins at a probe; no need if it has none.
struct SweptInterval {
  double length = 0;
  std::optional<Need> need = {};
};

/// For each point the need of the sweep that covers it first.
std::vector<std::optional<Need>> needs_of(const Points& points, const std::vector<SweepTo>& sweeps);

/// Steps along a direction, mm: what is not swept for less than this is not seen.
inline constexpr double step_mm = 0.1;

/// Leaves out those of the probes whose interval does not matter, if it is longer than found so far by this at most.
using LeaveOut = std::function<void(std::vector<std::size_t>& which, const std::vector<SweptInterval>& found,
                                    double longer_by)>;

/// Searched in steps, the last one halved; to within 0.001 mm past its end. Those that are left out, before a step is halved, stay shorter.
std::vector<SweptInterval> swept_intervals(const std::vector<Probe>& probes,
                                           const std::vector<SweepTo>& sweeps,
                                           const LeaveOut& leave_out = {});

/// For each probe the depth to which bone goes: to the end of the swept interval that begins at it, if it has no other one; of one that is not
/// swept itself to the end of the deepest there is under an overhang. By halving, to within depth_error_mm().
std::vector<double> depths(const std::vector<Probe>& probes, const std::vector<SweepTo>& sweeps);
/// By so much a depth may fall short of where the bone goes to, mm: 1/2048 of the room.
double depth_error_mm(const Probe& probe) noexcept;

}  // namespace condyle::plan
