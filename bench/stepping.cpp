#include "stepping.hpp"

namespace bench {

using condyle::Angle;

std::optional<Bracket> step_to_contact(const TouchAt& touch, Angle step, Angle range) {
  Bracket bracket;
  for (int i = 0; step * i <= range; ++i) {
    bracket.free = bracket.touching;
    bracket.touching = step * i;
    ++bracket.queries;
    if (touch(bracket.touching)) return bracket;
  }
  return std::nullopt;
}

Bracket bisected(const TouchAt& touch, Bracket bracket, Angle width) {
  while (bracket.touching - bracket.free > width) {
    const Angle middle = (bracket.free + bracket.touching) * 0.5;
    ++bracket.queries;
    (touch(middle) ? bracket.touching : bracket.free) = middle;
  }
  return bracket;
}

}  // namespace bench
