#include "contact/overlap_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "condyle/error.hpp"
#include "contact/along_rays.hpp"
#include "core/turned.hpp"
#include "mesh/vertex_triangles.hpp"

namespace condyle::contact {
namespace {

/// Faces that meet at a larger angle than this meet at a crease: each side has its own normals there.
const double crease_cosine = std::cos(40 * std::numbers::pi / 180);

Vec3 area_vector(const TriMesh& mesh, std::size_t face) {
  const Vec3 a = mesh.corner(face, 0);
  return (mesh.corner(face, 1) - a).cross(mesh.corner(face, 2) - a) / 2;
}

double angle_at(const TriMesh& mesh, std::size_t face, int corner) {
  const Vec3 p = mesh.corner(face, corner);
  const Vec3 a = mesh.corner(face, (corner + 1) % 3) - p, b = mesh.corner(face, (corner + 2) % 3) - p;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The mean of the normals around a vertex, weighted by angles, of length 1: of all faces, or of those on one face's side of
/// any crease.
Vec3 corner_normal(const TriMesh& mesh, std::span<const Vec3> face_normals,
                   const mesh::VertexTriangles& around, Index vertex, std::optional<Index> side = {}) {
  Vec3 sum = Vec3::Zero();
  for (const Index f : around.of(vertex)) {
    if (side && face_normals[f].dot(face_normals[*side]) < crease_cosine) continue;
    for (int k = 0; k < 3; ++k)
      if (mesh.triangles[f][static_cast<std::size_t>(k)] == vertex)
        sum += angle_at(mesh, f, k) * face_normals[f];
  }
  return unit(sum);
}

/// The face of a cube that a normal points to. Rays of one side after those of another: the two sides of a thin layer lie
/// so near each other that rays in the order of places alone would run both ways in one bundle.
int side_of(const Vec3& normal) {
  Eigen::Index axis;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * static_cast<int>(axis) + (normal[axis] < 0 ? 1 : 0);
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
      ray_target_(target_) {
  if (!(options.reach_mm > 0)) throw UsageError("the reach of rays must be above 0 mm");
  target_normal_ = unit_normals(target_);
  face_normal_ = unit_normals(casting_);
  for (std::size_t t = 0; t < casting_.triangles().size(); ++t) {
    const Vec3 a = casting_.corner(t, 0), b = casting_.corner(t, 1), c = casting_.corner(t, 2);
    face_area_.push_back(area_vector(casting_, t).norm());
    longest_edge_.push_back(std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()}));
  }
  const mesh::TriangleTree order(casting_);
  if (options.rule == FaceRule::face_centre)
    make_centre_rays(order);
  else
    make_corner_rays(order);
  if (!target_is_closed_ || ray_target_.tree().empty()) return;
  Points origins;
  for (std::size_t ray = 0; ray < inward_.size(); ++ray) origins.push_back(inward_[ray].origin);
  origins_inside_.emplace(target_, double{ray_target_.tree().nodes()[0].nearest}, std::move(origins));
}

void OverlapSampler::make_centre_rays(const mesh::TriangleTree& order) {
  for (const Index face : order.mesh_triangles())
    if (face_area_[face] > 0) ray_owner_.push_back(face);
  std::stable_sort(ray_owner_.begin(), ray_owner_.end(),
                   [&](Index a, Index b) { return side_of(face_normal_[a]) < side_of(face_normal_[b]); });
  centre_ray_.assign(casting_.triangles().size(), no_index);
  for (const Index face : ray_owner_) {
    centre_ray_[face] = static_cast<Index>(inward_.size());
    inward_.push_back({(casting_.corner(face, 0) + casting_.corner(face, 1) + casting_.corner(face, 2)) / 3,
                       -face_normal_[face]});
  }
}

void OverlapSampler::make_corner_rays(const mesh::TriangleTree& order) {
  struct Ray {
    Index vertex;
    Vec3 normal;
    std::vector<Index> corners;  ///< three times the face, and which
  };
  const mesh::VertexTriangles around(casting_);
  std::vector<Ray> rays;
  for (const Index vertex : order.mesh_vertices()) {
    const std::size_t first = rays.size();
    for (const Index face : around.of(vertex)) {
      if (face_area_[face] == 0) continue;
      const Vec3 normal = corner_normal(casting_, face_normal_, around, vertex, face);
      // Corners on one side of a crease have the same sums, to the bit.
      std::size_t ray = first;
      while (ray < rays.size() && rays[ray].normal != normal) ++ray;
      if (ray == rays.size()) rays.push_back({vertex, normal, {}});
      for (Index k = 0; k < 3; ++k)
        if (casting_.triangles()[face][k] == vertex) rays[ray].corners.push_back(3 * face + k);
    }
  }
  std::stable_sort(rays.begin(), rays.end(),
                   [](const Ray& a, const Ray& b) { return side_of(a.normal) < side_of(b.normal); });
  corner_ray_.resize(casting_.triangles().size());
  for (const Ray& ray : rays) {
    for (const Index corner : ray.corners) corner_ray_[corner / 3][corner % 3] = Index(ray_owner_.size());
    ray_owner_.push_back(ray.vertex);
    ray_normal_.push_back(ray.normal);
    inward_.push_back({casting_.vertices()[ray.vertex], -ray.normal});
  }
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
  out.met_from_front = out.rim_faces = 0;
  out.oblique_area = 0;
}

void OverlapSampler::sample(const Pose& X_CT, Quadrature quadrature, const LayerThicknesses& thicknesses,
                            Results& out) const {
  clear(out);
  auto scratch = scratch_.take();
  cast_inwards(X_CT, *scratch, out);
  if (options_.rule == FaceRule::face_centre)
    sample_centres(X_CT, thicknesses, *scratch, out);
  else
    sample_faces(X_CT, quadrature, thicknesses, *scratch, out);
  scratch_.put_back(std::move(scratch));
}

void OverlapSampler::cast_inwards(const Pose& X_CT, Scratch& scratch, Results& out) const {
  const Pose X_TC = inverted(X_CT);
  const std::size_t count = inward_.size();
  scratch.ends.clear(count);
  scratch.oblique.assign(count, false);
  const auto take_end = [&](Index ray, std::size_t hit) {
    const auto overlap = overlap_of(inward_[ray].direction, scratch.hits, hit, X_CT);
    if (!overlap) return;
    scratch.oblique[ray] = overlap->oblique;
    if (overlap->oblique && options_.rule == FaceRule::cut_faces) return;
    scratch.ends.set(ray, overlap->end);
    out.met_from_front += overlap->met_from_front;
  };
  if (!origins_inside_ || !origins_inside_->find(X_TC, scratch.inside)) {
    mesh::nearest_hits(ray_target_, X_TC, inward_, options_.reach_mm, scratch.hits);
    out.rays = count;
    for (Index ray = 0; ray < count; ++ray) take_end(ray, ray);
    return;
  }
  const auto& inside = scratch.inside;
  scratch.rays.clear();
  for (const Index ray : inside.point) scratch.rays.push_back(inward_[ray]);
  // The exit through the centre ends near the ray's end.
  mesh::nearest_hits(ray_target_, X_TC, scratch.rays, options_.reach_mm, scratch.hits, inside.triangle);
  out.rays = inside.size();
  for (std::size_t i = 0; i < inside.size(); ++i) take_end(inside.point[i], i);
}

void OverlapSampler::sample_centres(const Pose& X_CT, const LayerThicknesses& thicknesses, Scratch& scratch,
                                    Results& out) const {
  const Pose X_TC = inverted(X_CT);
  // In the order of faces, whatever the order of rays: sums are then those of a reader of the file.
  for (Index face = 0; face < centre_ray_.size(); ++face) {
    const Index ray = centre_ray_[face];
    if (ray == no_index || !scratch.ends.has(ray)) continue;
    const RayEnd& end = scratch.ends[ray];
    if (!(end.depth > 0)) continue;
    if (scratch.oblique[ray]) {
      out.oblique_area += face_area_[face];
      out.oblique_faces.push_back(face);
    }
    const auto& [centre, direction] = inward_[ray];
    OverlapSample sample{face, face_area_[face], end.depth, centre, end.gradient, 0, 0};
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
  mesh::RayHits hits;
  mesh::nearest_hits(ray_target_, inverted(X_CT), inward_, 2 * options_.reach_mm, hits);
  const double least_cosine = options_.rule == FaceRule::cut_faces ? oblique_cosine : 0;
  std::size_t count = 0;
  for (std::size_t ray = 0; ray < ray_owner_.size(); ++ray) {
    if (!hits.is_hit(ray) || hits.distance[ray] <= options_.reach_mm) continue;
    const Vec3 direction =
        options_.rule == FaceRule::face_centre ? -face_normal_[ray_owner_[ray]] : -ray_normal_[ray];
    if (direction.dot(core::turned(X_CT, target_normal_[hits.triangle[ray]])) > least_cosine) ++count;
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
  const mesh::VertexTriangles around(from);
  const mesh::TriangleTree order(from);
  std::vector<Index> owner;
  std::vector<mesh::Ray> rays;
  for (const Index vertex : order.mesh_vertices()) {
    const Vec3 normal = corner_normal(from, face_normals, around, vertex);
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
