#include <algorithm>
#include <array>
#include <cmath>

#include "contact/along_rays.hpp"
#include "contact/overlap_sampler.hpp"
#include "core/turned.hpp"

namespace condyle::contact {
namespace {

using Barycentric = std::array<double, 3>;

/// Depths further from each other than this many lengths of the face's longest edge are of different parts of the target:
/// across its rim, or on another condyle. Faces then meet at more than 60 degrees, and are no thin layer.
constexpr double steepest_linear = 2;

/// A depth that would change by more than this for each mm up to the rim comes from a side of the target, not from
/// the surface opposite. Twice that makes the greatest depth of a hip's walk a quarter larger, with the head's
/// cartilage cast.
constexpr double steepest_at_rim = 0.25;

/// The place where an edge leaves the target is taken to move at most one over this as fast as the target does, also where the edge
/// grazes it. A tenth of that speed takes a hip's walk more steps.
constexpr double least_steep = 0.001;

/// Centres of the 16 triangles that three parallels to each edge cut a triangle into.
constexpr std::size_t face_parts = 16;
std::array<Barycentric, face_parts> part_centres() {
  std::array<Barycentric, face_parts> centres;
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
struct QuadratureNode {
  Barycentric at;
  double weight;
};

/// Middles of the edges: exact for quadratic functions.
constexpr std::array<QuadratureNode, 3> nodes_of_degree_2 = {
    {{{0.5, 0.5, 0}, 1.0 / 3}, {{0, 0.5, 0.5}, 1.0 / 3}, {{0.5, 0, 0.5}, 1.0 / 3}}};

/// Radon's seven nodes: exact to degree 5.
std::array<QuadratureNode, 7> nodes_of_degree_5() {
  const double root = std::sqrt(15.0);
  std::array<QuadratureNode, 7> nodes;
  nodes[0] = {{1.0 / 3, 1.0 / 3, 1.0 / 3}, 9.0 / 40};
  std::size_t count = 1;
  for (const double sign : {-1.0, 1.0}) {
    const double a = (6 + sign * root) / 21, b = 1 - 2 * a, weight = (155 + sign * root) / 1200;
    for (const auto& at : {Barycentric{b, a, a}, Barycentric{a, b, a}, Barycentric{a, a, b}})
      nodes[count++] = {at, weight};
  }
  return nodes;
}

template <class Value>
Value mixed(const Barycentric& w, const Value& a, const Value& b, const Value& c) {
  return w[0] * a + w[1] * b + w[2] * c;
}

}  // namespace

struct OverlapSampler::PartCorner {
  Barycentric at;
  double depth;
  Vec3 point, gradient;
  double casting_thickness, target_thickness;
  Index of_ray = no_index;  ///< the face's corner whose ray is taken to run on up to here
  Barycentric start{};      ///< and the place that the ray is taken at
};

/// Corners in the sense of the face's, four at most.
class OverlapSampler::Part {
 public:
  void add(const PartCorner& corner) { corners_[count_++] = corner; }
  void add_on_edge(std::size_t edge, const PartCorner& corner) {
    on_edge_[edge] = count_;
    add(corner);
  }
  std::size_t size() const noexcept { return count_; }
  const PartCorner& operator[](std::size_t i) const noexcept { return corners_[i]; }
  /// Whether the ray of a corner is taken to run on up to another.
  bool runs_on() const noexcept {
    return std::any_of(corners_.begin(), corners_.begin() + static_cast<std::ptrdiff_t>(count_),
                       [](const PartCorner& corner) { return corner.of_ray != no_index; });
  }
  const PartCorner& on_edge(std::size_t edge) const noexcept { return corners_[on_edge_[edge]]; }

