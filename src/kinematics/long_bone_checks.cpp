#include "kinematics/long_bone_checks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/symmetric.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/knee_checks.hpp"
#include "kinematics/surface_points.hpp"
#include "mesh/surface_pieces.hpp"
#include "mesh/surface_to_surface.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::kinematics {
namespace {

using core::formatted;

/// Ratio of the standard deviations along a shaft and across it: a whole femur has 6.9, the upper 15 cm of one 1.8, femur and tibia
/// cut 9 cm from the knee 1.5 and 1.4.
constexpr double least_slenderness = 2;

/// How far beyond the joint a shaft may reach, and how far from the joint it may begin, in parts of its length.
constexpr double farthest_from_end = 0.25;

/// Two bones end to end overlap by no more than this along the line between their middles, in parts of the shorter one: an
/// olecranon reaches some 25 mm past the end of its humerus.
constexpr double most_overlap = 0.4;

/// Volume of a box round a bone that stands on another, in cubes of that one's breadth: condyles of a femur that is cut 35 mm
/// above the joint have 0.4, a patella on a tibia 0.1, both menisci less.
constexpr double smallest_upper_bone = 0.2;

/// How far the line of a shaft may pass beside the joint centre, in parts of the distance of its middle.
constexpr double farthest_beside = 0.5;

/// Cosines: as for hips; and of two bones of which one is above the other.
constexpr double upright = 0.3, straight = 0.7;

/// A knee's bones are nearest 20 to 40 mm from its axis, an ankle's 20, an elbow's 10.
constexpr double farthest_from_axis_mm = 60;

/// The head of a femur: its radius, how far from the end of the shaft's line it may be, in parts of the bone's length, 400 mm and
/// more; its share of a sphere; and how far beside that line it must be, mm: a femur's is 25 and more.
constexpr double smallest_head = 0.03, largest_head = 0.08, head_reach = 0.2, least_head_coverage = 0.4,
                 least_offset_mm = 10;

/// Where the area of a bone is, and the line along which it is spread most.
struct Bone {
  Vec3 middle;
  bool is_shaft;
  Vec3 along;  ///< unit, away from the origin
};

/// Empty if the body has no area.
std::optional<Bone> bone_of(const TriMesh& mesh) {
  const Vec3 middle = area_centroid(mesh);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    const double size = (b - a).cross(c - a).norm() / 2;
    // Second moments of a triangle: those of its corners and its middle, a twelfth and three quarters.
    for (const Vec3& corner : {a, b, c})
      spread += size / 12 * (corner - middle) * (corner - middle).transpose();
    const Vec3 mean = (a + b + c) / 3 - middle;
    spread += 0.75 * size * mean * mean.transpose();
  }
  if (!(spread.trace() > 0)) return std::nullopt;
  const auto [moments, axes] = core::axes_of(spread);
  const bool is_shaft = moments[2] > least_slenderness * least_slenderness * std::max(moments[1], 0.0);
  const Vec3 axis = axes.col(2);
  return Bone{middle, is_shaft, axis.dot(middle) < 0 ? Vec3(-axis) : axis};
}

/// How far a surface reaches along a direction from the origin, mm.
struct Reach {
  double begin = HUGE_VAL, end = -HUGE_VAL;

  double length() const noexcept { return end - begin; }
};

Reach reach_along(const Vec3& direction, const TriMesh& mesh, const Pose& X) {
  Reach reach;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const double along = (X * mesh.corner(t, k)).dot(direction);
      reach.begin = std::min(reach.begin, along), reach.end = std::max(reach.end, along);
    }
  return reach;
}

/// Whether the bone is a shaft that begins about the origin.
bool begins_at_joint(const Bone& bone, const TriMesh& mesh) {
  if (!bone.is_shaft) return false;
  const double lever = bone.middle.dot(bone.along);
  const Reach reach = reach_along(bone.along, mesh, Pose::Identity());
  return std::abs(reach.begin) <= farthest_from_end * reach.length() &&
         (bone.middle - lever * bone.along).norm() <= farthest_beside * lever;
}

/// What stands above the fixed bone in the reference pose.
enum class Above { nothing, small_bone, other_bone };

