#pragma once

#include "condyle/first_contact.hpp"
#include "motion/search/rotation_table.hpp"

namespace condyle::motion {

/// How far the turning body turns about the axis either way from its start, until the surfaces touch or the
/// range ends.
///
/// Guarantee, for the meshes as placed in the frame of the axis (where placing rounds, each coordinate by
/// some 2^-52 of its size): no contact is missed, so the limit is never past one; and it is short of one by
/// at most `shortfall`, itself below 4e-12 rad. Every decision on the way is exact.
///
/// A body inside the other without touching it counts as contact at the start where the outer one is closed;
/// an open mesh has no inside.
///
/// Deterministic: the same input gives the same bits on any thread.
TurnLimits first_contact(const RotationTable& resting, TurningBody& turning, const TurnRange& range = {});

}  // namespace condyle::motion
