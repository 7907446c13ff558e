#include "measure/measure_bones.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/lazy.hpp"
#include "kinematics/cut_parts.hpp"
#include "kinematics/flat_ends.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_parts.hpp"
#include "kinematics/surface_points.hpp"
#include "measure/bone_pieces.hpp"
#include "measure/femoral_version.hpp"
#include "measure/ischiofemoral.hpp"
#include "measure/joint_space.hpp"
#include "measure/measure_acetabulum.hpp"
#include "measure/measure_femur.hpp"
#include "measure/rim.hpp"
#include "measure/solid_angle.hpp"
#include "mesh/edge_table.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/findings.hpp"

namespace condyle::measure {
namespace {

/// Components of a mesh are considered within this many radii of the head.
constexpr double pieces_reach = 2;
/// A head farther from the centre of its socket, in its radii, has left it: to there the plane of a rim is found as from the centre.
constexpr double farthest_apart = 0.25;

bool is_bone(const BodyPart& part) {
  return part.contact == PartContact::ends;
}

/// Without faces in which parts were cut from it.
Mesh bone_of(const Body& body) {
  const bool some = std::any_of(body.parts.begin(), body.parts.end(), is_bone);
  if (!some || std::all_of(body.parts.begin(), body.parts.end(), is_bone))
    return kinematics::uncut_surface(body);
  TriMesh bone{body.mesh.vertices(), {}};
  for (const BodyPart& part : body.parts) {
    if (!is_bone(part)) continue;
    const auto first = body.mesh.triangles().begin() + static_cast<std::ptrdiff_t>(part.first_triangle);
    bone.triangles.insert(bone.triangles.end(), first,
                          first + static_cast<std::ptrdiff_t>(part.triangles - part.cut_triangles));
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
    // Where a part was cut off the bone goes on.
    const std::vector<char> cut = kinematics::cut_vertices(body);
    for (std::size_t v = 0; v < cut.size(); ++v) ends[v] &= !cut[v];
  }
  if (body.image && !body.image->cuts.empty())
    for (std::size_t v = 0; v < ends.size(); ++v) ends[v] |= is_on_cut(body, bone.vertices()[v]);
  if (const std::vector<ImageCut>& flat = kinematics::flat_ends(bone); !flat.empty())
    for (std::size_t v = 0; v < ends.size(); ++v) ends[v] |= is_on_cut(flat, bone.vertices()[v]);
  return ends;
}

/// Its head, or its shaft's cortex: that of the piece which has the head.
OwnPieces piece_with(const Mesh& femur, const Body& body, const SphericalPatch& head) {
  std::vector<char> is_head(femur.vertices().size());
  for (const Index v : head.fit.vertices) is_head[v] = 1;
  const Sphere& sphere = head.fit.sphere;
  const auto vote = [&](std::size_t t) {
    const auto [i, j, k] = femur.triangles()[t];
    return is_head[i] + is_head[j] + is_head[k];
  };
  return own_pieces(femur, body.name, {sphere.centre, pieces_reach * sphere.radius},
                    kinematics::cut_vertices(body), vote);
}

/// The piece that faces most of the head across the joint space.
OwnPieces piece_around(const Mesh& hip_bone, const Body& body, const Sphere& head) {
  const auto vote = [&](std::size_t t) {
    const double gap = (hip_bone.corner(t, 0) - head.centre).norm() - head.radius;
    return std::abs(gap) < by_head(farthest_wall_mm, head)
               ? std::max(0.0, -solid_angle(hip_bone, t, head.centre))
               : 0;
  };
  return own_pieces(hip_bone, body.name, {head.centre, pieces_reach * head.radius},
                    kinematics::cut_vertices(body), vote);
}

bool is_inside_out(const Mesh& bone) {
  return bone.is_closed() && mesh::is_inside_out(bone);
}

std::string why_no_head(const Body& femur, const Mesh& bone) {
  if (is_inside_out(bone)) return femur.name + "'s triangles are wound the other way: heads are sockets";
  return "no spherical head is on the femur around the joint centre";
}

/// The sphere of the socket, that which is stated or one that the head fits into.
std::optional<SphericalPatch> socket_of(const Body& fixed, const Mesh& hip_bone, const Sphere& head) {
  if (fixed.head) return kinematics::patch_on(hip_bone, *fixed.head, SphericalPart::socket);
  const auto found = kinematics::socket_around(hip_bone, head);
  if (!*found || !kinematics::fits_into(head, **found)) return std::nullopt;
  return **found;
}

void set_socket(const Body& fixed, const Mesh& hip_bone, const Sphere& head, BoneParts& parts) {
  const auto socket = socket_of(fixed, hip_bone, head);
  if (!socket) {
    parts.socket_note = "no socket's sphere was found around the head: what faces it may be no socket";
    return;
  }
  parts.socket = socket->fit.vertices;
  if (const double apart = (socket->fit.sphere.centre - head.centre).norm();
      apart > farthest_apart * head.radius)
    parts.socket_note = core::formatted("the centres of head and socket are %.0f mm apart", apart);
}

/// A hip bone that is inside out faces the head with the wall behind its socket.
void set_opening(const std::string& name, const Mesh& hip_bone, const Sphere& head, BoneParts& parts) {
  if (is_inside_out(hip_bone))
    parts.why_no_opening = name + "'s triangles are wound the other way: its socket faces away from the head";
  else if (const auto rim = kinematics::rim_around(hip_bone, head); *rim)
    parts.opening = (*rim)->opening;
  else
    parts.why_no_opening = "no socket faces the head";
}

/// Kept with the femur: the head that it is searched with is that of the mesh.
struct KeptSearch {
  core::Lazy<std::string> why_no_condyles;
};

void set_both(const Bones& bones, const Sphere& head, const BoneParts& parts, CoordinateSystem system,
              const MeasureOptions& request, BothMeasures& out) {
  const JointSpaceFinding space = joint_space(bones, head, parts.socket);
  out.joint_space_least = space.space ? measured(space.space->least_mm) : not_measured(space.why_none);
  out.joint_space_median = space.space ? measured(space.space->median_mm) : not_measured(space.why_none);
  if (space.space) out.joint_space_at = space.space->at;
  const auto nearest = ischiofemoral_distance(bones, head, pose_at(system, request.ischiofemoral_pose));
  out.ischiofemoral = measured_or(nearest.distance_mm, nearest.why_none);
  out.ischiofemoral_at = nearest.at;
}

}  // namespace

void check_measures(const Joint& joint, const MeasureOptions& request) {
  if (!joint.is_hip() || joint.kind == JointKind::hinge) throw UsageError("measures: the joint is no hip");
  if (!(std::abs(request.pelvic_tilt.degrees()) <= largest_pelvic_tilt_deg))
    throw UsageError("measures: the pelvic tilt must be between -60 and 60 degrees");
  const JointAngles& pose = request.ischiofemoral_pose;
  for (const Angle angle : {pose.flexion, pose.adduction, pose.internal_rotation})
    if (!std::isfinite(angle.radians()))
      throw UsageError("measures: the pose has an angle that is not finite");
}

BoneMeshes bones_of(const Joint& joint) {
  BoneMeshes bones{bone_of(joint.fixed), bone_of(joint.mobile), {}};
  if (joint.mobile.head) kinematics::keep_head(bones.femur, *joint.mobile.head);
  const std::optional<SphericalPatch> head = kinematics::head_near_centre(bones.femur);
  if (!head) return bones;
  OwnPieces femur = piece_with(bones.femur, joint.mobile, *head),
            hip_bone = piece_around(bones.hip_bone, joint.fixed, head->fit.sphere);
  for (OwnPieces* own : {&femur, &hip_bone})
    if (!own->left_out.empty()) bones.left_out.push_back(std::move(own->left_out));
  bones.femur = std::move(femur.mesh), bones.hip_bone = std::move(hip_bone.mesh);
  if (joint.mobile.head)
    kinematics::keep_head(bones.femur, *joint.mobile.head);
  else
    kinematics::keep_head(bones.femur, head->fit.vertices);
  return bones;
}

BoneParts find_parts(const Joint& joint, const BoneMeshes& bones) {
  BoneParts parts;
  parts.left_out = bones.left_out;
  parts.hip_bone_ends = ends_of(joint.fixed, bones.hip_bone);
  parts.femur_ends = ends_of(joint.mobile, bones.femur);
  parts.head = kinematics::head_near_centre(bones.femur);
  if (!parts.head) {
    parts.why_no_head = why_no_head(joint.mobile, bones.femur);
    return parts;
  }
  const Sphere& head = parts.head->fit.sphere;
  set_socket(joint.fixed, bones.hip_bone, head, parts);
  set_opening(joint.fixed.name, bones.hip_bone, head, parts);
  parts.why_no_condyles =
      mesh::findings_of(bones.femur).get<KeptSearch>().why_no_condyles.get([&](std::string& why) {
        why = why_no_condyles(bones.femur, head);
      });
  return parts;
}

HipMeasures measure_bones(const Bones& bones, const BoneParts& parts, CoordinateSystem system,
                          const MeasureOptions& request) {
  const BodyAxes femur_axes = body_axes(system.side),
                 pelvis_axes = body_axes(system.side, request.pelvic_tilt);
  HipMeasures out;
  out.pelvic_tilt = request.pelvic_tilt;
  out.pelvis_frame = request.pelvis_frame;
  out.left_out = parts.left_out;
  out.both.ischiofemoral_pose = request.ischiofemoral_pose;
  if (!parts.head) {
    const std::string& why = parts.why_no_head;
    out.femur = femur_not_measured(why);
    out.acetabulum = acetabulum_not_measured(why, pelvis_axes);
    out.both.joint_space_least = out.both.joint_space_median = out.both.ischiofemoral = not_measured(why);
    return out;
  }
  const Sphere& head = parts.head->fit.sphere;
  out.femur = measure_femur(bones.femur, *parts.head, parts, femur_axes);
  out.acetabulum = measure_acetabulum(bones.hip_bone, head, parts, pelvis_axes);
  set_both(bones, head, parts, system, request, out.both);
  return out;
}

HipMeasures measure_hip(const Joint& joint, const MeasureOptions& request) {
  measure::check_measures(joint, request);
  const BoneMeshes bones = measure::bones_of(joint);
  HipMeasures measures = measure::measure_bones(
      {bones.hip_bone, bones.femur}, measure::find_parts(joint, bones), joint.coordinates(), request);
  // What is found about the centre of such a joint is a ball in a liner.
  if (joint.implant)
    for (const MeasureDefinition& each : measure::measure_definitions())
      measure::add_note(const_cast<Measure&>(each.of(measures)), "of the implant's parts, not of bone");
  return measures;
}

}  // namespace condyle::measure
