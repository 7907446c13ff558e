#include "kinematics/find_condyles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/axis_bounds.hpp"
#include "kinematics/joint_cylinder.hpp"
#include "kinematics/surface_points.hpp"

namespace condyle::kinematics {
namespace {

/// Around the facing part, mm: the condyles of large knees are 95 mm wide.
constexpr double search_reach = 70;
constexpr double smallest_radius = 8, largest_radius = 40;

/// The search evaluates means over cells of this side, mm, a tenth of a turn on a small condyle: fine meshes have noise.
constexpr double cell = 4;

constexpr std::size_t first_points = 260, partners = 90, candidates_kept = 16;

/// As in find_cylinder(): normals this far from parallel (sine) give a direction, radii seen from both may differ by this part.
constexpr double smallest_sine = 0.2, radius_agreement = 0.15;
/// The axis lies across the shaft, to within 30 degrees (sine): the way to the centroid of a cut femur is 25 off.
constexpr double most_along_femoral_shaft = 0.5;

/// A vertex belongs to a cylinder while its normal is within 30 degrees of its ray (cosine), and within these parts of the
/// radius: at first, and once the fit has settled.
constexpr double smallest_cosine = 0.866, first_band = 0.08, last_band = 0.05;
constexpr int first_rounds = 4, most_rounds = 30;

/// Requirements. The right knee of Lenhart et al. and the Visible Human's femur have 180 degrees in common, a width of 3.2
/// radii, and nothing between. Cylinders through two parts of other surfaces (tibial plateau, femoral neck and trochanter,
/// patella, along one condyle) have 0.28 times as much between as on a side, or more.
constexpr double least_common_arc_deg = 150, least_width = 2.2, largest_width = 4.5, most_between = 0.1;

/// Arcs of a turn in which both condyles may have surface: of 10 degrees, and of 20 where there is a point for each cell only.
constexpr std::size_t fine_arcs = 36, coarse_arcs = 18;
/// An arc is there if it has a strip of this width, mm.
constexpr double least_strip = 3;
constexpr std::size_t fewest_points = 12;

/// The points on a cylinder, and how its two ends share the rotation.
struct Support {
  std::vector<Index> points;  ///< positions, ascending
  double common_arc_deg = 0, between = 0, length = 0, area_of_smaller = 0;
  double middle = 0;  ///< along the axis, between the centroids of both outer thirds