 private:
  std::array<PartCorner, 4> corners_;
  std::size_t count_ = 0;
  std::array<std::size_t, 3> on_edge_{};  ///< of edges that leave the target
};

namespace {

/// Three corners of a part, by their numbers, and how much of the triangle counts.
struct PartTriangle {
  std::array<std::size_t, 3> corners;
  double counts;
};

constexpr PartTriangle one_triangle[] = {{{0, 1, 2}, 1}};
constexpr PartTriangle two_halves[] = {{{0, 1, 2}, 1}, {{0, 2, 3}, 1}};
constexpr PartTriangle halved_both_ways[] = {
    {{0, 1, 2}, 0.5}, {{0, 2, 3}, 0.5}, {{1, 2, 3}, 0.5}, {{1, 3, 0}, 0.5}};

/// Triangles that a part of so many corners consists of.
std::span<const PartTriangle> triangles_of(std::size_t corners, bool is_linear) noexcept {
  if (corners < 3) return {};
  if (corners == 3) return one_triangle;
  if (is_linear) return two_halves;
  return halved_both_ways;
}

}  // namespace

void OverlapSampler::sample_faces(const Pose& X_CT, Quadrature quadrature,
                                  const LayerThicknesses& thicknesses, Scratch& scratch, Results& out) const {
  const Pose X_TC = inverted(X_CT);
  cast_outwards(X_CT, scratch, out);
  scratch.rim.clear();
  for (const Index face : scratch.active)
    if (is_rim(face, scratch.ends)) scratch.rim.push_back({.face = face});
  out.rim_faces = scratch.rim.size();
  cast_along_edges(X_CT, scratch, out);
  cast_parts(X_CT, scratch, out);
  const bool with_thickness = !thicknesses.casting.empty() || !thicknesses.target.empty();
  auto next_rim = scratch.rim.begin();
  for (const Index face : scratch.active) {
    const bool at_rim = next_rim != scratch.rim.end() && next_rim->face == face;
    const RimFace* rim = at_rim ? &*next_rim++ : nullptr;
    if (rim && rim->by_parts) {
      sample_parts_of(*rim, thicknesses, X_CT, X_TC, scratch, out);
      continue;
    }
    const Part part = part_of(face, rim, thicknesses, X_TC, scratch.ends);
    if (part.size() == 0) continue;
    sample_part(face, part, quadrature, with_thickness, out);
    if (rim) sample_border(*rim, part, X_CT, scratch.ends, out);
  }
}

void OverlapSampler::sample_by_parts(const Pose& X_CT, const LayerThicknesses& thicknesses,
                                     Results& out) const {
  require_whole();
  clear(out);
  auto scratch = scratch_.take();
  cast_inwards(X_CT, *scratch, out);
  scratch->rim.clear();
  for (Index face = 0; face < rays_.faces(); ++face) {
    const auto& rays = rays_.of_corners(face);
    if (rays_.face_area(face) > 0 && std::any_of(rays.begin(), rays.end(), [&](Index ray) {
          return scratch->ends.has(ray) || scratch->oblique[ray];
        }))
      scratch->rim.push_back({.face = face, .by_parts = true});
  }
  cast_parts(X_CT, *scratch, out);
  const Pose X_TC = inverted(X_CT);
  for (const RimFace& face : scratch->rim) sample_parts_of(face, thicknesses, X_CT, X_TC, *scratch, out);
  scratch_.put_back(std::move(scratch));
}

void OverlapSampler::cast_outwards(const Pose& X_CT, Scratch& scratch, Results& out) const {
  auto& ends = scratch.ends;
  scratch.active.clear();
  scratch.rays.clear();
  scratch.owner.clear();
  scratch.outwards.assign(ends.rays(), 0);
  for (Index face = 0; face < rays_.faces(); ++face) {
    const auto& [a, b, c] = rays_.of_corners(face);
    if (rays_.face_area(face) == 0) continue;
    const int oblique = oblique_corners(face, scratch);
    if (oblique == 3) out.oblique_area += rays_.face_area(face);
    if (oblique == 3 || !(oblique > 0 || ends.has(a) || ends.has(b) || ends.has(c))) continue;
    scratch.active.push_back(face);
    // A ray that meets the target inwards, though at a slant, is not outside it. Beside it parts decide, which need
    // no gaps.
    if (oblique > 0) continue;
    for (const Index ray : rays_.of_corners(face)) scratch.outwards[ray] = !ends.has(ray);
  }
  for (Index ray = 0; ray < ends.rays(); ++ray) {
    if (!scratch.outwards[ray]) continue;
    scratch.owner.push_back(ray);
    scratch.rays.push_back({casting_.vertices()[rays_.owner(ray)], rays_.normal(ray)});
  }
  mesh::nearest_hits(ray_target_, inverted(X_CT), scratch.rays, options_.reach_mm, scratch.hits);
  out.rays += scratch.rays.size();
  for (std::size_t i = 0; i < scratch.owner.size(); ++i) {
    const Index ray = scratch.owner[i];
    if (!scratch.hits.is_hit(i)) continue;
    const Index triangle = scratch.hits.triangle[i];
    ends.set(ray, {-scratch.hits.distance[i], triangle,
                   depth_gradient(core::turned(X_CT, target_normal_[triangle]), -rays_.normal(ray))});
  }
}

bool OverlapSampler::runs_on(Index face, const RayEnds& ends, Index a, Index b) const {
  return ends.has(a) && ends.has(b) &&
         std::abs(ends[a].depth - ends[b].depth) <= steepest_linear * rays_.longest_edge(face);
}

bool OverlapSampler::is_rim(Index face, const RayEnds& ends) const {
  const auto& [a, b, c] = rays_.of_corners(face);
  return !(runs_on(face, ends, a, b) && runs_on(face, ends, b, c) && runs_on(face, ends, c, a));
}

std::optional<OverlapSampler::LeavingEdge> OverlapSampler::leaving_edge(Index face, std::size_t edge,
                                                                        const RayEnds& ends) const {
  const std::size_t next = (edge + 1) % 3;
  const bool inside = is_inside(ends, rays_.of_corners(face)[edge]);
  if (inside == is_inside(ends, rays_.of_corners(face)[next])) return std::nullopt;
  return inside ? LeavingEdge{edge, next} : LeavingEdge{next, edge};
}

int OverlapSampler::oblique_corners(Index face, const Scratch& scratch) const {
  const auto& [a, b, c] = rays_.of_corners(face);
  return scratch.oblique[a] + scratch.oblique[b] + scratch.oblique[c];
}

bool OverlapSampler::is_decided_by_parts(Index face, const Scratch& scratch) const {
  const RayEnds& ends = scratch.ends;
  // An open target ends where no edge meets it, and what has no depth beside what has one ends at no edge of the target either.
  if (!target_is_closed_ || oblique_corners(face, scratch) > 0) return true;
  const auto& rays = rays_.of_corners(face);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!is_inside(ends, rays[k])) continue;
    // A corner that lies deeper than the face is long, and yet next to where the target ends, looks along a side of it.
    if (ends[rays[k]].depth > rays_.longest_edge(face)) return true;
    // Two may be inside different parts of the target.
    const Index next = rays[(k + 1) % 3];
    if (is_inside(ends, next) && !runs_on(face, ends, rays[k], next)) return true;
  }
  return false;
}

