#pragma once

#include <optional>

#include "condyle/first_contact.hpp"
#include "contact/body_pair.hpp"
#include "motion/search/rotation_table.hpp"

/// Whether two bodies are in contact before any rotation.

namespace condyle::motion {

/// A pair of faces that have a point in common at the start, or nothing. Exact. Stationary is const RotationTable or
/// RotatingBody.
template <class Stationary>
std::optional<ContactWitness> faces_in_contact_at_start(Stationary& stationary, RotatingBody& rotating,
                                                        SearchWork& work);

/// A pair of faces that have a point in common in a pose, or nothing: exact for the vertices as the pose rounds them. The frame of an axis
/// or of a direction rounds them once more, and may part bodies that only touch.
std::optional<ContactWitness> faces_touching(const contact::BodyPair& bodies, const Mesh& fixed,
                                             const Mesh& mobile, const Pose& X_FM);

/// Whether a connected component of one body is inside the other's solid, for surfaces that do not meet: a
/// component is then inside with every vertex or with none.
template <class Stationary>
bool one_inside_other_at_start(Stationary& stationary, RotatingBody& rotating);

}  // namespace condyle::motion