  bool has_two_condyles(double radius) const {
    return common_arc_deg >= least_common_arc_deg && between <= most_between &&
           length >= least_width * radius && length <= largest_width * radius;
  }
};

struct Place {
  double height, turn, area;
};

std::optional<Place> place_on(const SurfacePoint& p, const Cylinder& c, const Vec3& e1, const Vec3& e2,
                              double band) {
  const Vec3 q = p.position - c.point;
  const double height = q.dot(c.direction);
  const Vec3 ray = q - height * c.direction;
  const double distance = ray.norm();
  if (std::abs(distance - c.radius) > band || p.normal.dot(ray) < smallest_cosine * distance)
    return std::nullopt;
  return Place{height, core::arctangent(ray.dot(e2), ray.dot(e1)) / two_pi + 0.5, p.area};
}

/// The length between the second and the 98th hundredth: single vertices of other surfaces lie on every cylinder.
std::pair<double, double> ends_of(const std::vector<Place>& places) {
  std::vector<double> heights;
  for (const Place& place : places) heights.push_back(place.height);
  const auto at = [&](std::size_t hundredth) {
    const auto nth = heights.begin() + static_cast<std::ptrdiff_t>(hundredth * (heights.size() - 1) / 100);
    std::nth_element(heights.begin(), nth, heights.end());
    return *nth;
  };
  const double low = at(2);
  return {low, at(98)};
}

Support support_of(const std::vector<SurfacePoint>& points, const Cylinder& c, double band,
                   std::size_t arcs) {
  Support support;
  std::vector<Place> places;
  const Vec3 e1 = c.direction.unitOrthogonal(), e2 = c.direction.cross(e1);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const auto place = place_on(points[i], c, e1, e2, band * c.radius)) {
      places.push_back(*place);
      support.points.push_back(static_cast<Index>(i));
    }
  if (places.size() < fewest_points) return support;
  const auto [low, high] = ends_of(places);
  support.length = high - low;
  std::array<std::array<double, fine_arcs>, 2> by_arc{};
  std::array<double, 2> area{}, moment{};
  double between = 0;
  for (const Place& place : places) {
    const bool first = place.height<low + support.length / 3, last = place.height> high - support.length / 3;
    if (!first && !last) {
      between += place.area;
      continue;
    }
    by_arc[last][std::min(static_cast<std::size_t>(place.turn * static_cast<double>(arcs)), arcs - 1)] +=
        place.area;
    area[last] += place.area, moment[last] += place.area * place.height;
  }
  support.area_of_smaller = std::min(area[0], area[1]);
  if (!(support.area_of_smaller > 0)) return support;
  const double least_area = least_strip * c.radius * two_pi / static_cast<double>(arcs);
  for (std::size_t k = 0; k < arcs; ++k)
    if (by_arc[0][k] >= least_area && by_arc[1][k] >= least_area)
      support.common_arc_deg += 360.0 / static_cast<double>(arcs);
  support.between = between / support.area_of_smaller;
  support.middle = (moment[0] / area[0] + moment[1] / area[1]) / 2;
  return support;
}

/// One point for each cell: means by area of what lies in it and faces one way.
std::vector<SurfacePoint> cell_means(const std::vector<SurfacePoint>& points) {
  std::map<std::array<std::int64_t, 3>, SurfacePoint> cells;
  for (const SurfacePoint& p : points) {
    const Vec3 at = (p.position - points.front().position) / cell;
    const auto along = [&](int k) { return static_cast<std::int64_t>(std::floor(at[k])); };
    auto& mean = cells
                     .try_emplace({along(0), along(1), along(2)},
                                  SurfacePoint{p.vertex, Vec3::Zero(), Vec3::Zero(), 0})
                     .first->second;
    mean.position += p.area * p.position;
    mean.normal += p.area * p.normal;
    mean.area += p.area;
  }
  constexpr double one_way = 0.6;  // less where two surfaces, or an edge, share the cell
  std::vector<SurfacePoint> means;
  for (const auto& numbered : cells) {
    SurfacePoint mean = numbered.second;
    const double length = mean.normal.norm();
    if (!(length > one_way * mean.area)) continue;
    mean.position /= mean.area;
    mean.normal /= length;
    means.push_back(mean);
  }
  return means;
}

/// The cylinder through two points with these normals, as in find_cylinder().
std::optional<Cylinder> through(const SurfacePoint& p, const SurfacePoint& q, const Vec3& towards_shaft) {
  const Vec3 across = p.normal.cross(q.normal);
  const double sine = across.norm();
  if (sine < smallest_sine) return std::nullopt;
  const Vec3 a = across / sine;
  if (std::abs(a.dot(towards_shaft)) > most_along_femoral_shaft) return std::nullopt;
  const Vec3 between = p.position - q.position;
  const double s = between.cross(q.normal).dot(a) / sine, t = between.cross(p.normal).dot(a) / sine;
  const double radius = (s + t) / 2;
  if (!(radius >= smallest_radius && radius <= largest_radius)) return std::nullopt;
  if (std::abs(s - t) > radius_agreement * radius) return std::nullopt;
  return Cylinder{p.position - s * p.normal, a, radius};
}

struct Candidate {
  Cylinder cylinder;
  double arc, area;  ///< in common, less for what is between; of the smaller part, in squared radii
};

/// Near enough to end in the same fit.
bool alike(const Cylinder& a, const Cylinder& b) {
  constexpr double same_direction = 0.99, same_place = 0.2;  // 8 degrees; radii
  return std::abs(a.direction.dot(b.direction)) > same_direction &&
         (a.point - b.point).cross(b.direction).norm() < same_place * b.radius &&
         std::abs(a.radius - b.radius) < same_place * b.radius;
}

/// The best that are not alike.
std::vector<Candidate> candidates(const std::vector<SurfacePoint>& means, const Vec3& towards_shaft) {
  std::vector<Candidate> found;
  const std::size_t step = std::max<std::size_t>(1, means.size() / first_points);
  for (std::size_t i = 0; i < means.size(); i += step)
    for (std::size_t k = 0; k < partners; ++k) {
      // Shifted with i, so that partners are not always the same.
      const std::size_t j = (k * means.size() / partners + i) % means.size();
      const auto cylinder = through(means[i], means[j], towards_shaft);
      if (!cylinder) continue;
      const Support support = support_of(means, *cylinder, first_band, fine_arcs);
      if (support.length >= least_width * cylinder->radius && support.common_arc_deg > 0)
        found.push_back({*cylinder, support.common_arc_deg / (1 + support.between),
                         support.area_of_smaller / (cylinder->radius * cylinder->radius)});
    }
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.arc != b.arc ? a.arc > b.arc : a.area > b.area;
  });
  std::vector<Candidate> kept;
  for (const Candidate& candidate : found) {
    const auto like_it = [&](const Candidate& other) { return alike(candidate.cylinder, other.cylinder); };
    if (std::none_of(kept.begin(), kept.end(), like_it)) kept.push_back(candidate);
    if (kept.size() == candidates_kept) break;
  }
  return kept;
}

struct Fitted {
  CylinderFit fit;
  Support support;
};

/// Fits what lies on the cylinder, and again, until the same vertices come back.
std::optional<Fitted> settled(PointsView vertices, const std::vector<SurfacePoint>& points, Cylinder cylinder,
                              std::size_t arcs) {
  std::optional<Fitted> found;
  for (int round = 0; round < most_rounds; ++round) {
    Support support = support_of(points, cylinder, round < first_rounds ? first_band : last_band, arcs);
    if (support.points.size() < fewest_points) return std::nullopt;
    const bool same = round > first_rounds && support.points == found->support.points;
    try {
      auto fit = fit_cylinder(vertices, vertices_of(points, support.points), cylinder);
      cylinder = fit.cylinder;
      found = Fitted{std::move(fit), std::move(support)};
    } catch (const MeshError&) {
      return std::nullopt;
    }
    if (!(cylinder.radius >= smallest_radius && cylinder.radius <= largest_radius)) return std::nullopt;
    if (same) break;
  }
  found->support = support_of(points, cylinder, last_band, arcs);
  return found;
}

