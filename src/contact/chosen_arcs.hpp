#pragma once

#include <vector>

#include "condyle/contact.hpp"

namespace condyle::contact {

/// Some vertices of each body, against the other one.
struct ChosenVertices {
  std::vector<Index> mobile, fixed;
};

/// In their order; nothing of a body none of whose vertices is chosen.
struct ChosenArcs {
  tangential::TangentialResults mobile, fixed;
};

/// The results of JointContact::tangential() for these vertices, bit by bit. A ring table is built for a body only if
/// vertices of the other one are chosen, which is closed then.
ChosenArcs arcs_of(const JointContact& joint, const Pose& X_FM, const Vec3& axis_F,
                   const ChosenVertices& vertices);

}  // namespace condyle::contact
