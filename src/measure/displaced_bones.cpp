#include "measure/displaced_bones.hpp"

namespace condyle::measure {

DisplacedBones::DisplacedBones(const Joint& joint, const MeasureOptions& request,
                               const motion::Uncertainty& sigma)
    : system_(joint.coordinates()),
      request_(request),
      meshes_(bones_of(joint)),
      parts_(find_parts(joint, meshes_)),
      hip_bone_(Body{joint.fixed.name, meshes_.hip_bone, {}, joint.fixed.image}, sigma),
      femur_(Body{joint.mobile.name, meshes_.femur, {}, joint.mobile.image}, sigma),
      hip_bone_parts_(joint, BodyRole::fixed),
      femur_parts_(joint, BodyRole::mobile) {
  if (!parts_.head) return;
  const Sphere& head = parts_.head->fit.sphere;
  of_socket_ = hip_bone_parts_.groups().group_on(joint.fixed.mesh.vertices(), head);
  of_head_ = femur_parts_.groups().group_on(joint.mobile.mesh.vertices(), head);
}

HipMeasures DisplacedBones::measured(const motion::Displacement& by) const {
  const Pose X_GF = inverted(motion::displaced_frame(by));
  const auto placed = [&](const Mesh& mesh, const motion::MovableSurface& surface, double moved,
                          const kinematics::DisplacedParts& parts) {
    const auto vertices = surface.moved_by(moved, parts, by.parameters);
    return TriMesh{posed(X_GF, vertices ? vertices->view() : mesh.vertices().view()), mesh.triangles()};
  };
  const Bones bones{placed(meshes_.hip_bone, hip_bone_, by.fixed_surface, hip_bone_parts_),
                    placed(meshes_.femur, femur_, by.mobile_surface, femur_parts_)};
  return measure_bones(bones, placed_parts(bones, X_GF.linear(), by.parameters), system_, request_);
}

/// The head keeps its vertices, and its centre keeps its distance from the joint's.
BoneParts DisplacedBones::placed_parts(const Bones& bones, const Eigen::Matrix3d& R_GF,
                                       std::span<const double> parameters) const {
  BoneParts parts = parts_;
  const auto of_socket = hip_bone_parts_.motions(parameters), of_head = femur_parts_.motions(parameters);
  if (parts.opening && !of_socket.empty())
    parts.opening = (of_socket[of_socket_].linear() * *parts.opening).normalized();
  if (parts.opening) parts.opening = R_GF * *parts.opening;
  if (parts.head) {
    parts.head->fit = fit_sphere(bones.femur.vertices, parts.head->fit.vertices);
    const Vec3& centre = parts_.head->fit.sphere.centre;
    parts.head->fit.sphere.centre = R_GF * (of_head.empty() ? centre : Vec3(of_head[of_head_] * centre));
  }
  return parts;
}

}  // namespace condyle::measure
