#include <algorithm>
#include <string>
#include <utility>

#include "condyle/brush.hpp"
#include "condyle/error.hpp"
#include "kinematics/posed_parts.hpp"
#include "plan/planned.hpp"

namespace condyle::plan {
namespace {

const Body& body_of(const Joint& joint, BodyRole role) {
  return role == BodyRole::mobile ? joint.mobile : joint.fixed;
}

bool is_bone_alone(const Body& body) {
  return std::all_of(body.parts.begin(), body.parts.end(),
                     [](const BodyPart& part) { return part.contact == PartContact::ends; });
}

/// With the bone as it is now. What bears is what bore: a fit to a surface that was cut would move it.
Joint with_brushed_bone(const Joint& joint, BodyRole role, const Points& vertices,
                        const motion::BearingFinding& bearing) {
  Joint brushed = joint;
  Body& bone = role == BodyRole::mobile ? brushed.mobile : brushed.fixed;
  bone.mesh = bone.mesh.moved_to(vertices);
  if (bearing.surface) {
    brushed.mobile.bearing_margin_mm = bearing.surface->margin_mm;
    if (bearing.surface->parts.empty()) brushed.mobile.head = bearing.surface->head;
    if (is_bone_alone(joint.fixed)) brushed.fixed.head = bearing.surface->socket;
  }
  kinematics::take_as_moved(brushed);
  return brushed;
}

/// Both kinds of vertices that stay.
std::vector<std::uint8_t> joined(std::vector<std::uint8_t> marks, const std::vector<std::uint8_t>& others) {
  if (!others.empty() && others.size() != marks.size())
    throw UsageError("brush: " + std::to_string(others.size()) + " marks of vertices for " +
                     std::to_string(marks.size()));
  for (std::size_t v = 0; v < others.size(); ++v) marks[v] |= others[v];
  return marks;
}

}  // namespace

std::vector<std::uint8_t> protected_vertices(const Joint& joint, BodyRole role,
                                             const motion::ContactRoles& roles) {
  const Mesh& mesh = body_of(joint, role).mesh;
  const std::vector<motion::ContactRole>& of_body = role == BodyRole::mobile ? roles.mobile : roles.fixed;
  std::vector<std::uint8_t> marks(mesh.vertices().size(), 0);
  for (std::size_t t = 0; t < of_body.size(); ++t)
    if (of_body[t] != motion::ContactRole::ends)
      for (const Index v : mesh.triangles()[t]) marks[v] = 1;
  return marks;
}

BrushedJoint brush_joint(const Joint& joint, const BrushRequest& request,
                         std::span<const motion::Motion> motions) {
  const Body& bone = body_of(joint, request.body);
  if (joint.implant)
    throw UsageError("brush: the joint has an implant, and a stroke does not know it from bone");
  if (is_cut(bone))
    throw UsageError("brush: a part is cut from " + bone.name +
                     ": bone can be taken from the other body only");
  const motion::RangeOfMotion before(joint, request.range);
  Brush brush(bone, joined(protected_vertices(joint, request.body, before.bearing().roles), request.stays));
  std::vector<StrokeOutcome> outcomes;
  for (const BrushStroke& stroke : request.strokes) outcomes.push_back(brush.stroke(stroke));
  const motion::RangeOfMotion after(before, request.body, brush.vertices());
  Joint brushed = with_brushed_bone(joint, request.body, brush.vertices(), before.bearing());
  BrushedBone removed = brush.removed();
  if (removed.volume_mm3 > 0)
    add_planned(brushed, without_bone(removed.volume_mm3, bone.name) + " by strokes");
  return {.joint = std::move(brushed),
          .strokes = std::move(outcomes),
          .removed = std::move(removed),
          .depth_mm = brush.depth_mm(),
          .before = before.limits(motions),
          .after = after.limits(motions)};
}

}  // namespace condyle::plan
