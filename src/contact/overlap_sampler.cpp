#include "contact/overlap_sampler.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "condyle/error.hpp"
#include "contact/along_rays.hpp"
#include "core/turned.hpp"
#include "mesh/vertex_triangles.hpp"

namespace condyle::contact {
namespace {

/// The mean of the normals of the faces around a vertex, weighted by angles, of length 1.
Vec3 vertex_normal(const TriMesh& mesh, std::span<const Vec3> face_normals, std::span<const Index> around,
                   Index vertex) {
  Vec3 sum = Vec3::Zero();
  for (const Index f : around)
    for (std::size_t k = 0; k < 3; ++k)
      if (mesh.triangles[f][k] == vertex)
        sum += angle_at({mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)}, k) * face_normals[f];
  return unit(sum);
}

std::vector<Vec3> unit_normals(const TriMesh& mesh) {
  std::vector<Vec3> normals;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) normals.push_back(unit(area_vector(mesh, f)));
  return normals;
}

}  // namespace

OverlapSampler::OverlapSampler(Mesh casting, Mesh target, NormalDepthOptions options)
    : casting_(std::move(casting)),
      target_(std::move(target)),
      options_(options),
      target_is_closed_(target_.is_closed()),
      ray_target_(target_),
      target_normal_(unit_normals(target_)),
      rays_(casting_, options.rule) {
  if (!(options.reach_mm > 0)) throw UsageError("the reach of rays must be above 0 mm");
  if (target_is_closed_ && !ray_target_.tree().empty())
    origins_inside_.emplace(target_, nearest_of_target(), ray_origins());
}

double OverlapSampler::nearest_of_target() const {
  return double{ray_target_.tree().nodes()[0].nearest};
}

Points OverlapSampler::ray_origins() const {
  Points origins;
  origins.reserve(rays_.size());
  for (const mesh::Ray& ray : rays_.inward()) origins.push_back(ray.origin);
  return origins;
}

void OverlapSampler::require_whole() const {
  if (!is_whole_) throw UsageError("memory ran out in an update of this contact: it has to be made anew");
}

void OverlapSampler::update_casting(const Mesh& casting, std::span<const char> is_moved) {
  require_whole();
  is_whole_ = false;
  casting_ = casting;
  const bool are_same_rays = rays_.update(casting_, is_moved);
  if (origins_inside_) origins_inside_->update_points(ray_origins(), are_same_rays);
  is_whole_ = true;
}

void OverlapSampler::update_target(const Mesh& target, std::span<const char> is_moved) {
  require_whole();
  is_whole_ = false;
  target_ = target;
  ray_target_.update(target_, is_moved);
  const auto& triangles = target_.triangles();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (is_moved.empty() || is_moved[a] || is_moved[b] || is_moved[c])
      target_normal_[t] = unit(area_vector(target_, t));
  }
  if (origins_inside_) origins_inside_->update_surface(target_, nearest_of_target());
  is_whole_ = true;
}

std::optional<OverlapSampler::Overlap> OverlapSampler::overlap_of(const Vec3& direction_C,
                                                                  const mesh::RayHits& hits, std::size_t ray,
                                                                  const Pose& X_CT) const {
  if (!hits.is_hit(ray)) return std::nullopt;
  const Index triangle = hits.triangle[ray];
  const Vec3 normal = core::turned(X_CT, target_normal_[triangle]);
  const bool met_from_front = direction_C.dot(normal) < 0;
  if (met_from_front && target_is_closed_) return std::nullopt;
  return Overlap{{hits.distance[ray], triangle, depth_gradient(normal, direction_C)},
                 met_from_front,
                 std::abs(direction_C.dot(normal)) < oblique_cosine};
}

double OverlapSampler::target_thickness(const RayEnd& end, const Vec3& origin_C, const Vec3& direction_C,
                                        const Pose& X_TC, std::span<const double> of_vertices) const {
  const Vec3 met = X_TC * Vec3(origin_C + end.depth * direction_C);
  const auto& corners = target_.triangles()[end.triangle];
  const Vec3 a = target_.corner(end.triangle, 0), b = target_.corner(end.triangle, 1),
             c = target_.corner(end.triangle, 2);
  const Vec3 n = (b - a).cross(c - a);
  const double squared = n.squaredNorm();
  const double in_b = std::clamp((met - a).cross(c - a).dot(n) / squared, 0.0, 1.0);
  const double in_c = std::clamp((b - a).cross(met - a).dot(n) / squared, 0.0, 1.0 - in_b);
  return (1 - in_b - in_c) * of_vertices[corners[0]] + in_b * of_vertices[corners[1]] +
         in_c * of_vertices[corners[2]];
}

