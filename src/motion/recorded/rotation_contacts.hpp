#pragma once

#include "motion/recorded/contact_part.hpp"
#include "motion/recorded/screw_motion.hpp"
#include "motion/search/rotation_table.hpp"

namespace condyle::motion {

/// Contact along the motion of a body whose origin is held: in closed form, none missed, however short
/// (docs/mathematics/05-contact-under-rotation.md). The axis goes through M's origin, so the fixed body is placed as seen
/// from there, shifted by -t.
///
/// An end errs by at most the difference to the nearest proven contact, below 4e-12 rad of rotation. Free parts
/// below 1e-9 rad between contacts count as contact. The motion must hold its origin and turn by less than half a turn.
ContactParts rotation_contacts(RotatingBody& fixed, RotatingBody& mobile, const ScrewMotion& motion);

}  // namespace condyle::motion
