#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include "condyle/error.hpp"
#include "condyle/fit.hpp"
#include "core/symmetric.hpp"
#include "kinematics/axis_bounds.hpp"
#include "kinematics/surface_points.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle {
namespace {

using kinematics::SurfacePoint;

/// Pairs of vertices tried: this many first ones spread evenly over the area, each with this many partners
/// spread evenly over the vertices near it. A cylindrical part with a tenth of the area gets 26 first ones
/// and, of their partners within a radius' reach, mostly its own.
constexpr std::size_t first_vertices = 256;
constexpr std::size_t partners = 32;

/// Vertices over which a candidate is scored before any is fitted.
constexpr std::size_t scored_vertices = 2000;
constexpr std::size_t candidates_kept = 24;

/// Two normals this far from parallel (sine, 12 degrees) give a direction across both.
constexpr double smallest_sine = 0.2;

/// Radii seen from the two vertices of a pair may differ by this part.
constexpr double radius_agreement = 0.15;

/// A vertex belongs to a cylinder while its normal is within 30 degrees of its ray from the axis (cosine) ...
constexpr double smallest_cosine = 0.866;

/// ... and its distance within 3 robust deviations, at least and at most these parts of the radius.
constexpr double deviations_kept = 3;
constexpr double narrowest_band = 1e-6;

/// How round a part must be, and which of two is better.
struct Strictness {
  double first_band, widest_band;  ///< parts of the radius
  bool in_radii;                   ///< area in squared radii, so that a long and full one wins; else area
};
constexpr Strictness strictly{0.10, 0.05, true};

/// Somebody who gives a ball says where to look: what is most of the surface there may be a talar dome (rms residual of
/// a twentieth of the radius, three of which are kept), and is not outdone by a rounded edge. On a whole bone such bands
/// would make one cylinder of a shaft and its condyles.
constexpr Strictness loosely{0.20, 0.15, false};

/// The strict part gives the better axis, if there is one: a dome and the flanks below it are one loose cylinder. On
/// an uneven dome it is a part that happens to look round, whose direction (cosine of 5 degrees) or area (share) is
/// not that of the loose part.
constexpr double agreeing_direction = 0.996, least_share = 0.4;

/// A candidate this near (in radii, and cosine of 10 degrees) to a part already found would grow into the
/// same part.
constexpr double same_part = 0.25;
constexpr double same_direction = 0.985;

/// Requirements on a cylindrical part: rays spread around the axis (the smaller eigenvalue of the mean of u
/// u^T across it is 1/2 for a half circle, 0.1 for an arc of 64 degrees) and a length, in radii: the strip
/// where a sphere touches a cylinder from inside is at most 2 sqrt(2 widest_band) = 0.63 radii long, in a ball 1.1.
constexpr double smallest_spread = 0.10;
constexpr double smallest_length = 1.0;
constexpr std::size_t fewest_vertices = 12;

struct Candidate {
  Cylinder cylinder;
  double score;  ///< area, in squared radii where strict
};

bool belongs(const kinematics::SurfacePoint& p, const Cylinder& c, double band) noexcept {
  const Vec3 q = p.position - c.point;
  const Vec3 ray = q - q.dot(c.direction) * c.direction;
  const double distance = ray.norm();
  return std::abs(distance - c.radius) <= band && p.normal.dot(ray) >= smallest_cosine * distance;
}

/// The cylinder through two points with these normals: its direction is across both, and seen along it the
/// two normals, drawn backwards, meet in the axis.
std::optional<Cylinder> through(const kinematics::SurfacePoint& p, const kinematics::SurfacePoint& q,
                                const CylinderSearch& search) {
  const Vec3 across = p.normal.cross(q.normal);
  const double sine = across.norm();
  if (sine < smallest_sine) return std::nullopt;
  const Vec3 a = across / sine;
  // p - s n_p = q - t n_q across a; crossing with n_q and n_p in turn leaves one unknown each.
  const Vec3 between = p.position - q.position;
  const double s = between.cross(q.normal).dot(a) / sine;
  const double t = between.cross(p.normal).dot(a) / sine;
  const double radius = (s + t) / 2;
  if (!(radius >= search.smallest_radius && radius <= search.largest_radius)) return std::nullopt;
  if (std::abs(s - t) > radius_agreement * radius) return std::nullopt;
  return Cylinder{p.position - s * p.normal, a, radius};
}

/// About `count` positions spread evenly over the area, the same for the same points. A point with the area
/// of several steps is taken once.
std::vector<Index> spread_evenly(const std::vector<kinematics::SurfacePoint>& points, std::size_t count) {
  double total = 0;
  for (const kinematics::SurfacePoint& p : points) total += p.area;
  const double step = total / static_cast<double>(count);
  std::vector<Index> out;
  double sum = 0, due = step / 2;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += points[i].area;
    if (sum < due) continue;
    out.push_back(static_cast<Index>(i));
    due += step * (std::floor((sum - due) / step) + 1);
  }
  return out;
}

