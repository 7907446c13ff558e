#include "measure/neck_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/formatted.hpp"
#include "core/trigonometry.hpp"
#include "mesh/disjoint_sets.hpp"

namespace condyle::measure {
namespace {

/// A loop whose ends miss each other by more than this part of the sphere's radius is open.
constexpr double closed = 1e-6;
/// Shares of the sphere's great circle: less is a splinter, more is not a neck.
constexpr double least_neck_share = 0.02, largest_share = 0.7;
/// Cosine of the angle between the vector area and the middle of the outline.
constexpr double least_alike = 0.7;

/// Where the sphere crosses an edge, counted from the end with the lower number.
struct Crossing {
  Vec3 point;
  std::array<Index, 3> key;  ///< both ends, and which of two crossings
};

void add_crossings(Index i, Index j, const Vec3& p, const Vec3& q, double radius,
                   std::vector<Crossing>& out) {
  if (i > j) return add_crossings(j, i, q, p, radius, out);
  const Vec3 d = q - p;
  const double a = d.squaredNorm(), b = p.dot(d), c = p.squaredNorm() - radius * radius;
  const bool p_in = c < 0, q_in = q.squaredNorm() < radius * radius;
  if (!(a > 0) || (p_in && q_in)) return;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0)) return;
  const double root = std::sqrt(discriminant);
  if (p_in != q_in) {
    const double t = p_in ? (-b + root) / a : (-b - root) / a;
    out.push_back({p + std::clamp(t, 0.0, 1.0) * d, {i, j, 0}});
    return;
  }
  const double first = (-b - root) / a, last = (-b + root) / a;
  if (!(first > 0 && last < 1)) return;
  out.push_back({p + first * d, {i, j, 0}});
  out.push_back({p + last * d, {i, j, 1}});
}

struct Loop {
  Vec3 area = Vec3::Zero(), open = Vec3::Zero(), moment = Vec3::Zero();
  double length = 0;
  bool has_end = false;  ///< It goes over a face in which the mesh ends.
  std::vector<Vec3> outline;

  void add(const Loop& other) {
    has_end |= other.has_end;
    area += other.area, open += other.open, moment += other.moment, length += other.length;
    outline.insert(outline.end(), other.outline.begin(), other.outline.end());
  }
};

/// Contribution of a triangle: arcs between its crossings that lie inside it, counter-clockwise about its normal, so that the
/// surface within the sphere is on their left.
Loop arcs_in(const std::array<Vec3, 3>& corners, const std::vector<Crossing>& crossings, double radius) {
  Loop out;
  const Vec3 twice = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  if (!(twice.norm() > 0)) return out;
  const Vec3 normal = twice.normalized(), q = corners[0].dot(normal) * normal;
  const double squared = radius * radius - q.squaredNorm();
  if (!(squared > 0)) return out;
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  const double rho = std::sqrt(squared);
  std::vector<std::pair<double, const Crossing*>> around;
  for (const Crossing& crossing : crossings) {
    const Vec3 ray = crossing.point - q;
    around.emplace_back(core::arctangent(ray.dot(v), ray.dot(u)), &crossing);
  }
  std::sort(around.begin(), around.end());
  const auto inside = [&](const Vec3& p) {
    for (std::size_t k = 0; k < 3; ++k)
      if ((corners[(k + 1) % 3] - corners[k]).cross(p - corners[k]).dot(normal) < 0) return false;
    return true;
  };
  for (std::size_t i = 0; i < around.size(); ++i) {
    const auto& [begin, from] = around[i];
    const auto& [next, to] = around[(i + 1) % around.size()];
    const double turn = i + 1 < around.size() ? next - begin : next - begin + 2 * std::numbers::pi;
    const double middle = begin + turn / 2;
    const Vec3 half = q + rho * (core::cosine(middle) * u + core::sine(middle) * v);
    if (!inside(half)) continue;
    out.area += (q.cross(to->point - from->point) + squared * turn * normal) / 2;
    out.open += to->point - from->point;
    out.moment += rho * turn * half, out.length += rho * turn;
    out.outline.push_back(from->point), out.outline.push_back(to->point);
  }
  return out;
}

