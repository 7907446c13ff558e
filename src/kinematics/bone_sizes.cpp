#include "kinematics/bone_sizes.hpp"

#include <algorithm>
#include <string>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "kinematics/cut_parts.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_parts.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle::kinematics {
namespace {

using core::formatted;

/// Shortest diagonals of what is wide at a knee, an ankle or an elbow: condyles of adults are 70 mm across, and a whole femur in centimetres is 45.
constexpr double shortest_at_knee = 55, shortest_at_elbow = 35;

/// Radii of adult femoral and humeral heads, mm. Those of children and small animals lie between these ranges in millimetres, centimetres
/// and inches, and say nothing against the unit.
constexpr double smallest_adult_head = 15, largest_adult_head = 32;

/// The unit of a body whose lengths, meant in mm, must be multiplied by this; empty if no unit's is near enough. Between 10 and 25.4 lies
/// a factor of 2.5.
std::optional<LengthUnit> unit_by_factor(double factor) noexcept {
  constexpr double least = 0.65, most = 1.5;
  for (const LengthUnit unit : {LengthUnit::centimetres, LengthUnit::inches, LengthUnit::metres})
    if (factor > least * mm_per(unit) && factor < most * mm_per(unit)) return unit;
  return std::nullopt;
}

constexpr const char* of_an_animal = " (an animal's? species of [person] says so)";

double shortest_of(const Joint& joint) noexcept {
  if (joint.has_head() || !joint.names_its_joint()) return shortest_bone;
  return joint.anatomy == Anatomy::knee ? shortest_at_knee : shortest_at_elbow;
}

/// A sphere that may be a socket, wherever it is.
std::optional<SphericalPatch> any_socket(const Mesh& fixed) {
  try {
    return find_sphere(fixed, {.part = SphericalPart::socket});
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

/// A head and a socket whose radii differ by the factor between two units.
std::optional<JointNote> disagreement(const Joint& joint, const SphericalPatch& head) {
  const double radius = head.fit.sphere.radius;
  const Mesh& fixed = uncut_surface(joint.fixed);
  const auto about = socket_around(fixed, head.fit.sphere);
  if (*about && fits_into(head.fit.sphere, **about)) return std::nullopt;
  const auto socket = any_socket(fixed);
  if (!socket) return std::nullopt;
  const double ratio = socket->fit.sphere.radius / radius;
  const auto of_mobile = unit_by_factor(ratio), of_fixed = unit_by_factor(1 / ratio);
  if (!of_mobile && !of_fixed) return std::nullopt;
  return JointNote{JointNoteCode::units_disagree,
                   "the head of " + joint.mobile.name +
                       formatted(" has a radius of %.3g mm and the socket of ", radius) + joint.fixed.name +
                       formatted(" one of %.3g mm: is ", socket->fit.sphere.radius) +
                       (of_mobile ? joint.mobile.name + " in " + std::string(plural_of(*of_mobile))
                                  : joint.fixed.name + " in " + std::string(plural_of(*of_fixed))) +
                       "?"};
}

}  // namespace

std::optional<LengthUnit> unit_of_head(double radius) noexcept {
  for (const LengthUnit unit : all_length_units)
    if (const double mm = radius * mm_per(unit); mm >= smallest_adult_head && mm <= largest_adult_head)
      return unit;
  return std::nullopt;
}

std::string likely_unit_text(double size, std::optional<double> head_radius) {
  if (head_radius)
    if (const auto unit = unit_of_head(*head_radius); unit && *unit != LengthUnit::millimetres)
      return ": is it in " + std::string(plural_of(*unit)) + "?";
  if (size > longest_bone) return size / 1000 >= shortest_bone ? ": is it in millimetres?" : "";
  // A whole femur is 400 to 520 mm, half a pelvis 200 to 260.
  std::string units;
  for (const LengthUnit unit : {LengthUnit::centimetres, LengthUnit::inches, LengthUnit::metres})
    if (const double mm = size * mm_per(unit); mm >= 60 && mm <= 600)
      units += (units.empty() ? "" : " or ") + std::string(plural_of(unit));
  return units.empty() ? "" : ": is it in " + units + "?";
}

SizeNotes size_notes(const Joint& joint, const std::optional<SphericalPatch>& head) {
  SizeNotes found;
  const std::optional<double> radius = head ? std::optional(head->fit.sphere.radius) : std::nullopt;
  const bool is_human = joint.person.is_human();
  for (const Body* body : {&joint.fixed, &joint.mobile}) {
    if (!is_human) break;
    const double size = mesh::bounds_of_surface(body->mesh).diagonal();
    if (size >= shortest_of(joint) && size <= longest_bone) continue;
    found.are_bones &= size >= shortest_bone && size <= longest_bone;
    found.notes.push_back(
        {JointNoteCode::unlikely_size,
         body->name +
             formatted(" is %.4g mm across in the units stated, and no human bone %sis", size,
                       size < shortest_bone || size > longest_bone ? "" : "of such a joint ") +
             likely_unit_text(size, body == &joint.mobile ? radius : std::nullopt) + of_an_animal});
  }
  if (!head) return found;
  if (auto note = joint.is_hip() ? disagreement(joint, *head) : std::nullopt) {
    found.notes.push_back(std::move(*note));
  } else if (const auto unit = unit_of_head(*radius);
             is_human && found.notes.empty() && unit && *unit != LengthUnit::millimetres) {
    found.notes.push_back(
        {JointNoteCode::unlikely_size,
         "the head of " + joint.mobile.name +
             formatted(" has a radius of %.3g mm in the units stated, and no adult's has: is it in ",
                       *radius) +
             std::string(plural_of(*unit)) + "?" + of_an_animal});
  }
  return found;
}

}  // namespace condyle::kinematics
