#pragma once

#include <functional>
#include <optional>

#include "condyle/angle.hpp"

/// First contact by asking "do they touch" at one angle after the other: what is done where there is no
/// closed form. Any contact that begins and ends between two angles is missed.

namespace bench {

/// Whether the bodies touch after this turn from the start.
using TouchAt = std::function<bool(condyle::Angle)>;

/// The last angle found free and the first one found touching.
struct Bracket {
  condyle::Angle free, touching;
  int queries = 0;

  bool holds(condyle::Angle angle) const { return free <= angle && angle <= touching; }
};

/// Goes on by `step` until the bodies touch; empty where they do not within the range.
std::optional<Bracket> step_to_contact(const TouchAt& touch, condyle::Angle step, condyle::Angle range);

/// Halves the bracket until it is no wider than `width`.
Bracket bisected(const TouchAt& touch, Bracket bracket, condyle::Angle width);

}  // namespace bench
