#include "condyle/normal_depth.hpp"

#include <algorithm>

#include "condyle/error.hpp"
#include "contact/moved_vertices.hpp"
#include "contact/overlap_sampler.hpp"
#include "core/coordinate_range.hpp"

namespace condyle::contact {

NormalDepth::NormalDepth(Mesh casting, Mesh target, NormalDepthOptions options)
    : sampler_(std::make_unique<OverlapSampler>(std::move(casting), std::move(target), options)) {}
NormalDepth::~NormalDepth() = default;
NormalDepth::NormalDepth(NormalDepth&&) noexcept = default;
NormalDepth& NormalDepth::operator=(NormalDepth&&) noexcept = default;

void NormalDepth::update_casting(PointsView vertices) {
  sampler_->update_casting(moved_vertices(casting(), vertices).mesh);
}
void NormalDepth::update_casting(std::span<const Index> moved, PointsView positions) {
  const MovedVertices now = moved_vertices(casting(), moved, positions);
  sampler_->update_casting(now.mesh, now.is_moved);
}
void NormalDepth::update_target(PointsView vertices) {
  sampler_->update_target(moved_vertices(target(), vertices).mesh);
}
void NormalDepth::update_target(std::span<const Index> moved, PointsView positions) {
  const MovedVertices now = moved_vertices(target(), moved, positions);
  sampler_->update_target(now.mesh, now.is_moved);
}

const Mesh& NormalDepth::casting() const noexcept {
  return sampler_->casting();
}
const Mesh& NormalDepth::target() const noexcept {
  return sampler_->target();
}
const NormalDepthOptions& NormalDepth::options() const noexcept {
  return sampler_->options();
}

SurfaceContact NormalDepth::at(const Pose& X_CT) const {
  SurfaceContact out;
  at(X_CT, out);
  return out;
}

void NormalDepth::at(const Pose& X_CT, SurfaceContact& out) const {
  core::require_rotation(X_CT);
  auto found = sampler_->found_pool().take();
  sampler_->sample(X_CT, Quadrature::of_degree_2, {}, *found);
  contact::add_up(*sampler_, *found, std::nullopt, out);
  sampler_->found_pool().put_back(std::move(found));
}

std::size_t NormalDepth::cut_off_by_reach(const Pose& X_CT) const {
  core::require_rotation(X_CT);
  return sampler_->cut_off_by_reach(X_CT);
}

ContactTotals totals_of(std::span<const FaceContact> faces, const Mesh& casting, FaceRule rule) {
  ContactTotals out;
  double overlap = 0, load = 0, sum_of_depths = 0, sum_of_pressures = 0;
  Vec3 overlap_moment = Vec3::Zero(), load_moment = Vec3::Zero();
  for (const FaceContact& face : faces) {
    ++out.triangles;
    out.area_mm2 += face.area_mm2;
    out.max_depth_mm = std::max(out.max_depth_mm, face.max_depth_mm);
    out.max_pressure_mpa = std::max(out.max_pressure_mpa, face.max_pressure_mpa);
    overlap += face.overlap_mm3;
    overlap_moment += face.overlap_moment;
    load += face.load_n;
    load_moment += face.load_moment;
    sum_of_depths += face.mean_depth_mm();
    sum_of_pressures += face.mean_pressure_mpa();
    const Vec3 a = casting.corner(face.face, 0);
    const Vec3 n = (casting.corner(face.face, 1) - a).cross(casting.corner(face.face, 2) - a).normalized();
    out.force_n -= face.load_n * n;
    out.moment_nmm -= face.load_moment.cross(n);
  }
  if (out.triangles == 0) return out;
  const bool by_face = rule == FaceRule::face_centre;
  const double count = by_face ? static_cast<double>(out.triangles) : out.area_mm2;
  out.mean_depth_mm = (by_face ? sum_of_depths : overlap) / count;
  out.mean_pressure_mpa = (by_face ? sum_of_pressures : load) / count;
  out.centre_of_depth = overlap_moment / overlap;
  if (load > 0) out.centre_of_pressure = load_moment / load;
  return out;
}

std::vector<FaceContact> faces_within(std::span<const FaceContact> faces, const Mesh& casting,
                                      std::span<const HalfSpace> region) {
  std::vector<FaceContact> within;
  for (const FaceContact& face : faces) {
    const Vec3 centre =
        (casting.corner(face.face, 0) + casting.corner(face.face, 1) + casting.corner(face.face, 2)) / 3;
    if (std::all_of(region.begin(), region.end(),
                    [&](const HalfSpace& half) { return half.normal.dot(centre) > half.offset_mm; }))
      within.push_back(face);
  }
  return within;
}

std::vector<double> thickness_to(const Mesh& layer, const Mesh& behind, double reach_mm) {
  if (!(reach_mm > 0)) throw UsageError("the reach of rays must be above 0 mm");
  return contact::distances_along_normals(layer, behind, reach_mm);
}

}  // namespace condyle::contact
