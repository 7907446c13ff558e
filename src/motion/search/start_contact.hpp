#pragma once

#include <optional>

#include "condyle/first_contact.hpp"
#include "motion/search/rotation_table.hpp"

/// Whether two bodies are in contact before any turn.

namespace condyle::motion {

/// A pair of faces that share a point at the start, or nothing. Exact: touching counts.
std::optional<TouchingFeatures> faces_touching_at_start(const RotationTable& resting, TurningBody& turning,
                                                        TurnWork& work);

/// Whether a connected piece of one closed body is inside the other's solid. Asked where the surfaces do not
/// touch: a piece is then inside with every vertex or with none.
bool one_inside_other_at_start(const RotationTable& resting, TurningBody& turning);

}  // namespace condyle::motion
