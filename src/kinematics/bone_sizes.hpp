#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/fit.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_checks.hpp"

/// Sizes of human bones, and the units in which meshes that contradict them are likely given.

namespace condyle::kinematics {

/// Diagonals of human bones and their cartilages, mm: from a wedge of meniscus to twice a tall man's femur.
inline constexpr double shortest_bone = 20, longest_bone = 1000;

/// The unit in which the radius of a femoral or humeral head would be an adult's; empty if none is.
std::optional<LengthUnit> unit_of_head(double radius) noexcept;

/// ": is it in centimetres?" of a bone of this diagonal, mm, or with a head of this radius; empty if no other unit is likelier.
std::string likely_unit_text(double size, std::optional<double> head_radius);

/// Whether the note was made.
struct SizeNotes {
  std::vector<JointNote> notes;
  bool are_bones =
      true;  ///< false if a body has the size of none: what is searched for in mm is then not found
};

/// Holds the sizes of both bodies, of the head and of the socket against each other and against bones. `head` is the mobile body's, if it
/// has one. Searches the fixed body of a hip for a socket if none is about the head.
SizeNotes size_notes(const Joint& joint, const std::optional<SphericalPatch>& head);

}  // namespace condyle::kinematics
