#include "motion/rom/displacement.hpp"

#include <algorithm>

#include "core/rotation_about.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/cut_parts.hpp"
#include "mesh/vertex_normals.hpp"

namespace condyle::motion {
namespace {

bool all_rest(const std::vector<Eigen::Affine3d>& motions) {
  return std::all_of(motions.begin(), motions.end(),
                     [](const auto& motion) { return motion.matrix().isIdentity(0); });
}

double sd_by_voxels(const Uncertainty& sigma, const BodyImage& image, const Vec3& normal) {
  const double of_grid = sigma.surface_voxels * image.voxel_width_mm(normal);
  return sigma.surface_from.empty() ? of_grid : core::hypotenuse(sigma.surface_mm, of_grid);
}

}  // namespace

Pose displaced_frame(const Displacement& by) {
  Pose X_FG = Pose::Identity();
  X_FG.translation() = by.centre;
  if (const double angle = by.axes.norm(); angle > 0)
    X_FG.linear() = core::rotation_about(by.axes / angle, angle);
  return X_FG;
}

MovableSurface::MovableSurface(const Body& body, const Uncertainty& sigma)
    : vertices_(body.mesh.vertices()),
      directions_(mesh::area_normals(kinematics::uncut_surface(body))),
      sigma_(sigma.is_by_voxels(body) ? 1 : sigma.surface_mm) {
  for (std::size_t v = 0; v < directions_.size(); ++v) {
    if (!(directions_[v].squaredNorm() > 0)) continue;
    const Vec3 normal = directions_[v].normalized();
    directions_.set(
        v, sigma.is_by_voxels(body) ? Vec3(sd_by_voxels(sigma, *body.image, normal) * normal) : normal);
    longest_ = std::max(longest_, directions_[v].norm());
  }
}

MovableSurface::MovableSurface(const Joint& joint, BodyRole role, const Uncertainty& sigma)
    : MovableSurface(role == BodyRole::fixed ? joint.fixed : joint.mobile, sigma) {
  const std::vector<BodyPart>& parts = (role == BodyRole::fixed ? joint.fixed : joint.mobile).parts;
  const auto is_of_implant = [](const BodyPart& part) { return is_implant_mesh(part.name); };
  if (!joint.implant || std::all_of(parts.begin(), parts.end(), is_of_implant)) return;
  for (const BodyPart& part : parts)
    if (is_of_implant(part))
      for (std::size_t v = 0; v < part.vertices; ++v) directions_.set(part.first_vertex + v, Vec3::Zero());
}

std::optional<Points> MovableSurface::moved_by(double standard_deviations) const {
  const double far = sigma_ * standard_deviations;
  if (far == 0) return std::nullopt;
  Points moved(vertices_.size());
  for (std::size_t v = 0; v < moved.size(); ++v) moved.set(v, vertices_[v] + far * directions_[v]);
  return moved;
}

std::optional<Points> MovableSurface::moved_by(double standard_deviations,
                                               const kinematics::DisplacedParts& parts,
                                               std::span<const double> parameters) const {
  auto moved = moved_by(standard_deviations);
  const std::vector<Eigen::Affine3d> motions = parts.motions(parameters);
  if (all_rest(motions)) return moved;
  if (!moved) moved = vertices_;
  parts.groups().move(motions, *moved);
  return moved;
}

std::optional<double> MovableSurface::along_directions(double standard_deviations,
                                                       const kinematics::DisplacedParts& parts,
                                                       std::span<const double> parameters) const {
  return all_rest(parts.motions(parameters)) ? std::optional(sigma_ * standard_deviations) : std::nullopt;
}

}  // namespace condyle::motion