/// One loop for each connected chain of triangles; if some of them stay open, as where vertices are not welded, all together.
std::vector<Loop> loops_on(const TriMesh& femur, const Vec3& centre, double radius,
                           const std::vector<char>& ends) {
  std::vector<Loop> pieces;
  std::vector<std::array<Index, 3>> keys;
  std::vector<Index> piece_of_key;
  std::vector<char> near(femur.vertices.size()), far(femur.vertices.size());
  for (std::size_t v = 0; v < femur.vertices.size(); ++v)
    (near[v] = (femur.vertices[v] - centre).norm() < radius), far[v] = !near[v];
  for (std::size_t t = 0; t < femur.triangles.size(); ++t) {
    const auto [i, j, k] = femur.triangles[t];
    if (near[i] && near[j] && near[k]) continue;
    const std::array<Vec3, 3> corners{femur.corner(t, 0) - centre, femur.corner(t, 1) - centre,
                                      femur.corner(t, 2) - centre};
    std::vector<Crossing> crossings;
    add_crossings(i, j, corners[0], corners[1], radius, crossings);
    add_crossings(j, k, corners[1], corners[2], radius, crossings);
    add_crossings(k, i, corners[2], corners[0], radius, crossings);
    if (crossings.empty()) continue;
    for (const Crossing& crossing : crossings) {
      keys.push_back(crossing.key);
      piece_of_key.push_back(static_cast<Index>(pieces.size()));
    }
    pieces.push_back(arcs_in(corners, crossings, radius));
    pieces.back().has_end = ends[i] && ends[j] && ends[k];
  }
  mesh::DisjointSets sets(pieces.size());
  std::map<std::array<Index, 3>, Index> first_at;
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (const auto [at, is_new] = first_at.try_emplace(keys[k], piece_of_key[k]); !is_new)
      sets.join(at->second, piece_of_key[k]);
  std::map<Index, Loop> loops;
  for (std::size_t i = 0; i < pieces.size(); ++i) loops[sets.find(static_cast<Index>(i))].add(pieces[i]);
  std::vector<Loop> out;
  Loop all;
  bool is_open = false;
  for (auto& [first, loop] : loops) {
    is_open = is_open || loop.open.norm() > closed * radius;
    all.add(loop);
    out.push_back(std::move(loop));
  }
  if (is_open) out = {std::move(all)};
  return out;
}

}  // namespace

NeckFinding find_neck(const TriMesh& femur, const Sphere& head, const std::vector<char>& ends) {
  const double radius = neck_sphere * head.radius;
  const auto loops = loops_on(femur, head.centre, radius, ends);
  const auto found = std::max_element(
      loops.begin(), loops.end(), [](const Loop& a, const Loop& b) { return a.area.norm() < b.area.norm(); });
  if (found == loops.end())
    return {{}, core::formatted("the mesh ends within %.1f radii of the head: it has no neck", neck_sphere)};
  if (found->open.norm() > closed * radius) return {{}, "the surface of the neck is open"};
  if (found->has_end)
    return {
        {},
        core::formatted(
            "the bone is cut off within %.1f radii of the head's centre: the neck's axis is not in this mesh",
            neck_sphere)};
  // Seen from outside, the surface within the sphere faces away from the neck.
  Vec3 direction = -found->area.normalized();
  const Vec3 middle = found->moment / found->length;
  if (direction.dot(middle) < 0) direction = -direction;
  const double share = found->area.norm() / (std::numbers::pi * radius * radius);
  if (!(share >= least_neck_share && share <= largest_share))
    return {{},
            core::formatted("what crosses a sphere of %.1f radii about the head has %.2f of its great "
                            "circle: no neck (needs %.2f to %.2f)",
                            neck_sphere, share, least_neck_share, largest_share)};
  if (direction.dot(middle) < least_alike * middle.norm())
    return {{}, "what crosses the sphere about the head does not lie to one side, as a neck does"};
  NeckLine neck{direction, found->area.norm(), found->outline};
  for (Vec3& p : neck.outline) p += head.centre;
  return {std::move(neck), {}};
}

}  // namespace condyle::measure