/// The better of two fits: that with condyles, then that with more in common.
bool better(const Fitted& a, const Fitted& b) {
  const bool a_has = a.support.has_two_condyles(a.fit.cylinder.radius),
             b_has = b.support.has_two_condyles(b.fit.cylinder.radius);
  if (a_has != b_has) return a_has;
  if (a.support.common_arc_deg != b.support.common_arc_deg)
    return a.support.common_arc_deg > b.support.common_arc_deg;
  return a.fit.rms_residual / a.fit.cylinder.radius < b.fit.rms_residual / b.fit.cylinder.radius;
}

/// The best of its fits from starts a few degrees off: on rough surfaces a search ends beside the best fit.
Fitted polished(PointsView vertices, const std::vector<SurfacePoint>& points, Fitted best, std::size_t arcs) {
  const Cylinder found = best.fit.cylinder;
  const Vec3 middle = found.point + best.support.middle * found.direction;
  constexpr double off = 0.06;  // radians, 3.4 degrees: as far as the nearest other fits have been found
  const Vec3 e1 = found.direction.unitOrthogonal(), e2 = found.direction.cross(e1);
  for (const Vec3& side : {e1, Vec3(-e1), e2, Vec3(-e2)}) {
    const Cylinder start{middle, (found.direction + off * side).normalized(), found.radius};
    if (auto fitted = settled(vertices, points, start, arcs); fitted && better(*fitted, best))
      best = std::move(*fitted);
  }
  return best;
}

void require_condyles(const Fitted& best) {
  const Support& s = best.support;
  if (s.has_two_condyles(best.fit.cylinder.radius)) return;
  throw MeshError(core::formatted(
      "the best common cylinder of two condyles, of radius %.1f mm, has %.0f degrees of a turn in common "
      "(needs %.0f), is %.1f radii wide (needs %.1f to %.1f) and has %.2f as much between as on a side "
      "(needs %.1f or less)",
      best.fit.cylinder.radius, s.common_arc_deg, least_common_arc_deg, s.length / best.fit.cylinder.radius,
      least_width, largest_width, s.between, most_between));
}

void require_bounds(const CylinderFit& fit) {
  if (*fit.direction_bound <= largest_axis_bound && *fit.axis_bound_mm <= largest_place_bound_mm) return;
  throw MeshError(core::formatted(
      "parts of the condyles give axes up to %.1f degrees and %.1f mm off (needs %.0f and %.0f)",
      fit.direction_bound->degrees(), *fit.axis_bound_mm, largest_axis_bound.degrees(),
      largest_place_bound_mm));
}

/// The best fit to points of the surface, from candidates of their means. `vertices` are numbered as the points say. Throws
/// MeshError, which says what is missing.
Fitted best_fit(PointsView vertices, const std::vector<SurfacePoint>& points,
                const std::vector<SurfacePoint>& means, const Vec3& towards_shaft, std::size_t arcs) {
  std::optional<Fitted> best;
  if (points.size() >= fewest_points)
    for (const Candidate& candidate : candidates(means, towards_shaft))
      if (auto fitted = settled(vertices, points, candidate.cylinder, arcs);
          fitted && (!best || better(*fitted, *best)))
        best = std::move(fitted);
  if (!best)
    throw MeshError(core::formatted(
        "no cylinder common to two condyles among the %zu vertices that face the other bone", points.size()));
  best = polished(vertices, points, std::move(*best), arcs);
  require_condyles(*best);
  return std::move(*best);
}

Condyles condyles_of(Fitted found) {
  CylinderFit& fit = found.fit;
  fit.cylinder.point += found.support.middle * fit.cylinder.direction;
  fit.coverage = found.support.common_arc_deg / 360;
  return {std::move(fit), found.support.length, found.support.common_arc_deg, found.support.between};
}

}  // namespace

Condyles find_condyles(const TriMesh& femur, const Vec3& facing, const Vec3& towards_shaft) {
  auto points = surface_points(femur, Sphere{facing, search_reach});
  average_normals(points, cell);
  Fitted best = best_fit(femur.vertices, points, cell_means(points), towards_shaft, fine_arcs);
  bound_axis(femur.vertices, {12, 2, [&](double height) { return height > best.support.middle; }}, best.fit);
  require_bounds(best.fit);
  return condyles_of(std::move(best));
}

Condyles find_condyles_roughly(const TriMesh& femur, const Vec3& facing, const Vec3& towards_shaft) {
  auto means = cell_means(surface_points(femur, Sphere{facing, search_reach}));
  Points places;
  for (std::size_t i = 0; i < means.size(); ++i) {
    means[i].vertex = static_cast<Index>(i);
    places.push_back(means[i].position);
  }
  return condyles_of(best_fit(places, means, means, towards_shaft, coarse_arcs));
}

}  // namespace condyle::kinematics
