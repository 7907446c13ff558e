#include "measure/displaced_by_hand.hpp"

#include <Eigen/Geometry>
#include <vector>

namespace condyle::test {
namespace {

/// R^T (p + d n - t): the rows of the displaced frame, from the one given.
TriMesh displaced(const TriMesh& mesh, double outwards, const Eigen::Matrix3d& R, const Vec3& t) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const Vec3 a = mesh.corner(k, 0);
    const Vec3 area = (mesh.corner(k, 1) - a).cross(mesh.corner(k, 2) - a);
    for (const Index v : mesh.triangles[k]) normals[v] += area;
  }
  TriMesh out{mesh.vertices, mesh.triangles};
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Vec3 n = normals[v].norm() > 0 ? Vec3(normals[v].normalized()) : Vec3(Vec3::Zero());
    out.vertices.set(v, R.transpose() * (mesh.vertices[v] + outwards * n - t));
  }
  return out;
}

}  // namespace

Joint displaced_by_hand(const Joint& joint, const HandDisplacement& by, const std::optional<Sphere>& head) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (by.axes.norm() > 0)
    R = Eigen::Quaterniond(Eigen::AngleAxisd(by.axes.norm(), by.axes.normalized())).toRotationMatrix();
  Joint out = joint;
  out.fixed = {joint.fixed.name, displaced(joint.fixed.mesh, by.fixed_surface, R, by.centre)};
  out.mobile = {joint.mobile.name, displaced(joint.mobile.mesh, by.mobile_surface, R, by.centre)};
  if (head) out.mobile.head = Sphere{R.transpose() * head->centre, head->radius + by.mobile_surface};
  return out;
}

}  // namespace condyle::test
