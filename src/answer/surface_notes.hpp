#pragma once

#include <vector>

#include "condyle/answer.hpp"

namespace condyle::answer {

/// Notes on surfaces that move limits: bones that are in contact all over their bearing surface, and triangles that are too long.
std::vector<RangeNote> surface_notes(const Joint& joint, const motion::RangeOptions& range,
                                     const motion::BearingFinding& bearing);

/// The centres of head and socket with the bodies in their reference pose, mm from the joint centre.
struct CentresApart {
  Vec3 head, socket;
};
/// Empty if no socket is known, and where they are too near each other to move limits: by_head(centres_apart_mm).
std::optional<CentresApart> centres_apart(const Joint& joint, const motion::RangeOptions& range,
                                          const motion::BearingSurface& surface);

}  // namespace condyle::answer