void OverlapSampler::cast_along_edges(const Pose& X_CT, Scratch& scratch, Results& out) const {
  const RayEnds& ends = scratch.ends;
  scratch.rays.clear();
  scratch.owner.clear();
  for (Index i = 0; i < scratch.rim.size(); ++i) {
    RimFace& rim = scratch.rim[i];
    rim.by_parts = is_decided_by_parts(rim.face, scratch);
    for (Index k = 0; k < 3 && !rim.by_parts; ++k) {
      const auto edge = leaving_edge(rim.face, k, ends);
      const auto& rays = rays_.of_corners(rim.face);
      if (!edge || runs_on(rim.face, ends, rays[edge->in], rays[edge->out])) continue;
      const Vec3 from = casting_corner(rim.face, edge->in);
      scratch.owner.push_back(3 * i + k);
      scratch.rays.push_back({from, unit(casting_corner(rim.face, edge->out) - from)});
    }
  }
  mesh::nearest_hits(ray_target_, inverted(X_CT), scratch.rays, options_.reach_mm, scratch.hits);
  out.rays += scratch.rays.size();
  for (std::size_t ray = 0; ray < scratch.owner.size(); ++ray) {
    RimFace& rim = scratch.rim[scratch.owner[ray] / 3];
    const std::size_t k = scratch.owner[ray] % 3;
    const double length = (casting_corner(rim.face, (k + 1) % 3) - casting_corner(rim.face, k)).norm();
    const double distance = scratch.hits.distance[ray];
    const Index triangle = scratch.hits.triangle[ray];
    // Where the edge is not seen to leave, as from within two solids, parts decide.
    if (distance <= length &&
        scratch.rays[ray].direction.dot(core::turned(X_CT, target_normal_[triangle])) > 0)
      rim.crossings[k] = {distance / length, triangle};
    else
      rim.by_parts = true;
  }
}

