#include "contact/overlap_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "condyle/error.hpp"
#include "mesh/vertex_triangles.hpp"

namespace condyle::contact {
namespace {

/// Depths further from each other than this many lengths of the face's longest edge are of different parts of the target:
/// across its rim, or on another condyle. Faces then meet at more than 60 degrees, and are no thin layer.
constexpr double steepest_linear = 2;

/// Centres of the 16 triangles that three parallels to each edge cut a triangle into.
constexpr std::size_t rim_parts = 16;
std::array<std::array<double, 3>, rim_parts> rim_centres() {
  std::array<std::array<double, 3>, rim_parts> centres;
  std::size_t count = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; i + j < 4; ++j) {
      for (const double third : {1.0 / 3, 2.0 / 3}) {
        if (third > 0.5 && i + j == 3) continue;
        const double a = (i + third) / 4, b = (j + third) / 4;
        centres[count++] = {a, b, 1 - a - b};
      }
    }
  }
  return centres;
}

/// A place in a triangle and its share of the area.
struct Node {
  std::array<double, 3> at;
  double weight;
};

template <class Value>
Value mixed(const std::array<double, 3>& w, const Value& a, const Value& b, const Value& c) {
  return w[0] * a + w[1] * b + w[2] * c;
}

/// Middles of the edges: exact for quadratic functions.
constexpr std::array<Node, 3> nodes_of_degree_2 = {
    {{{0.5, 0.5, 0}, 1.0 / 3}, {{0, 0.5, 0.5}, 1.0 / 3}, {{0.5, 0, 0.5}, 1.0 / 3}}};

/// Radon's seven nodes: exact to degree 5.
std::array<Node, 7> nodes_of_degree_5() {
  const double root = std::sqrt(15.0);
  std::array<Node, 7> nodes;
  nodes[0] = {{1.0 / 3, 1.0 / 3, 1.0 / 3}, 9.0 / 40};
  std::size_t count = 1;
  for (const double sign : {-1.0, 1.0}) {
    const double a = (6 + sign * root) / 21, b = 1 - 2 * a, weight = (155 + sign * root) / 1200;
    for (const auto& at : {std::array{b, a, a}, std::array{a, b, a}, std::array{a, a, b}})
      nodes[count++] = {at, weight};
  }
  return nodes;
}

/// Faces that meet at a larger angle than this meet at a crease: each side has its own normals there.
const double crease_cosine = std::cos(40 * std::numbers::pi / 180);

