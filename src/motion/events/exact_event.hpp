#pragma once

#include "motion/events/rotation_event.hpp"

/// The exact stage of the rotation events. Slow (some ten microseconds each), used only where doubles
/// with their error bounds cannot decide.

namespace condyle::motion::exact {

/// Which of the two roots  t = atan2(B, A) +- atan2(S, -C).
enum class Branch : int { plus = 1, minus = -1 };

ContactEvents vertex_meets_face(const Triple<double>& p, const Corners& face, Branch branch);

/// `across` is any direction, best one across both edges at the root, in the frame at t = 0 of the stationary
/// edge; `across_rotating` the same for the rotating edge. They steer speed, not the answer.
ContactEvents edges_meet(const std::array<Triple<double>, 4>& ends, const Triple<double>& across,
                         const Triple<double>& across_rotating, Branch branch);

/// Edges a b and c d that lie in one plane across the axis: every end passing the other edge.
ContactEvents edges_meet_in_plane(const std::array<Triple<double>, 4>& ends);

}  // namespace condyle::motion::exact
