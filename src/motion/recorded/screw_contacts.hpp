#pragma once

#include "motion/recorded/contact_stretch.hpp"
#include "motion/recorded/screw_motion.hpp"

namespace condyle {
class JointContact;
}

namespace condyle::motion {

/// Two bodies asked at many poses.
struct PosedBodies {
  const JointContact& contact;
  const FeatureTree &fixed, &mobile;  ///< of the same meshes
};

struct ScrewContacts {
  ContactStretches contacts;
  std::size_t poses = 0;  ///< looked at
};

/// Contact on a way that has no closed form, by a bound: at a pose the bodies are in contact or apart, which is decided
/// exactly, and stay so for as much of the way as no point can move far enough to change it (clearance(),
/// lasting_contact()).
///
///     0              s                1     the middle of what is not known yet; then the rest on either side of it,
///     |----( - - - - + - - - - )------|     until what is left is shorter than `resolution`, a fraction of the way:
///                free for c                 that is told by its own middle or stays undecided
///
/// What is not in the answer is free.
ScrewContacts screw_contacts(const PosedBodies& bodies, const ScrewMotion& motion, double resolution);

}  // namespace condyle::motion