Vec3 area_vector(const TriMesh& mesh, std::size_t face) {
  const Vec3 a = mesh.corner(face, 0);
  return (mesh.corner(face, 1) - a).cross(mesh.corner(face, 2) - a) / 2;
}
Vec3 unit(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
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

// The ray from o along u meets the plane with normal m through a at d = (a - o).m / (u.m): translated by s, d grows by
// s.m / (u.m). Rays outwards have the opposite direction and the opposite depth, so one formula serves both.
Vec3 depth_gradient(const Vec3& normal, const Vec3& direction) {
  return normal / direction.dot(normal);
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
  const Vec3 normal = X_CT.linear() * target_normal_[triangle];
  const bool met_from_front = direction_C.dot(normal) < 0;
  if (met_from_front && target_is_closed_) return std::nullopt;
  return Overlap{{hits.distance[ray], triangle, depth_gradient(normal, direction_C)}, met_from_front};
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

void OverlapSampler::sample(const Pose& X_CT, Quadrature quadrature, const LayerThicknesses& thicknesses,
                            Found& out) const {
  out.samples.clear();
  out.corners.clear();
  out.met_from_front = out.rim_faces = 0;
  auto scratch = scratch_.take();
  cast_inwards(X_CT, *scratch, out);
  if (options_.rule == FaceRule::face_centre)
    sample_centres(X_CT, thicknesses, *scratch, out);
  else
    sample_parts(X_CT, quadrature, thicknesses, *scratch, out);
  scratch_.put_back(std::move(scratch));
}

void OverlapSampler::cast_inwards(const Pose& X_CT, Scratch& scratch, Found& out) const {
  const Pose X_TC = inverted(X_CT);
  const std::size_t count = inward_.size();
  scratch.ends.clear(count);
  const auto take_end = [&](Index ray, std::size_t hit) {
    const auto overlap = overlap_of(inward_[ray].direction, scratch.hits, hit, X_CT);
    if (!overlap) return;
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
  // The way out through the centre ends near where the ray does.
  mesh::nearest_hits(ray_target_, X_TC, scratch.rays, options_.reach_mm, scratch.hits, inside.triangle);
  out.rays = inside.size();
  for (std::size_t i = 0; i < inside.size(); ++i) take_end(inside.point[i], i);
}

void OverlapSampler::sample_centres(const Pose& X_CT, const LayerThicknesses& thicknesses, Scratch& scratch,
                                    Found& out) const {
  const Pose X_TC = inverted(X_CT);
  // In the order of faces, whatever the order of rays: sums are then those of a reader of the file.
  for (Index face = 0; face < centre_ray_.size(); ++face) {
    const Index ray = centre_ray_[face];
    if (ray == no_index || !scratch.ends.has(ray)) continue;
    const RayEnd& end = scratch.ends[ray];
    if (!(end.depth > 0)) continue;
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

void OverlapSampler::sample_parts(const Pose& X_CT, Quadrature quadrature,
                                  const LayerThicknesses& thicknesses, Scratch& scratch, Found& out) const {
  const Pose X_TC = inverted(X_CT);
  cast_outwards(X_CT, scratch, out);
  scratch.rim.clear();
  for (const Index face : scratch.active)
    if (is_rim(face, scratch.ends)) scratch.rim.push_back(face);
  cast_rim(X_CT, scratch, out);
  std::size_t rim = 0;
  for (const Index face : scratch.active) {
    if (rim == scratch.rim.size() || face != scratch.rim[rim])
      sample_cut_face(face, quadrature, thicknesses, X_TC, scratch.ends, out);
    else
      sample_rim_face(face, rim_parts * rim++, thicknesses, X_CT, X_TC, scratch, out);
  }
}

void OverlapSampler::cast_outwards(const Pose& X_CT, Scratch& scratch, Found& out) const {
  auto& ends = scratch.ends;
  scratch.active.clear();
  scratch.rays.clear();
  scratch.owner.clear();
  scratch.outwards.assign(ends.rays(), 0);
  for (Index face = 0; face < corner_ray_.size(); ++face) {
    const auto& [a, b, c] = corner_ray_[face];
    if (face_area_[face] == 0 || !(ends.has(a) || ends.has(b) || ends.has(c))) continue;
    scratch.active.push_back(face);
    for (const Index ray : corner_ray_[face]) scratch.outwards[ray] = !ends.has(ray);
  }
  for (Index ray = 0; ray < ends.rays(); ++ray) {
    if (!scratch.outwards[ray]) continue;
    scratch.owner.push_back(ray);
    scratch.rays.push_back({casting_.vertices()[ray_owner_[ray]], ray_normal_[ray]});
  }
  mesh::nearest_hits(ray_target_, inverted(X_CT), scratch.rays, options_.reach_mm, scratch.hits);
  out.rays += scratch.rays.size();
  for (std::size_t i = 0; i < scratch.owner.size(); ++i) {
    const Index ray = scratch.owner[i];
    if (!scratch.hits.is_hit(i)) continue;
    const Index triangle = scratch.hits.triangle[i];
    ends.set(ray, {-scratch.hits.distance[i], triangle,
                   depth_gradient(X_CT.linear() * target_normal_[triangle], -ray_normal_[ray])});
  }
}

bool OverlapSampler::is_rim(Index face, const RayEnds& ends) const {
  const auto& [a, b, c] = corner_ray_[face];
  if (!(ends.has(a) && ends.has(b) && ends.has(c))) return true;
  const auto [least, most] = std::minmax({ends[a].depth, ends[b].depth, ends[c].depth});
  return most - least > steepest_linear * longest_edge_[face];
}

void OverlapSampler::cast_rim(const Pose& X_CT, Scratch& scratch, Found& out) const {
  static const auto centres = rim_centres();
  scratch.rays.clear();
  for (const Index face : scratch.rim) {
    const auto& corners = casting_.triangles()[face];
    const auto& rays = corner_ray_[face];
    for (const auto& w : centres)
      scratch.rays.push_back(
          {mixed(w, casting_.vertices()[corners[0]], casting_.vertices()[corners[1]],
                 casting_.vertices()[corners[2]]),
           unit(-mixed(w, ray_normal_[rays[0]], ray_normal_[rays[1]], ray_normal_[rays[2]]))});
  }
  mesh::nearest_hits(ray_target_, inverted(X_CT), scratch.rays, options_.reach_mm, scratch.hits);
  out.rays += scratch.rays.size();
  out.rim_faces = scratch.rim.size();
}

void OverlapSampler::sample_cut_face(Index face, Quadrature quadrature, const LayerThicknesses& thicknesses,
                                     const Pose& X_TC, const RayEnds& ends, Found& out) const {
  static const auto of_degree_5 = nodes_of_degree_5();
  const std::span<const Node> nodes = quadrature == Quadrature::of_degree_2
                                          ? std::span<const Node>(nodes_of_degree_2)
                                          : std::span<const Node>(of_degree_5);
  const bool with_thickness = !thicknesses.casting.empty() || !thicknesses.target.empty();
  const auto& rays = corner_ray_[face];
  std::array<Vec3, 3> p, gradient;
  std::array<double, 3> depth{}, of_casting{}, of_target{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Index v = casting_.triangles()[face][k];
    const RayEnd& end = ends[rays[k]];
    p[k] = casting_.vertices()[v];
    depth[k] = end.depth;
    gradient[k] = end.gradient;
    if (!thicknesses.casting.empty()) of_casting[k] = thicknesses.casting[v];
    if (!thicknesses.target.empty())
      of_target[k] = target_thickness(end, p[k], -ray_normal_[rays[k]], X_TC, thicknesses.target);
  }

  // The part with a depth above 0: a triangle, or what a corner leaves of one.
  std::array<std::array<double, 3>, 4> part;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    std::array<double, 3> corner{};
    if (depth[k] > 0) corner[k] = 1, part[count++] = corner;
    if ((depth[k] > 0) == (depth[next] > 0)) continue;
    const double t = depth[k] / (depth[k] - depth[next]);
    corner = {};
    corner[k] = 1 - t, corner[next] = t;
    part[count++] = corner;
  }
  if (count == 0) return;

  const auto of = [](const std::array<double, 3>& w, const auto& values) {
    return mixed(w, values[0], values[1], values[2]);
  };
  // 0 on the cut, but for rounding.
  const auto depth_at = [&](const std::array<double, 3>& w) { return std::max(0.0, of(w, depth)); };
  if (with_thickness) {
    for (std::size_t k = 0; k < count; ++k)
      out.corners.push_back({face, depth_at(part[k]), of(part[k], of_casting), of(part[k], of_target)});
  } else {
    out.corners.push_back({face, std::max({depth[0], depth[1], depth[2]}), 0, 0});
  }
  for (std::size_t k = 2; k < count; ++k) {
    // Areas of barycentric triangles are shares of the face's.
    const auto &a = part[0], &b = part[k - 1], &c = part[k];
    const double share = std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    if (!(share > 0)) continue;
    for (const Node& node : nodes) {
      std::array<double, 3> w;
      for (std::size_t i = 0; i < 3; ++i) w[i] = node.at[0] * a[i] + node.at[1] * b[i] + node.at[2] * c[i];
      OverlapSample& sample = out.samples.emplace_back();
      sample = {face, share * face_area_[face] * node.weight, depth_at(w), of(w, p), of(w, gradient), 0, 0};
      if (with_thickness)
        sample.casting_thickness = of(w, of_casting), sample.target_thickness = of(w, of_target);
    }
  }
}

void OverlapSampler::sample_rim_face(Index face, std::size_t first_ray, const LayerThicknesses& thicknesses,
                                     const Pose& X_CT, const Pose& X_TC, const Scratch& scratch,
                                     Found& out) const {
  static const auto centres = rim_centres();
  const auto& [a, b, c] = casting_.triangles()[face];
  for (std::size_t part = 0; part < rim_parts; ++part) {
    const auto& [point, direction] = scratch.rays[first_ray + part];
    const auto overlap = overlap_of(direction, scratch.hits, first_ray + part, X_CT);
    if (!overlap || !(overlap->end.depth > 0)) continue;
    const RayEnd& end = overlap->end;
    OverlapSample sample{face, face_area_[face] / rim_parts, end.depth, point, end.gradient, 0, 0};
    if (!thicknesses.casting.empty())
      sample.casting_thickness =
          mixed(centres[part], thicknesses.casting[a], thicknesses.casting[b], thicknesses.casting[c]);
    if (!thicknesses.target.empty())
      sample.target_thickness = target_thickness(end, point, direction, X_TC, thicknesses.target);
    out.samples.push_back(sample);
  }
}

std::size_t OverlapSampler::cut_off_by_reach(const Pose& X_CT) const {
  mesh::RayHits hits;
  mesh::nearest_hits(ray_target_, inverted(X_CT), inward_, 2 * options_.reach_mm, hits);
  std::size_t count = 0;
  for (std::size_t ray = 0; ray < ray_owner_.size(); ++ray) {
    if (!hits.is_hit(ray) || hits.distance[ray] <= options_.reach_mm) continue;
    const Vec3 direction =
        options_.rule == FaceRule::face_centre ? -face_normal_[ray_owner_[ray]] : -ray_normal_[ray];
    if (direction.dot(X_CT.linear() * target_normal_[hits.triangle[ray]]) > 0) ++count;
  }
  return count;
}

void add_up(const OverlapSampler& sampler, const OverlapSampler::Found& found,
            const std::optional<OverlapPressures>& pressures, SurfaceContact& out) {
  out.faces.clear();
  out.met_from_front = found.met_from_front;
  out.rim_faces = found.rim_faces;
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
  // What a cut leaves of a face may be no more than rounding.
  std::erase_if(out.faces, [](const FaceContact& of) { return !(of.overlap_mm3 > 0); });
  out.totals = totals_of(out.faces, sampler.casting(), sampler.options().rule);
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
