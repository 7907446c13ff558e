#include "kinematics/knee_checks.hpp"

#include <cmath>
#include <numbers>

#include "core/formatted.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/knee_anatomy.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle::kinematics {
namespace {

using core::formatted;

/// Cosine, as for shafts of other bones.
constexpr double least_upright = 0.3;

/// The condyles' axis is within 10 degrees of any axis that knees are turned about, and supine legs lie turned outwards by 20.
constexpr double most_turned_deg = 30;

double degrees_between_lines(const Vec3& a, const Vec3& b) {
  return core::arctangent(a.cross(b).norm(), std::abs(a.dot(b))) * 180 / std::numbers::pi;
}

std::string_view word_of(Side side) {
  return side == Side::right ? "right" : "left";
}

/// For condyles whose axis lies along Z, in either sense, below a shaft.
std::optional<JointNote> note_on_front_and_side(const Joint& joint, const KneeAnatomy& knee) {
  const std::string& femur = joint.fixed.name;
  const bool is_backwards = knee.axes->right().z() < 0;
  const bool is_other_side = knee.side && *knee.side != joint.side;
  if (is_backwards && is_other_side)
    return JointNote{
        JointNoteCode::mirrored,
        "the condyles of " + femur + " stand in front of its shaft: front and back are mirrored"};
  if (is_backwards)
    return JointNote{JointNoteCode::axes_turned,
                     "the condyles of " + femur +
                         " stand in front of its shaft: the axes are turned by 180 degrees about superior, "
                         "as where LPS coordinates are read as RAS" +
                         (knee.side ? "" : ", or front and back are mirrored")};
  if (is_other_side)
    return JointNote{JointNoteCode::wrong_side,
                     formatted("the side is %s, but ", word_of(joint.side).data()) + femur +
                         formatted(" is shaped as that of a %s knee: it is the other side's or mirrored",
                                   word_of(*knee.side).data())};
  return std::nullopt;
}

}  // namespace

std::optional<JointNote> condyle_note(const Joint& joint, const Pose& X_FM) {
  const KneeAnatomy knee = knee_anatomy_roughly(mesh::outer_surface(joint.fixed.mesh),
                                                mesh::outer_surface(joint.mobile.mesh), X_FM);
  if (!knee.condyles) return std::nullopt;
  const std::string& femur = joint.fixed.name;
  if (knee.shaft && knee.shaft->direction.y() < least_upright)
    return JointNote{
        JointNoteCode::axes_not_upright,
        "the shaft of " + femur + " does not go up from its condyles: superior does not point up"};
  const double off = degrees_between_lines(knee.condyles->fit.cylinder.direction, Vec3::UnitZ());
  if (off > most_turned_deg)
    return JointNote{JointNoteCode::axes_turned,
                     "the axis that both condyles of " + femur +
                         formatted(" share is %.0f degrees from the joint's direction to the right: the axes "
                                   "are turned, or their names are exchanged",
                                   off)};
  return knee.axes ? note_on_front_and_side(joint, knee) : std::nullopt;
}

}  // namespace condyle::kinematics
