#include "kinematics/femoral_axes.hpp"

#include "core/lazy.hpp"
#include "kinematics/condylar_line.hpp"
#include "kinematics/hip_parts.hpp"
#include "mesh/findings.hpp"

namespace condyle::kinematics {
namespace {

/// The cosine of the 60 degrees within which a leg lies.
constexpr double least_cosine = 0.5;

struct KeptAxes {
  core::Lazy<std::optional<Eigen::Matrix3d>> axes;
};

std::optional<Eigen::Matrix3d> axes_of(const Mesh& femur) {
  const std::optional<SphericalPatch>& patch = head_near_centre(femur);
  if (!patch) return std::nullopt;
  const Sphere& head = patch->fit.sphere;
  if (!may_reach_knee(femur, head)) return std::nullopt;
  const auto line = condylar_line(femur, head, Vec3::UnitX(), Vec3::UnitZ());
  if (!line || !touches_condyles(*line, head)) return std::nullopt;
  const Vec3 y = (head.centre - line->middle).normalized();
  const Vec3 along = line->last - line->first, z = (along - along.dot(y) * y).normalized();
  // Elsewhere the sphere at the origin is no head, or the frame is not that of a leg: other checks say so.
  if (y.y() < least_cosine || z.z() < least_cosine) return std::nullopt;
  Eigen::Matrix3d axes;
  axes << y.cross(z), y, z;
  return axes;
}

}  // namespace

const std::optional<Eigen::Matrix3d>& femoral_axes(const Mesh& femur) {
  return mesh::findings_of(femur).get<KeptAxes>().axes.get(
      [&](std::optional<Eigen::Matrix3d>& axes) { axes = axes_of(femur); });
}

}  // namespace condyle::kinematics