void OverlapSampler::clear(Results& out) {
  out.samples.clear();
  out.corners.clear();
  out.borders.clear();
  out.oblique_faces.clear();
  out.run_on.clear();
  out.met_from_front = out.rim_faces = 0;
  out.oblique_area = 0;
}

void OverlapSampler::sample(const Pose& X_CT, Quadrature quadrature, const LayerThicknesses& thicknesses,
                            Results& out) const {
  require_whole();
  clear(out);
  auto scratch = scratch_.take();
  cast_inwards(X_CT, *scratch, out);
  if (options_.rule == FaceRule::face_centre)
    sample_centres(X_CT, thicknesses, *scratch, out);
  else
    sample_faces(X_CT, quadrature, thicknesses, *scratch, out);
  std::swap(out.ends, scratch->ends);
  scratch_.put_back(std::move(scratch));
}

void OverlapSampler::cast_inwards(const Pose& X_CT, Scratch& scratch, Results& out) const {
  const Pose X_TC = inverted(X_CT);
  const std::size_t count = rays_.size();
  scratch.ends.clear(count);
  scratch.oblique.assign(count, false);
  const auto take_end = [&](Index ray, std::size_t hit) {
    if (!rays_.is_used(ray)) return;
    const auto overlap = overlap_of(rays_.inward()[ray].direction, scratch.hits, hit, X_CT);
    if (!overlap) return;
    scratch.oblique[ray] = overlap->oblique;
    if (overlap->oblique && options_.rule == FaceRule::cut_faces) return;
    scratch.ends.set(ray, overlap->end);
    out.met_from_front += overlap->met_from_front;
  };
  if (!origins_inside_ || !origins_inside_->find(X_TC, scratch.inside)) {
    mesh::nearest_hits(ray_target_, X_TC, rays_.inward(), options_.reach_mm, scratch.hits);
    out.rays = count;
    for (Index ray = 0; ray < count; ++ray) take_end(ray, ray);
    return;
  }
  const auto& inside = scratch.inside;
  scratch.rays.clear();
  for (const Index ray : inside.point) scratch.rays.push_back(rays_.inward()[ray]);
  // The exit through the centre ends near the ray's end.
  mesh::nearest_hits(ray_target_, X_TC, scratch.rays, options_.reach_mm, scratch.hits, inside.triangle);
  out.rays = inside.size();
  for (std::size_t i = 0; i < inside.size(); ++i) take_end(inside.point[i], i);
}

void OverlapSampler::sample_centres(const Pose& X_CT, const LayerThicknesses& thicknesses, Scratch& scratch,
                                    Results& out) const {
  const Pose X_TC = inverted(X_CT);
  // In the order of faces, whatever the order of rays: sums are then those of a reader of the file.
  for (Index face = 0; face < rays_.faces(); ++face) {
    const Index ray = rays_.of_centre(face);
    if (ray == no_index || !scratch.ends.has(ray)) continue;
    const RayEnd& end = scratch.ends[ray];
    if (!(end.depth > 0)) continue;
    if (scratch.oblique[ray]) {
      out.oblique_area += rays_.face_area(face);
      out.oblique_faces.push_back(face);
    }
    const auto& [centre, direction] = rays_.inward()[ray];
    OverlapSample sample{face, rays_.face_area(face),       end.depth,   centre, end.gradient, 0,
                         0,    {1.0 / 3, 1.0 / 3, 1.0 / 3}, end.triangle};
    if (!thicknesses.casting.empty()) {
      const auto& [a, b, c] = casting_.triangles()[face];
      sample.casting_thickness =
          (thicknesses.casting[a] + thicknesses.casting[b] + thicknesses.casting[c]) / 3;
    }
    if (!thicknesses.target.empty())
      sample.target_thickness = target_thickness(end, centre, direction, X_TC, thicknesses.target);
    out.samples.push_back(sample);
  }
}

