#include "page_edit.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "condyle/brush.hpp"
#include "condyle/error.hpp"
#include "page_joint.hpp"

using namespace condyle;

namespace {

BodyRole role_of(int of_fixed) {
  return of_fixed ? BodyRole::fixed : BodyRole::mobile;
}

std::optional<plan::Brush>& brush_of(CondyleJoint& joint, int of_fixed) {
  return of_fixed ? joint.edit.fixed : joint.edit.mobile;
}

plan::Brush& ready_brush(CondyleJoint& joint, int of_fixed) {
  auto& brush = brush_of(joint, of_fixed);
  if (!brush) throw UsageError("brush: the bone was not made ready");
  return *brush;
}

const plan::Brush& ready_brush(const CondyleJoint& joint, int of_fixed) {
  return ready_brush(const_cast<CondyleJoint&>(joint), of_fixed);
}

/// The joint with a bone as its brush has it; what was made of the other one stays.
void take_brushed(CondyleJoint& joint, BodyRole role, const Points& vertices) {
  Body& bone = body_of(joint, role == BodyRole::fixed);
  bone.mesh = bone.mesh.moved_to(vertices);
  joint.bodies = contact::JointContact(joint.bodies, role, bone.mesh);
  (role == BodyRole::fixed ? joint.to_fixed : joint.to_mobile).reset();
  joint.edit.about.reset();
  joint.counted.reset();
  if (!joint.range) return;
  const bool is_held = role == BodyRole::fixed && joint.range_held_at != Vec3::Zero();
  joint.range = std::make_shared<const motion::RangeOfMotion>(
      *joint.range, role, is_held ? shifted(vertices, -joint.range_held_at) : vertices);
}

/// As they were found before anything is cut: a search on a surface that is cut would find others.
void keep_roles(CondyleJoint& joint) {
  if (!joint.bearing.roles) joint.bearing.roles = range_of(joint).bearing().roles;
}

}  // namespace

int condyle_brush(CondyleJoint* joint, int of_fixed, const double* before) {
  return guarded(-1, [&] {
    if (joint->pressure.contact) throw UsageError("brush: its layers lie on the bone as it is");
    keep_roles(*joint);
    const Body& bone = body_of(*joint, of_fixed);
    std::vector<std::uint8_t> stays =
        plan::protected_vertices(joint->joint, role_of(of_fixed), *joint->bearing.roles);
    const auto count = std::count(stays.begin(), stays.end(), 1);
    brush_of(*joint, of_fixed) =
        before ? plan::Brush(bone, points_of(before, bone.mesh.vertices().size()), std::move(stays))
               : plan::Brush(bone, std::move(stays));
    return static_cast<int>(count);
  });
}

int condyle_stroke(CondyleJoint* joint, int of_fixed, int action, const std::uint32_t* along, int count,
                   double radius_mm, double depth_mm, std::uint32_t outcome[3]) {
  return guarded(-1, [&] {
    constexpr std::array actions{plan::BrushAction::lower, plan::BrushAction::restore};
    plan::Brush& brush = ready_brush(*joint, of_fixed);
    const plan::StrokeOutcome done = brush.stroke({.action = actions.at(static_cast<std::size_t>(action)),
                                                   .along = std::vector<Index>(along, along + count),
                                                   .radius_mm = radius_mm,
                                                   .depth_mm = depth_mm});
    take_brushed(*joint, role_of(of_fixed), brush.vertices());
    outcome[0] = static_cast<std::uint32_t>(done.moved);
    outcome[1] = static_cast<std::uint32_t>(done.kept);
    outcome[2] = static_cast<std::uint32_t>(done.limited);
    return 0;
  });
}

int condyle_undo_stroke(CondyleJoint* joint, int of_fixed) {
  return guarded(-1, [&] {
    plan::Brush& brush = ready_brush(*joint, of_fixed);
    if (!brush.undo()) return 0;
    take_brushed(*joint, role_of(of_fixed), brush.vertices());
    return 1;
  });
}

int condyle_strokes(const CondyleJoint* joint, int of_fixed) {
  return guarded(-1, [&] { return static_cast<int>(ready_brush(*joint, of_fixed).steps()); });
}

int condyle_removed(const CondyleJoint* joint, int of_fixed, double removed[4]) {
  return guarded(-1, [&] {
    const plan::Brush& brush = ready_brush(*joint, of_fixed);
    const plan::BrushedBone bone = brush.removed();
    removed[0] = bone.volume_mm3;
    removed[1] = bone.deepest_mm;
    removed[2] = bone.deepest_vertex ? static_cast<double>(*bone.deepest_vertex) : -1;
    removed[3] = brush.edge_mm();
    return 0;
  });
}

int condyle_brushed(const CondyleJoint* joint, int of_fixed, double* vertices, double* depths_mm) {
  return guarded(-1, [&] {
    const plan::Brush& brush = ready_brush(*joint, of_fixed);
    put_points(brush.vertices(), vertices);
    std::copy(brush.depth_mm().begin(), brush.depth_mm().end(), depths_mm);
    return 0;
  });
}

int condyle_move_centre(CondyleJoint* joint, const double* centre_mm, const double* reference_deg) {
  return guarded(-1, [&] {
    if (joint->joint.kind == JointKind::free) throw UsageError("centre: that of a free joint is not held");
    const Vec3 in_F(centre_mm[0], centre_mm[1], centre_mm[2]);
    const Vec3 in_M = inverted(pose_at(joint->joint.coordinates(), angles_of(reference_deg))).linear() * in_F;
    joint->edit.about = std::make_shared<const motion::RangeOfMotion>(range_of(*joint), -in_F, -in_M);
    joint->edit.centre_mm = in_F;
    return 0;
  });
}

int condyle_limit_about(CondyleJoint* joint, int vary, int positive, const double* start_deg,
                        double range_deg, double limit[8]) {
  return guarded(-1, [&] {
    if (!joint->edit.about) throw UsageError("centre: it was not moved");
    put_limit(*joint->edit.about, {vary, positive != 0, start_deg, range_deg}, joint->edit.centre_mm, limit);
    return 0;
  });
}