/// Whether the mobile bone is none that another one hangs from, beside the end of the fixed one that it lies at.
bool is_small(const TriMesh& mobile, const Pose& X_FM, const TriMesh& fixed, const Vec3& up,
              double end_begins) {
  double volume = 1;
  for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())})
    volume *= reach_along(axis, mobile, X_FM).length();
  Reach end;
  for (std::size_t t = 0; t < fixed.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Vec3 corner = fixed.corner(t, k);
      if (corner.dot(up) < end_begins) continue;
      end.begin = std::min(end.begin, corner.z()), end.end = std::max(end.end, corner.z());
    }
  const double breadth = end.length();
  return volume < smallest_upper_bone * breadth * breadth * breadth;
}

/// A patella's upper end lies beyond that of its tibia; other bones stand end to end.
Above above_fixed(const Joint& joint, const Bone& fixed, const Bone& mobile, const Pose& X_FM) {
  const Vec3 up = (X_FM * mobile.middle - fixed.middle).normalized();
  if (!(up.y() > straight)) return Above::nothing;
  const Mesh &below = mesh::outer_surface(joint.fixed.mesh), &above = mesh::outer_surface(joint.mobile.mesh);
  const Reach lower = reach_along(up, below, Pose::Identity()), upper = reach_along(up, above, X_FM);
  if (upper.end >= lower.end && is_small(above, X_FM, below, up, lower.end - upper.length()))
    return Above::small_bone;
  const double overlap = lower.end - upper.begin;
  return overlap <= most_overlap * std::min(lower.length(), upper.length()) ? Above::other_bone
                                                                            : Above::nothing;
}

/// The distance from a hinge's axis, or a ball's centre, to where the bodies are nearest each other; 0 if they have no surface.
double distance_to_bones(const Joint& joint, const Pose& X_FM) {
  const auto nearest =
      mesh::closest_points(*mesh::tree_of(joint.fixed.mesh), *mesh::tree_of(joint.mobile.mesh), X_FM);
  if (!nearest) return 0;
  const Vec3 middle = (nearest->a_point + nearest->b_point) / 2;
  return joint.kind == JointKind::hinge ? core::hypotenuse(middle.x(), middle.y()) : middle.norm();
}

/// A whole femur: from its condyles to its head, and how far the head lies to the right of the line along the bone, mm. That line
/// passes between head and shaft.
struct WholeFemur {
  Vec3 up;
  double head_to_right;
};

