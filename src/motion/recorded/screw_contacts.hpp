#pragma once

#include "motion/recorded/contact_part.hpp"
#include "motion/recorded/screw_motion.hpp"

namespace condyle::contact {
class JointContact;
}  // namespace condyle::contact

namespace condyle::motion {

/// Two bodies asked at many poses.
struct PosedBodies {
  const contact::JointContact& contact;
  const FeatureTree &fixed, &mobile;  ///< of the same meshes
};

struct ScrewContacts {
  ContactParts contacts;
  std::size_t poses = 0;  ///< looked at
};

/// Contact on a segment that has no closed form, by a bound: at a pose the bodies are in contact or apart, which is decided
/// exactly, and stay so for as much of the segment as no point can move far enough to change it (clearance(),
/// lasting_contact()).
///
///     0              s                1     the middle of the unknown part; then the rest on either side of it,
///     |----( - - - - + - - - - )------|     until the rest is shorter than `resolution`, a fraction of the segment:
///                free for c                 its own middle then decides it, or it stays undecided
///
/// Everything that is not in the answer is free.
ScrewContacts screw_contacts(const PosedBodies& bodies, const ScrewMotion& motion, double resolution);

}  // namespace condyle::motion
