#pragma once

#include <span>

#include "condyle/contact.hpp"
#include "condyle/first_contact.hpp"
#include "motion/search/path_clearance.hpp"

namespace condyle::motion {

/// How much of a motion on either side of a pose is in contact for certain, and a pair of triangles that shows it.
struct LastingContact {
  double lasts_for;  ///< units of the motion; 0 if nothing crosses by more than rounding
  ContactWitness witness;
};

/// From the pairs of triangles that meet at X_FM, of which there is one at least; the mobile body moves no faster than
/// `speed`.
///
///            p
///       ____ | ____        The edge p q goes through the triangle T. It can cease to only by meeting T's border or by
///      /     o    /        one of its ends meeting T: not while nothing has moved by the distance between p q and the
///     /__T___|___/         border, between p and T, and between q and T. The smallest of the three lasts.
///            q
///
/// Among many pairs some are evaluated; another choice would only change how long contact is known to last.
LastingContact lasting_contact(const Mesh& fixed, const Mesh& mobile, const Pose& X_FM,
                               std::span<const contact::TrianglePair> pairs, const Speed& speed);

}  // namespace condyle::motion
