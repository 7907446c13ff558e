#include "condyle/label_surface.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "condyle/error.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/label_surface/bone_components.hpp"
#include "mesh/label_surface/contour.hpp"
#include "mesh/label_surface/mask_checks.hpp"
#include "mesh/label_surface/repeated_slices.hpp"
#include "mesh/label_surface/simplify.hpp"
#include "mesh/label_surface/smoothed_field.hpp"
#include "mesh/label_surface/voxel_pieces.hpp"

namespace condyle {
namespace {

using mesh::Contour;

/// Fewer show the shape of no bone.
constexpr std::size_t fewest_triangles = 100;

/// Counts the steps of the work that are done.
class Steps {
 public:
  explicit Steps(const Control& control) : control_(control) {}

  bool stopped() const { return control_.stop.stop_requested(); }
  /// False if the work is to stop.
  bool next() {
    if (control_.progress) control_.progress("steps of the surface", ++done_, count);
    return !stopped();
  }

 private:
  static constexpr std::size_t count = 4;  ///< voxels, field, contour, mesh
  const Control& control_;
  std::size_t done_ = 0;
};

void find_pieces(const VoxelMask& mask, const LabelSurfaceOptions& options, mesh::VoxelBox& box,
                 LabelSurface& surface) {
  const double voxel = std::abs(mask.image.X_WI.linear().determinant());
  const auto pieces = mesh::keep_pieces(box, options.all_pieces);
  if (pieces.empty()) throw MeshError("the label has no voxels");
  for (const std::int64_t voxels : pieces) {
    const bool kept = options.all_pieces || surface.pieces.empty();
    surface.pieces.push_back({voxels, static_cast<double>(voxels) * voxel, kept});
  }
  const mesh::Cavities cavities = mesh::find_cavities(box, !options.keep_cavities);
  surface.cavities = {cavities.count, cavities.voxels, static_cast<double>(cavities.voxels) * voxel};
}

/// X p in one order, whatever the instruction set: core/ordered_sums.hpp.
Vec3 placed(const Eigen::Affine3d& X, const Vec3& p) {
  const auto row = [&](int i) { return ((X(i, 0) * p.x() + X(i, 1) * p.y()) + X(i, 2) * p.z()) + X(i, 3); };
  return {row(0), row(1), row(2)};
}

/// Into the world; a mirrored grid turns triangles inside out.
void place_in_world(const Eigen::Affine3d& X_WI, TriMesh& mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.vertices.set(v, placed(X_WI, mesh.vertices[v]));
  if (X_WI.linear().determinant() < 0) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  }
}

std::vector<CapPlane> caps_of(const VoxelGrid& image, const TriMesh& mesh,
                              const std::vector<std::uint8_t>& cap) {
  std::array<CapPlane, 6> sides;
  for (std::size_t t = 0; t < cap.size(); ++t)
    if (cap[t] != 0) sides[cap[t] - 1u].triangles.push_back(static_cast<Index>(t));
  std::vector<CapPlane> found;
  const Eigen::Matrix3d to_normal = image.X_WI.linear().inverse().transpose();
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      CapPlane& side = sides[static_cast<std::size_t>(2 * axis + (high ? 1 : 0))];
      if (side.triangles.empty()) continue;
      side.axis = axis;
      side.high = high;
      side.normal = (high ? 1.0 : -1.0) * to_normal.col(axis).normalized();
      Vec3 on_plane = Vec3::Zero();
      on_plane[axis] = high ? static_cast<double>(image.size[static_cast<std::size_t>(axis)]) - 0.5 : -0.5;
      side.offset = side.normal.dot(image.X_WI * on_plane);
      mesh::CompensatedSum area;
      for (const Index t : side.triangles) {
        const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
        area.add((b - a).cross(c - a).norm() / 2);
      }
      side.area = area.value();
      found.push_back(std::move(side));
    }
  }
  return found;
}

}  // namespace

LabelSurface surface_of(const VoxelMask& mask, const LabelSurfaceOptions& options) {
  return *surface_of(mask, options, {});
}

std::optional<LabelSurface> surface_of(const VoxelMask& mask, const LabelSurfaceOptions& options,
                                       const Control& control) {
  mesh::check_mask(mask);
  if (!(options.sigma_voxels >= 0 && options.sigma_voxels <= 4))
    throw UsageError("smoothing of a label: the standard deviation is 0 to 4 voxels");
  if (options.triangles && *options.triangles < fewest_triangles)
    throw UsageError("simplification of a label: " + std::to_string(fewest_triangles) +
                     " triangles are the fewest");
  Steps steps(control);
  if (steps.stopped()) return std::nullopt;

  LabelSurface surface;
  mesh::VoxelBox box{mask.size, mask.inside};
  find_pieces(mask, options, box, surface);
  if (!steps.next()) return std::nullopt;

  auto contour = [&]() -> std::optional<Contour> {
    const mesh::SampledField field =
        mesh::smoothed_field(box, {mask.first, mask.image.size}, options.sigma_voxels);
    box = {};
    if (!steps.next()) return std::nullopt;
    return mesh::contour_of(field, control.stop);
  }();
  if (!contour || !steps.next()) return std::nullopt;

  // Where parts of a bone touch over a few voxels smoothing parts them: all but specks are the bone.
  surface.dropped_components = mesh::drop_components(
      *contour, {options.all_pieces, options.keep_cavities, 1.0 / static_cast<double>(mesh::speck_share)});
  if (contour->mesh.triangles.empty())
    throw MeshError("smoothing leaves none of the label's " + std::to_string(surface.pieces.front().voxels) +
                    (surface.pieces.front().voxels == 1 ? " voxel" : " voxels"));
  place_in_world(mask.image.X_WI, contour->mesh);
  if (options.triangles && contour->mesh.triangles.size() > *options.triangles) {
    auto made = mesh::simplified(*contour, *options.triangles, control.stop);
    if (!made) return std::nullopt;
    surface.simplification = {contour->mesh.triangles.size(), made->largest_error};
    contour = std::move(made->surface);
  }
  surface.caps = caps_of(mask.image, contour->mesh, contour->cap);
  surface.mesh = std::move(contour->mesh);
  const Eigen::Matrix3d& steps_along_axes = mask.image.X_WI.linear();
  surface.spacing = steps_along_axes.colwise().norm();
  for (std::size_t axis = 0; axis < 3; ++axis)
    surface.slices_in_one[static_cast<Eigen::Index>(axis)] = mesh::slices_in_one(mask, axis);
  const Eigen::Matrix3d drawn_in = steps_along_axes * surface.slices_in_one.asDiagonal();
  surface.digitisation = Eigen::JacobiSVD<Eigen::Matrix3d>(drawn_in).singularValues()[0] / 2;
  if (!steps.next()) return std::nullopt;
  return surface;
}

}  // namespace condyle
