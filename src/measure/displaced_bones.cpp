#include "measure/displaced_bones.hpp"

namespace condyle::measure {

DisplacedBones::DisplacedBones(const Joint& joint, const MeasureRequest& request, const Uncertainty& sigma)
    : system_(joint.coordinates()),
      request_(request),
      meshes_(bones_of(joint)),
      parts_(find_parts(joint, meshes_)),
      hip_bone_(Body{joint.fixed.name, meshes_.hip_bone, {}, joint.fixed.image}, sigma),
      femur_(Body{joint.mobile.name, meshes_.femur, {}, joint.mobile.image}, sigma) {}

HipMeasures DisplacedBones::measured(const motion::Displacement& by) const {
  const Pose X_GF = inverted(motion::displaced_frame(by));
  const auto placed = [&](const Mesh& mesh, const motion::MovableSurface& surface, double moved) {
    const auto vertices = surface.moved_by(moved);
    return TriMesh{posed(X_GF, vertices ? vertices->view() : mesh.vertices().view()), mesh.triangles()};
  };
  const Bones bones{placed(meshes_.hip_bone, hip_bone_, by.fixed_surface),
                    placed(meshes_.femur, femur_, by.mobile_surface)};
  return measure_bones(bones, placed_parts(bones, X_GF.linear()), system_, request_);
}

/// The head keeps its vertices, and its centre is as far from the joint's as it was.
FoundParts DisplacedBones::placed_parts(const Bones& bones, const Eigen::Matrix3d& R_GF) const {
  FoundParts parts = parts_;
  if (parts.opening) parts.opening = R_GF * *parts.opening;
  if (parts.head) {
    parts.head->fit = fit_sphere(bones.femur.vertices, parts.head->fit.vertices);
    parts.head->fit.sphere.centre = R_GF * parts_.head->fit.sphere.centre;
  }
  return parts;
}

}  // namespace condyle::measure