/// Empty if that end of the bone has no head.
std::optional<WholeFemur> whole_femur(const Bone& femur, const TriMesh& mesh, const Vec3& towards_head) {
  if (!femur.is_shaft) return std::nullopt;
  const Vec3 up = femur.along.dot(towards_head) < 0 ? Vec3(-femur.along) : femur.along;
  const Reach reach = reach_along(up, mesh, Pose::Identity());
  const double length = reach.length();
  const Vec3 end = femur.middle + (reach.end - femur.middle.dot(up)) * up;
  try {
    const SphericalPatch head = find_sphere_on(mesh, {.smallest_radius = smallest_head * length,
                                                      .largest_radius = largest_head * length,
                                                      .within = Sphere{end, head_reach * length}});
    if (head.coverage < least_head_coverage) return std::nullopt;
    const Vec3 from_line = head.fit.sphere.centre - femur.middle;
    return WholeFemur{up, (from_line - from_line.dot(up) * up).z()};
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

double lateral_mm(const WholeFemur& femur, Side side) {
  return side == Side::right ? femur.head_to_right : -femur.head_to_right;
}

const char* side_word(Side side) {
  return side == Side::right ? "right" : "left";
}

/// The head of a femur lies above its condyles and medial of its shaft, wherever the frame has its origin.
std::optional<JointNote> femur_note(const Joint& joint, const Bone& bone, const Vec3& other_bone) {
  const auto femur = whole_femur(bone, mesh::outer_surface(joint.fixed.mesh), bone.middle - other_bone);
  if (!femur) return std::nullopt;
  const std::string& name = joint.fixed.name;
  if (femur->up.y() < upright) {
    if (joint.kind != JointKind::free) return std::nullopt;  // by its shaft
    return JointNote{JointNoteCode::axes_not_upright,
                     "the head of " + name + " does not lie above the joint: superior does not point up"};
  }
  if (lateral_mm(*femur, joint.side) < least_offset_mm) return std::nullopt;
  return JointNote{JointNoteCode::wrong_side,
                   "the side is " + std::string(side_word(joint.side)) + ", but the head of " + name +
                       formatted(" lies %.0f mm lateral of its shaft: it is the other side's or mirrored, or "
                                 "the axes are turned",
                                 std::abs(femur->head_to_right))};
}

}  // namespace

std::optional<JointNote> hip_side_note(const Joint& joint) {
  const auto hip_bone = bone_of(mesh::outer_surface(joint.fixed.mesh)),
             bone = bone_of(mesh::outer_surface(joint.mobile.mesh));
  if (!hip_bone || !bone) return std::nullopt;
  const auto femur = whole_femur(*bone, mesh::outer_surface(joint.mobile.mesh), -bone->middle);
  if (!femur || femur->up.y() < upright || lateral_mm(*femur, joint.side) < least_offset_mm)
    return std::nullopt;
  const double outwards = (joint.side == Side::right ? 1 : -1) * hip_bone->middle.normalized().z();
  if (outwards < upright) return std::nullopt;
  return JointNote{
      JointNoteCode::wrong_side,
      "the side is " + std::string(side_word(joint.side)) + ", but " + joint.fixed.name +
          " lies lateral of the joint, and the head of " + joint.mobile.name +
          " lateral of its shaft: they are the other side's or mirrored, or the axes are turned"};
}

std::vector<JointNote> long_bone_notes(const Joint& joint, const JointPlacement& placement) {
  std::vector<JointNote> notes;
  if (!joint.names_its_joint() || joint.anatomy == Anatomy::hip) return notes;
  const std::string &fixed_name = joint.fixed.name, &mobile_name = joint.mobile.name;
  const auto fixed = bone_of(mesh::outer_surface(joint.fixed.mesh)),
             mobile = bone_of(mesh::outer_surface(joint.mobile.mesh));
  if (!fixed || !mobile) return notes;
  const Pose X_FM = pose_at(joint.coordinates(), placement.reference_pose, joint.translation_frame);
  const Above above =
      joint.anatomy == Anatomy::shoulder ? Above::nothing : above_fixed(joint, *fixed, *mobile, X_FM);
  if (above == Above::other_bone)
    notes.push_back(
        {JointNoteCode::swapped_bodies, fixed_name + " lies below " + mobile_name +
                                            ": are the bodies exchanged, or does superior point down?"});
  if (above != Above::nothing) return notes;
  if (joint.anatomy == Anatomy::knee) {
    auto note = condyle_note(joint, X_FM);
    if (!note) note = femur_note(joint, *fixed, X_FM * mobile->middle);
    if (note) notes.push_back(std::move(*note));
  }
  if (joint.kind == JointKind::free) return notes;
  const bool said_already = !notes.empty() && notes.back().code == JointNoteCode::axes_not_upright;
  if (!said_already && joint.anatomy != Anatomy::shoulder &&
      begins_at_joint(*fixed, mesh::outer_surface(joint.fixed.mesh)) && fixed->along.y() < upright)
    notes.push_back(
        {JointNoteCode::axes_not_upright,
         fixed_name +
             " does not lie above the joint: superior does not point up, or the centre is at its other end"});
  if (joint.anatomy != Anatomy::ankle && begins_at_joint(*mobile, mesh::outer_surface(joint.mobile.mesh)) &&
      -mobile->along.y() < upright)
    notes.push_back(
        {JointNoteCode::axes_not_upright,
         mobile_name +
             " does not hang down from the joint at zero angles: superior or the reference pose is wrong"});
  if (joint.anatomy == Anatomy::shoulder) return notes;
  if (const double off = distance_to_bones(joint, X_FM); off > farthest_from_axis_mm)
    notes.push_back({JointNoteCode::far_centre,
                     std::string(joint.kind == JointKind::hinge ? "the axis" : "the joint centre") +
                         formatted(" is %.0f mm from where ", off) + fixed_name + " and " + mobile_name +
                         " are nearest each other"});
  return notes;
}

}  // namespace condyle::kinematics