std::vector<Candidate> candidates(const std::vector<kinematics::SurfacePoint>& points,
                                  const CylinderSearch& search, const Strictness& strict) {
  const auto scored = spread_evenly(points, scored_vertices);
  std::vector<Candidate> found;
  for (const Index first : spread_evenly(points, first_vertices)) {
    std::vector<Index> near;
    for (const Index i : scored)
      if ((points[i].position - points[first].position).norm() <= 2 * search.largest_radius)
        near.push_back(i);
    for (std::size_t k = 0; k < std::min(partners, near.size()); ++k) {
      const Index second = near[k * near.size() / std::min(partners, near.size())];
      const auto cylinder = through(points[first], points[second], search);
      if (!cylinder) continue;
      double area = 0;
      for (const Index i : scored)
        if (belongs(points[i], *cylinder, strict.widest_band * cylinder->radius)) area += points[i].area;
      found.push_back({*cylinder, strict.in_radii ? area / (cylinder->radius * cylinder->radius) : area});
    }
  }
  const std::size_t kept = std::min(found.size(), candidates_kept);
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  found.resize(kept);
  return found;
}

struct Part {
  CylinderFit fit;
  /// Area; where strict in squared radii: the angle around the axis times the length in radii. 0 for a strip.
  double score;
};

bool near(const Cylinder& a, const Cylinder& b) noexcept {
  return std::abs(a.direction.dot(b.direction)) > same_direction &&
         (a.point - b.point).cross(b.direction).norm() < same_part * b.radius &&
         std::abs(a.radius - b.radius) < same_part * b.radius;
}

double score(const std::vector<kinematics::SurfacePoint>& points, const std::vector<Index>& part,
             const Cylinder& c, const Strictness& strict) {
  Eigen::Matrix3d rays = Eigen::Matrix3d::Zero();
  double area = 0, low = 0, high = 0;
  for (const Index i : part) {
    const Vec3 q = points[i].position - c.point;
    const double height = q.dot(c.direction);
    const Vec3 u = (q - height * c.direction).normalized();
    rays += points[i].area * u * u.transpose();
    area += points[i].area;
    low = std::min(low, height), high = std::max(high, height);
  }
  // The eigenvalue of the axis itself is 0; the next is the smaller of the two across it.
  const Vec3 spread = core::axes_of(rays / area).values;
  if (spread[1] < smallest_spread || high - low < smallest_length * c.radius) return 0;
  return strict.in_radii ? area / (c.radius * c.radius) : area;
}

/// Fits, keeps what lies within the band of the fit, connected, and fits again until the same vertices come
/// back.
std::optional<Part> grown(const TriMesh& mesh, const std::vector<kinematics::SurfacePoint>& points,
                          const kinematics::PointNeighbours& neighbours, Cylinder cylinder,
                          const CylinderSearch& search, const Strictness& strict) {
  constexpr int most_rounds = 60;
  double band = strict.first_band * cylinder.radius;
  std::vector<Index> part;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<Index> on;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (belongs(points[i], cylinder, band)) on.push_back(static_cast<Index>(i));
    auto next = neighbours.largest_connected_part(points, on);
    if (next.size() < fewest_vertices) return std::nullopt;
    const bool same = next == part;
    part = std::move(next);
    const auto vertices = kinematics::vertices_of(points, part);
    CylinderFit fit;
    try {
      fit = fit_cylinder(mesh.vertices, vertices, cylinder);
    } catch (const MeshError&) {
      return std::nullopt;
    }
    cylinder = fit.cylinder;
    if (cylinder.radius < search.smallest_radius || cylinder.radius > search.largest_radius)
      return std::nullopt;
    if (same) return Part{std::move(fit), score(points, part, cylinder, strict)};
    std::vector<double> residuals;
    for (const Index v : vertices)
      residuals.push_back((mesh.vertices[v] - cylinder.point).cross(cylinder.direction).norm() -
                          cylinder.radius);
    band = std::clamp(deviations_kept * kinematics::robust_deviation(std::move(residuals)),
                      narrowest_band * cylinder.radius, strict.widest_band * cylinder.radius);
  }
  return std::nullopt;
}

