#pragma once

#include <string>
#include <vector>

#include "measure/found_parts.hpp"

namespace condyle::measure {

struct ChordFinding {
  std::optional<RimChord> chord;
  std::string why_none;
};

/// Front and back of a rim so high above the head's centre: where the polygon of its hours, followed down from its top on either
/// side, passes that height. Empty if it ends before, or if the two are nearer to each other than the head's radius: near the roof a chord
/// has no direction.
ChordFinding chord_at(const std::vector<RimHour>& rim, const Sphere& head, const BodyAxes& axes,
                      double height_mm);

/// By how much the opening is in front of lateral in the plane of the chord.
double chord_version_deg(const RimChord& chord, const BodyAxes& axes);

}  // namespace condyle::measure
