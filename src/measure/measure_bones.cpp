#include "measure/measure_bones.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/error.hpp"
#include "core/lazy.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_parts.hpp"
#include "kinematics/surface_points.hpp"
#include "measure/femoral_version.hpp"
#include "measure/ischiofemoral.hpp"
#include "measure/joint_space.hpp"
#include "measure/measure_acetabulum.hpp"
#include "measure/measure_femur.hpp"
#include "mesh/edge_table.hpp"
#include "mesh/findings.hpp"

namespace condyle::measure {
namespace {

constexpr const char* no_head = "no spherical head is on the femur around the joint centre";

bool is_bone(const BodyPart& part) {
  return part.contact == PartContact::ends;
}

Mesh bone_of(const Body& body) {
  const bool some = std::any_of(body.parts.begin(), body.parts.end(), is_bone);
  if (!some || std::all_of(body.parts.begin(), body.parts.end(), is_bone)) return body.mesh;
  TriMesh bone{body.mesh.vertices(), {}};
  for (const BodyPart& part : body.parts) {
    if (!is_bone(part)) continue;
    const auto first = body.mesh.triangles().begin() + static_cast<std::ptrdiff_t>(part.first_triangle);
    bone.triangles.insert(bone.triangles.end(), first, first + static_cast<std::ptrdiff_t>(part.triangles));
  }
  return bone;
}

std::vector<char> ends_of(const Body& body, const Mesh& bone) {
  std::vector<char> ends(bone.vertices().size());
  if (!bone.is_closed()) {
    const mesh::EdgeTable& edges = mesh::edges_of(bone);
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (edges.balance(bone, e) != 0)
        for (const Index v : edges.ends(e)) ends[v] = 1;
  }
  if (body.image && !body.image->cuts.empty())
    for (std::size_t v = 0; v < ends.size(); ++v) ends[v] |= is_on_cut(body, bone.vertices()[v]);
  return ends;
}

/// Kept with the femur: the head that it is searched with is that of the mesh.
struct KeptSearch {
  core::Lazy<std::string> why_no_condyles;
};

void set_both(const Bones& bones, const Sphere& head, const FoundParts& parts, CoordinateSystem system,
              const MeasureRequest& request, BothMeasures& out) {
  const JointSpaceFinding space = joint_space(bones, head, parts.socket);
  out.joint_space_least = space.space ? measured(space.space->least_mm) : not_measured(space.why_none);
  out.joint_space_median = space.space ? measured(space.space->median_mm) : not_measured(space.why_none);
  if (space.space) out.joint_space_at = space.space->at;
  const auto nearest = ischiofemoral_distance(bones, head, pose_at(system, request.ischiofemoral_pose));
  out.ischiofemoral = measured_or(nearest.distance_mm, nearest.why_none);
  out.ischiofemoral_at = nearest.at;
}

}  // namespace

void check_measures(const Joint& joint, const MeasureRequest& request) {
  if (!joint.is_hip() || joint.kind == JointKind::hinge) throw UsageError("measures: the joint is no hip");
  if (!(std::abs(request.pelvic_tilt.degrees()) <= largest_pelvic_tilt_deg))
    throw UsageError("measures: the pelvic tilt must be between -60 and 60 degrees");
  const JointAngles& pose = request.ischiofemoral_pose;
  for (const Angle angle : {pose.flexion, pose.adduction, pose.internal_rotation})
    if (!std::isfinite(angle.radians()))
      throw UsageError("measures: the pose has an angle that is not finite");
}

BoneMeshes bones_of(const Joint& joint) {
  return {bone_of(joint.fixed), bone_of(joint.mobile)};
}

FoundParts find_parts(const Joint& joint, const BoneMeshes& bones) {
  FoundParts parts;
  parts.hip_bone_ends = ends_of(joint.fixed, bones.hip_bone);
  parts.femur_ends = ends_of(joint.mobile, bones.femur);
  if (joint.mobile.head) kinematics::keep_head(bones.femur, *joint.mobile.head);
  parts.head = kinematics::head_near_centre(bones.femur);
  if (!parts.head) return parts;
  const Sphere& head = parts.head->fit.sphere;
  if (joint.fixed.head) {
    if (const auto socket = kinematics::patch_on(bones.hip_bone, *joint.fixed.head))
      parts.socket = socket->fit.vertices;
  } else if (const auto socket = kinematics::socket_around(bones.hip_bone, head);
             *socket && kinematics::fits_into(head, **socket)) {
    parts.socket = (*socket)->fit.vertices;
  }
  if (const auto rim = kinematics::rim_around(bones.hip_bone, head); *rim) parts.opening = (*rim)->opening;
  parts.why_no_condyles =
      mesh::findings_of(bones.femur).get<KeptSearch>().why_no_condyles.get([&](std::string& why) {
        why = why_no_condyles(bones.femur, head);
      });
  return parts;
}

HipMeasures measure_bones(const Bones& bones, const FoundParts& parts, CoordinateSystem system,
                          const MeasureRequest& request) {
  const BodyAxes femur_axes = body_axes(system.side),
                 pelvis_axes = body_axes(system.side, request.pelvic_tilt);
  HipMeasures out;
  out.pelvic_tilt = request.pelvic_tilt;
  out.pelvis_frame = request.pelvis_frame;
  out.both.ischiofemoral_pose = request.ischiofemoral_pose;
  if (!parts.head) {
    out.femur = femur_not_measured(no_head);
    out.acetabulum = acetabulum_not_measured(no_head, pelvis_axes);
    out.both.joint_space_least = out.both.joint_space_median = out.both.ischiofemoral = not_measured(no_head);
    return out;
  }
  const Sphere& head = parts.head->fit.sphere;
  out.femur = measure_femur(bones.femur, *parts.head, parts, femur_axes);
  out.acetabulum = measure_acetabulum(bones.hip_bone, head, parts, pelvis_axes);
  set_both(bones, head, parts, system, request, out.both);
  return out;
}

}  // namespace condyle::measure

namespace condyle {

HipMeasures measure_hip(const Joint& joint, const MeasureRequest& request) {
  measure::check_measures(joint, request);
  const measure::BoneMeshes bones = measure::bones_of(joint);
  return measure::measure_bones({bones.hip_bone, bones.femur}, measure::find_parts(joint, bones),
                                joint.coordinates(), request);
}

}  // namespace condyle