void OverlapSampler::cast_parts(const Pose& X_CT, Scratch& scratch, Results& out) const {
  static const auto centres = part_centres();
  scratch.rays.clear();
  for (RimFace& rim : scratch.rim) {
    if (!rim.by_parts) continue;
    rim.first_part = static_cast<Index>(scratch.rays.size());
    const auto& corners = casting_.triangles()[rim.face];
    const auto& rays = rays_.of_corners(rim.face);
    for (const auto& w : centres)
      scratch.rays.push_back(
          {mixed(w, casting_.vertices()[corners[0]], casting_.vertices()[corners[1]],
                 casting_.vertices()[corners[2]]),
           unit(-mixed(w, rays_.normal(rays[0]), rays_.normal(rays[1]), rays_.normal(rays[2])))});
  }
  mesh::nearest_hits(ray_target_, inverted(X_CT), scratch.rays, options_.reach_mm, scratch.hits);
  out.rays += scratch.rays.size();
}

OverlapSampler::Part OverlapSampler::part_of(Index face, const RimFace* rim,
                                             const LayerThicknesses& thicknesses, const Pose& X_TC,
                                             const RayEnds& ends) const {
  const auto& vertices = casting_.triangles()[face];
  const auto& rays = rays_.of_corners(face);
  // Where the part ends on an edge: `share` of the way from one corner to the other.
  const auto between = [&](const PartCorner& a, const PartCorner& b, double share, double depth) {
    PartCorner c;
    for (std::size_t i = 0; i < 3; ++i) c.at[i] = (1 - share) * a.at[i] + share * b.at[i];
    c.depth = depth;
    c.point = (1 - share) * a.point + share * b.point;
    c.gradient = (1 - share) * a.gradient + share * b.gradient;
    c.casting_thickness = (1 - share) * a.casting_thickness + share * b.casting_thickness;
    c.target_thickness = (1 - share) * a.target_thickness + share * b.target_thickness;
    return c;
  };
  std::array<PartCorner, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    PartCorner& corner = corners[k];
    const Index v = vertices[k];
    corner = {{}, 0, casting_.vertices()[v], Vec3::Zero(), 0, 0, no_index, {}};
    corner.at[k] = 1;
    if (!thicknesses.casting.empty()) corner.casting_thickness = thicknesses.casting[v];
    if (!ends.has(rays[k])) continue;
    const RayEnd& end = ends[rays[k]];
    corner.depth = end.depth;
    corner.gradient = end.gradient;
    if (!thicknesses.target.empty())
      corner.target_thickness =
          target_thickness(end, corner.point, -rays_.normal(rays[k]), X_TC, thicknesses.target);
  }
  // From the corner behind the one outside, or else the one inside: a part has the same corners wherever the triangle's are counted from.
  std::size_t first = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (is_inside(ends, rays[k]) && !is_inside(ends, rays[(k + 2) % 3])) first = k;
  Part part;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (first + i) % 3;
    if (is_inside(ends, rays[k])) part.add(corners[k]);
    const auto edge = leaving_edge(face, k, ends);
    if (!edge) continue;
    const PartCorner &inside = corners[edge->in], &outside = corners[edge->out];
    if (!rim || !rim->crossings[k]) {
      const double share = inside.depth / (inside.depth - outside.depth);
      part.add_on_edge(k, between(inside, outside, share, 0));
      continue;
    }
    // Up to the rim what the ray from the corner inside ends on is taken to run on, if it is no wall.
    const RayEnd& end = ends[rays[edge->in]];
    const Vec3& normal = rays_.normal(rays[edge->in]);
    PartCorner last = between(inside, outside, rim->crossings[k]->share, end.depth);
    const Vec3 met = inside.point - end.depth * normal;
    const double run_on = end.gradient.dot(met - last.point);
    last.of_ray = static_cast<Index>(edge->in);
    last.start = inside.at;
    if (std::abs(run_on - end.depth) <= steepest_at_rim * (last.point - inside.point).norm()) {
      last.depth = std::max(0.0, run_on);
      last.start = last.at;
    }
    last.gradient = end.gradient;
    if (!thicknesses.target.empty())
      last.target_thickness = target_thickness({last.depth, end.triangle, end.gradient}, last.point, -normal,
                                               X_TC, thicknesses.target);
    part.add_on_edge(k, last);
  }
  return part;
}