/// Patches for its bounds: nine sectors about the axis, and three slices along what it has.
kinematics::AxisPatches patches_of(const Points& vertices, const CylinderFit& fit) {
  constexpr int slices = 3;
  double low = 0, high = 0;
  for (const Index v : fit.vertices) {
    const double height = (vertices[v] - fit.cylinder.point).dot(fit.cylinder.direction);
    low = std::min(low, height), high = std::max(high, height);
  }
  return {9, slices, [low, high](double height) {
            return std::min(static_cast<int>((height - low) / (high - low) * slices), slices - 1);
          }};
}

/// With loose bands the belt of a ball is long enough to be a cylinder; a sphere fits it much better.
bool is_belt_of_a_ball(const TriMesh& mesh, const CylinderFit& fit) {
  try {
    return fit_sphere(mesh.vertices, fit.vertices).rms_residual < fit.rms_residual / 2;
  } catch (const MeshError&) {
    return false;
  }
}

std::optional<Part> best_part(const TriMesh& mesh, const std::vector<kinematics::SurfacePoint>& points,
                              const CylinderSearch& search, const Strictness& strict) {
  std::vector<Part> parts;
  if (points.size() >= fewest_vertices) {
    const kinematics::PointNeighbours neighbours(mesh, points);
    for (const Candidate& candidate : candidates(points, search, strict)) {
      const auto known = [&](const Part& part) { return near(candidate.cylinder, part.fit.cylinder); };
      if (std::any_of(parts.begin(), parts.end(), known)) continue;
      if (auto part = grown(mesh, points, neighbours, candidate.cylinder, search, strict))
        parts.push_back(std::move(*part));
    }
  }
  const auto best = std::max_element(parts.begin(), parts.end(),
                                     [](const Part& a, const Part& b) { return a.score < b.score; });
  if (best == parts.end() || best->score == 0) return std::nullopt;
  return std::move(*best);
}

std::optional<Part> best_part(const TriMesh& mesh, const std::vector<kinematics::SurfacePoint>& points,
                              const CylinderSearch& search) {
  auto strict = best_part(mesh, points, search, strictly);
  if (!search.within) return strict;
  auto loose = best_part(mesh, points, search, loosely);
  if (loose && is_belt_of_a_ball(mesh, loose->fit)) return std::nullopt;
  if (!loose || !strict) return loose;
  const Cylinder &s = strict->fit.cylinder, &l = loose->fit.cylinder;
  const bool agree = std::abs(s.direction.dot(l.direction)) >= agreeing_direction &&
                     strict->score * s.radius * s.radius >= least_share * loose->score;
  return agree ? std::move(strict) : std::move(loose);
}

}  // namespace

CylinderFit find_cylinder(const Mesh& mesh, const CylinderSearch& search) {
  return kinematics::find_cylinder_on(mesh::outer_surface(mesh), search);
}

CylinderFit kinematics::find_cylinder_on(const TriMesh& mesh, const CylinderSearch& search) {
  const auto points = kinematics::surface_points(mesh, search.within);
  auto best = best_part(mesh, points, search);
  if (!best) {
    std::ostringstream message;
    message.exceptions(std::ios::badbit);  // no memory is an error, not half a message
    message << "no cylindrical part with a radius from " << search.smallest_radius << " to "
            << search.largest_radius << " mm among " << points.size() << " vertices";
    throw MeshError(message.str());
  }
  kinematics::bound_axis(mesh.vertices, patches_of(mesh.vertices, best->fit), best->fit);
  if (const Angle bound = *best->fit.direction_bound; bound > largest_direction_bound) {
    std::ostringstream message;
    message.exceptions(std::ios::badbit);  // no memory is an error, not half a message
    message << "the best cylindrical part, of radius " << best->fit.cylinder.radius
            << " mm with rms residual " << best->fit.rms_residual << " mm over " << best->fit.vertices.size()
            << " vertices, leaves its axis open: parts of it give directions up to " << bound.degrees()
            << " degrees off";
    throw MeshError(message.str());
  }
  return std::move(best->fit);
}

}  // namespace condyle