std::size_t OverlapSampler::cut_off_by_reach(const Pose& X_CT) const {
  require_whole();
  mesh::RayHits hits;
  mesh::nearest_hits(ray_target_, inverted(X_CT), rays_.inward(), 2 * options_.reach_mm, hits);
  const double least_cosine = options_.rule == FaceRule::cut_faces ? oblique_cosine : 0;
  std::size_t count = 0;
  for (std::size_t ray = 0; ray < rays_.size(); ++ray) {
    if (!rays_.is_used(ray) || !hits.is_hit(ray) || hits.distance[ray] <= options_.reach_mm) continue;
    if (rays_.inward()[ray].direction.dot(core::turned(X_CT, target_normal_[hits.triangle[ray]])) >
        least_cosine)
      ++count;
  }
  return count;
}

void add_up(const OverlapSampler& sampler, const OverlapSampler::Results& found,
            const std::optional<OverlapPressures>& pressures, SurfaceContact& out) {
  out.faces.clear();
  out.met_from_front = found.met_from_front;
  out.rim_faces = found.rim_faces;
  out.oblique_area_mm2 = found.oblique_area;
  for (std::size_t i = 0; i < found.samples.size(); ++i) {
    const OverlapSample& sample = found.samples[i];
    if (out.faces.empty() || out.faces.back().face != sample.face)
      out.faces.push_back({sample.face, 0, 0, 0, Vec3::Zero()});
    FaceContact& face = out.faces.back();
    const double overlap = sample.area * sample.depth;
    face.area_mm2 += sample.area;
    face.max_depth_mm = std::max(face.max_depth_mm, sample.depth);
    face.overlap_mm3 += overlap;
    face.overlap_moment += overlap * sample.point;
    if (!pressures) continue;
    const double load = sample.area * pressures->of_samples[i];
    face.max_pressure_mpa = std::max(face.max_pressure_mpa, pressures->of_samples[i]);
    face.load_n += load;
    face.load_moment += load * sample.point;
  }
  auto face = out.faces.begin();
  for (std::size_t i = 0; i < found.corners.size(); ++i) {
    const OverlapCorner& corner = found.corners[i];
    while (face != out.faces.end() && face->face < corner.face) ++face;
    if (face == out.faces.end()) break;
    if (face->face != corner.face) continue;  // of a part without area
    face->max_depth_mm = std::max(face->max_depth_mm, corner.depth);
    if (pressures) face->max_pressure_mpa = std::max(face->max_pressure_mpa, pressures->of_corners[i]);
  }
  // The part that a cut leaves of a face may be no more than rounding.
  std::erase_if(out.faces, [](const FaceContact& of) { return !(of.overlap_mm3 > 0); });
  out.totals = totals_of(out.faces, sampler.casting(), sampler.options().rule);
  const auto is_peak = [&](const FaceContact& of) {
    return of.max_depth_mm == out.totals.max_depth_mm ||
           (pressures && of.max_pressure_mpa == out.totals.max_pressure_mpa);
  };
  out.peak_is_oblique = std::any_of(out.faces.begin(), out.faces.end(), [&](const FaceContact& of) {
    return is_peak(of) && std::binary_search(found.oblique_faces.begin(), found.oblique_faces.end(), of.face);
  });
}

std::vector<double> distances_along_normals(const Mesh& from, const Mesh& to, double reach) {
  const auto face_normals = unit_normals(from);
  const mesh::VertexTriangles& around = mesh::triangles_at_vertices_of(from);
  std::vector<Index> owner;
  std::vector<mesh::Ray> rays;
  for (const Index vertex : mesh::tree_of(from)->mesh_vertices()) {
    const Vec3 normal = vertex_normal(from, face_normals, around.of(vertex), vertex);
    if (normal.isZero()) continue;
    owner.push_back(vertex);
    rays.push_back({from.vertices()[vertex], -normal});
  }
  mesh::RayHits hits;
  mesh::nearest_hits(mesh::RayTarget(to), Pose::Identity(), rays, reach, hits);
  std::vector<double> distances(from.vertices().size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t ray = 0; ray < owner.size(); ++ray)
    if (hits.is_hit(ray)) distances[owner[ray]] = hits.distance[ray];
  return distances;
}

}  // namespace condyle::contact
