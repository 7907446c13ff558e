#include "answer/surface_notes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "condyle/contact.hpp"
#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/surface_sag.hpp"

namespace condyle::answer {
namespace {

/// Bones that rest on each other somewhere touch over less of the head, and bones with a thin joint less deep.
constexpr double least_touching_share = 0.1, least_depth_mm = 0.25;

/// Motions end within two radii of the head's centre: neck, rim, and what is around them. Fine meshes move limits by a tenth of a degree.
constexpr double reach_in_radii = 2, largest_change_deg = 2;

/// Which vertices of the mobile mesh are of its bearing surface.
std::vector<char> bearing_vertices(const TriMesh& mobile, const motion::BearingSurface& surface) {
  std::vector<char> marks(mobile.vertices.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (surface.triangles[t])
      for (const Index v : mobile.triangles[t]) marks[v] = 1;
  return marks;
}

/// Those of the mobile body; empty if the fixed one has no inside, or the joint centre lies on a surface.
auto penetrations(const contact::JointContact& bodies, const Pose& X_FM)
    -> decltype(contact::Contact::mobile_in_fixed) {
  try {
    return bodies.at(X_FM).mobile_in_fixed;
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

void note_touching(const Joint& joint, const motion::RangeOptions& range,
                   const motion::BearingSurface& surface, std::vector<RangeNote>& notes) {
  const contact::JointContact bodies(joint.fixed.mesh, joint.mobile.mesh);
  const Pose X_FM = pose_at(joint.coordinates(), range.overlap.reference_pose);
  if (!bodies.in_contact(X_FM)) return;
  const auto found = penetrations(bodies, X_FM);
  if (!found) return;
  const std::vector<char> on_head = bearing_vertices(joint.mobile.mesh, surface);
  double inside = 0, deepest = 0;
  for (std::size_t i = 0; i < found->size(); ++i) {
    if (!on_head[found->point[i]]) continue;
    deepest = std::max(deepest, found->depth_mm[i]);
    inside += found->depth_mm[i] > least_depth_mm ? 1 : 0;
  }
  const double share = inside / static_cast<double>(std::count(on_head.begin(), on_head.end(), 1));
  if (!(share >= least_touching_share)) return;
  notes.push_back({RangeNoteCode::bones_touch,
                   core::formatted("in the reference pose %.0f %% of the bearing surface of ", 100 * share) +
                       joint.mobile.name + " lies inside " + joint.fixed.name +
                       core::formatted(", up to %.1f mm deep: bones have a joint space between them, and one "
                                       "that is segmented too thick meets the other too early",
                                       deepest)});
}

void note_coarse(const Joint& joint, const motion::BearingSurface& surface, std::vector<RangeNote>& notes) {
  const double reach = reach_in_radii * surface.head.radius;
  const double fixed = kinematics::surface_sag_mm(joint.fixed.mesh, surface.head.centre, reach),
               mobile = kinematics::surface_sag_mm(joint.mobile.mesh, surface.head.centre, reach);
  const double change_deg =
      core::arctangent((fixed + mobile) / surface.head.radius, 1) * 180 / std::numbers::pi;
  if (!(change_deg > largest_change_deg)) return;
  notes.push_back(
      {RangeNoteCode::coarse_mesh,
       core::formatted(
           "between the triangles around the joint a smooth surface stands out by up to %.1f mm of ",
           mobile) +
           joint.mobile.name + core::formatted(" and %.1f mm of ", fixed) + joint.fixed.name +
           core::formatted(": limits may be off by %.0f degrees, more where surfaces meet at a small angle",
                           change_deg)});
}

}  // namespace

std::vector<RangeNote> surface_notes(const Joint& joint, const motion::RangeOptions& range,
                                     const motion::BearingFinding& bearing) {
  std::vector<RangeNote> notes;
  if (!bearing.surface || !joint.is_hip() || joint.implant) return notes;
  if (bearing.surface->parts.empty()) note_touching(joint, range, *bearing.surface, notes);
  note_coarse(joint, *bearing.surface, notes);
  return notes;
}

}  // namespace condyle::answer