void OverlapSampler::sample_part(Index face, const Part& part, Quadrature quadrature, bool with_thickness,
                                 Results& out) const {
  static const auto of_degree_5 = nodes_of_degree_5();
  const std::span<const QuadratureNode> nodes = quadrature == Quadrature::of_degree_2
                                                    ? std::span<const QuadratureNode>(nodes_of_degree_2)
                                                    : std::span<const QuadratureNode>(of_degree_5);
  if (with_thickness) {
    for (std::size_t k = 0; k < part.size(); ++k)
      out.corners.push_back({face, part[k].depth, part[k].casting_thickness, part[k].target_thickness});
  } else {
    double deepest = 0;
    for (std::size_t k = 0; k < part.size(); ++k) deepest = std::max(deepest, part[k].depth);
    out.corners.push_back({face, deepest, 0, 0});
  }
  // A depth that is linear over four corners has the same integrals whichever way these are halved. Where it is not, or what is integrated
  // is no polynomial, one way would give another answer than its mirror image.
  const bool is_linear = quadrature == Quadrature::of_degree_2 && !part.runs_on();
  for (const auto& [of, counts] : triangles_of(part.size(), is_linear)) {
    const PartCorner &a = part[of[0]], &b = part[of[1]], &c = part[of[2]];
    // Areas of barycentric triangles are shares of the face's.
    const double share = counts * std::abs((b.at[0] - a.at[0]) * (c.at[1] - a.at[1]) -
                                           (b.at[1] - a.at[1]) * (c.at[0] - a.at[0]));
    if (!(share > 0)) continue;
    const bool runs_on = a.of_ray != no_index || b.of_ray != no_index || c.of_ray != no_index;
    for (const auto& [at, weight] : nodes) {
      out.samples.push_back({face,
                             share * rays_.face_area(face) * weight,
                             mixed(at, a.depth, b.depth, c.depth),
                             mixed(at, a.point, b.point, c.point),
                             mixed(at, a.gradient, b.gradient, c.gradient),
                             mixed(at, a.casting_thickness, b.casting_thickness, c.casting_thickness),
                             mixed(at, a.target_thickness, b.target_thickness, c.target_thickness),
                             {mixed(at, a.at[0], b.at[0], c.at[0]), mixed(at, a.at[1], b.at[1], c.at[1]),
                              mixed(at, a.at[2], b.at[2], c.at[2])}});
      if (!runs_on) continue;
      out.samples.back().run_on = static_cast<Index>(out.run_on.size());
      RunOn& rays = out.run_on.emplace_back();
      for (const auto& [corner, of_corner] :
           {std::pair{&a, at[0]}, std::pair{&b, at[1]}, std::pair{&c, at[2]}})
        for (std::size_t ray = 0; ray < 3; ++ray)
          if (corner->of_ray == no_index)
            rays[ray][ray] += of_corner * corner->at[ray];
          else
            rays[corner->of_ray][ray] += of_corner * corner->start[ray];
    }
  }
}

