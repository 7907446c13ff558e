#pragma once

#include "core/arc_set.hpp"
#include "motion/search/rotation_table.hpp"

namespace condyle::motion {

/// All angles of a full turn at which the surfaces of the two bodies meet.
///
///           event         event            event event
///     --------(=============)----------------(=====)-------   one pair of triangles: its state changes
///     --------(=====================)--------(=====)-------   at events only; the union over all pairs
///
/// Both bodies are placed in one frame; the rotating one is at angle 0 there. Ends are events of
/// docs/mathematics/05-contact-under-rotation.md, widened by their error bound (below 1e-12 rad): the set holds every angle
/// of contact. Between two events of a pair one exact test of the turned and rounded triangles decides. Gaps
/// between events of a pair below 1e-9 rad count as contact.
///
/// Only surfaces count: a body that turns inside the other's solid and does not meet its surface is free here.
/// Triangles of zero area meet nothing: their points belong to their neighbours. Edges that slide along each
/// other without going in (mirrored rulings of one hyperboloid) may be reported by the ends of their contact
/// only.
///
/// Angles in `known` are certainly in contact, or irrelevant: they are in the answer and are not evaluated. Bodies
/// that are not ready are prepared only as far as they are evaluated.
core::ArcSet contact_set(const RotationTable& stationary, RotatingBody& rotating,
                         const core::ArcSet& known = {});
core::ArcSet contact_set(RotatingBody& stationary, RotatingBody& rotating, const core::ArcSet& known = {});

}  // namespace condyle::motion