// The line runs from the edge that leaves the target to the one that comes back. An end that moves by v takes the line's piece l
// along: the area grows by (v x l).n times what of the line follows that end.
void OverlapSampler::sample_border(const RimFace& rim, const Part& part, const Pose& X_CT,
                                   const RayEnds& ends, Results& out) const {
  const auto& rays = rays_.of_corners(rim.face);
  struct End {
    const PartCorner* corner;
    Vec3 along;         ///< the edge, out of the target
    Vec3 slid, turned;  ///< how far along it the end moves when the target is translated, and turned
  };
  const auto met_by = [&](std::size_t k) -> Vec3 {
    return casting_corner(rim.face, k) - ends[rays[k]].depth * rays_.normal(rays[k]);
  };
  const auto end_on = [&](std::size_t k, const LeavingEdge& edge) -> End {
    const PartCorner& corner = part.on_edge(k);
    const Vec3 way = casting_corner(rim.face, edge.out) - casting_corner(rim.face, edge.in);
    if (rim.crossings[k]) {
      const Vec3 along = unit(way), normal = core::turned(X_CT, target_normal_[rim.crossings[k]->triangle]);
      const Vec3 slid = normal / std::max(along.dot(normal), least_steep);
      return {&corner, along, slid, corner.point.cross(slid)};
    }
    const RayEnd &a = ends[rays[edge.in]], &b = ends[rays[edge.out]];
    const double fall = a.depth - b.depth, squared = fall * fall;
    return {&corner, way, (a.depth * b.gradient - b.depth * a.gradient) / squared,
            (a.depth * met_by(edge.out).cross(b.gradient) - b.depth * met_by(edge.in).cross(a.gradient)) /
                squared};
  };
  std::array<End, 2> line;
  for (std::size_t k = 0; k < 3; ++k)
    if (const auto edge = leaving_edge(rim.face, k, ends)) line[edge->in == k ? 0 : 1] = end_on(k, *edge);
  const Vec3 across = (line[1].corner->point - line[0].corner->point).cross(rays_.face_normals()[rim.face]);
  // Gauss's two nodes: pressures and moves are linear along the line, or nearly.
  for (const double at : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)}) {
    const PartCorner &a = *line[0].corner, &b = *line[1].corner;
    const double of_a = (1 - at) * line[0].along.dot(across) / 2, of_b = at * line[1].along.dot(across) / 2;
    const Vec3 growth = of_a * line[0].slid + of_b * line[1].slid;
    const Vec3 growth_turned = of_a * line[0].turned + of_b * line[1].turned;
    out.borders.push_back({rim.face, (1 - at) * a.depth + at * b.depth, (1 - at) * a.point + at * b.point,
                           growth, growth_turned, (1 - at) * a.casting_thickness + at * b.casting_thickness,
                           (1 - at) * a.target_thickness + at * b.target_thickness});
  }
}

void OverlapSampler::sample_parts_of(const RimFace& rim, const LayerThicknesses& thicknesses,
                                     const Pose& X_CT, const Pose& X_TC, const Scratch& scratch,
                                     Results& out) const {
  static const auto centres = part_centres();
  const Index face = rim.face;
  const auto& [a, b, c] = casting_.triangles()[face];
  for (std::size_t part = 0; part < face_parts; ++part) {
    const auto& [point, direction] = scratch.rays[rim.first_part + part];
    const auto overlap = overlap_of(direction, scratch.hits, rim.first_part + part, X_CT);
    if (!overlap || !(overlap->end.depth > 0)) continue;
    if (overlap->oblique) {
      out.oblique_area += rays_.face_area(face) / face_parts;
      continue;
    }
    const RayEnd& end = overlap->end;
    OverlapSample sample{
        face,        rays_.face_area(face) / face_parts, end.depth, point, end.gradient, 0, 0, centres[part],
        end.triangle};
    if (!thicknesses.casting.empty())
      sample.casting_thickness =
          mixed(centres[part], thicknesses.casting[a], thicknesses.casting[b], thicknesses.casting[c]);
    if (!thicknesses.target.empty())
      sample.target_thickness = target_thickness(end, point, direction, X_TC, thicknesses.target);
    out.samples.push_back(sample);
  }
}

}  // namespace condyle::contact
