#include "measure/rim.hpp"

#include <algorithm>
#include <cmath>

#include "core/formatted.hpp"
#include "core/symmetric.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/surface_points.hpp"
#include "measure/degree.hpp"
#include "measure/fit_circle.hpp"
#include "measure/near_part.hpp"
#include "measure/neck_hours.hpp"
#include "measure/surface_grain.hpp"

namespace condyle::measure {
namespace {

/// Points of a plane count less the farther they are from it, and not at all beyond so many robust deviations (Tukey's biweight), as a
/// notch is. At 2.2 to 2.8 the inclination of the Visible Human's socket is between 52.3 and 51.9 degrees; at 4.7, which takes part of the
/// notch in, 48.6. Distances below the other, mm, are none.
constexpr double deviations_kept = 2.5, narrowest_mm = 0.05;
/// Change of a normal that counts as none, and rounds after which any remaining change does.
constexpr double plane_settled = 1e-12;
constexpr int most_plane_rounds = 200;
/// In radii of the head: so far beside the axis through its centre the circle of the rim is found as from the middle. A head that has left
/// its socket sees the near part of it and what is beside it.
constexpr double farthest_beside = 0.35;
/// ... and narrower than the head only where the socket reaches around it, as in a protrusion: less is a hollow beside the socket.
constexpr double narrowest_rim = 0.8;
/// The rim about the opening, and about the normal of its plane: a third pass changes nothing visible.
constexpr int rim_rounds = 3;

/// Towards the opening is -x: the largest angle from the inward axis.
std::optional<Vec2> farthest_towards_opening(const Contour& half, double reach) {
  std::optional<Vec2> farthest;
  double largest = -1;
  bool is_end = false;
  const auto consider = [&](const Vec2& p, bool ends) {
    const double angle = core::arctangent(p.y(), -p.x());
    if (angle > largest) largest = angle, farthest = p, is_end = ends;
  };
  for (ContourPiece piece : half) {
    if (!clip_to_circle(piece, Vec2::Zero(), reach)) continue;
    consider(piece.from, piece.from_end);
    consider(piece.to, piece.to_end);
  }
  return is_end ? std::nullopt : farthest;
}

std::vector<RimHour> rim_about(const SocketWall& wall, const Sphere& head, const Vec3& opening,
                               const motion::ClockFace& clock, const BodyAxes& axes) {
  const AxisSections sections(wall.mesh, head.centre, opening, clock.twelve, clock.three, wall.ends);
  const double reach = head.radius + by_head(farthest_wall_mm, head);
  std::vector<RimHour> rim(rim_steps);
  const auto set = [&](std::size_t step, const Contour& half) {
    const double turn = two_pi * static_cast<double>(step) / rim_steps;
    RimHour& out = rim[step];
    out = {12.0 * static_cast<double>(step) / rim_steps, {}, 0, 0, false};
    const auto edge = farthest_towards_opening(half, reach);
    if (!edge) return;
    out.point = sections.point(turn, *edge);
    out.cover_deg = core::arctangent(edge->y(), -edge->x()) / degree;
    const Vec3 ray = *out.point - head.centre;
    out.centre_edge_deg = core::arctangent(ray.cross(axes.superior).norm(), ray.dot(axes.superior)) / degree;
  };
  for (std::size_t k = 0; k < rim_steps / 2; ++k) {
    const Contour section = sections.at(two_pi * static_cast<double>(k) / rim_steps);
    set(k, upper_half(section));
    set(k + rim_steps / 2, lower_half(section));
  }
  return rim;
}

struct Plane {
  Vec3 point, normal;

  double distance(const Vec3& p) const { return std::abs((p - point).dot(normal)); }
};

Plane plane_through(const std::vector<Vec3>& points, const std::vector<double>& weights, const Vec3& side) {
  Vec3 mean = Vec3::Zero();
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) mean += weights[i] * points[i], sum += weights[i];
  mean /= sum;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
    spread += weights[i] * (points[i] - mean) * (points[i] - mean).transpose();
  Vec3 normal = core::axes_of(spread).directions.col(0);
  if (normal.dot(side) < 0) normal = -normal;
  return {mean, normal};
}

/// Least squares again and again, each point with the weight of its distance, until the plane stays.
template <class Weight>
Plane reweighted(const std::vector<Vec3>& points, Plane plane, const Weight& weight) {
  std::vector<double> weights(points.size());
  for (int round = 0; round < most_plane_rounds; ++round) {
    for (std::size_t i = 0; i < points.size(); ++i) weights[i] = weight(plane.distance(points[i]));
    const Plane next = plane_through(points, weights, plane.normal);
    const double change = (next.normal - plane.normal).norm();
    plane = next;
    if (change < plane_settled) break;
  }
  return plane;
}

/// Marks the hours that it is fitted to.
Plane fit_plane(std::vector<RimHour>& rim, const Vec3& opening, const Sphere& head) {
  const double narrowest = by_head(narrowest_mm, head);
  std::vector<Vec3> points;
  for (const RimHour& hour : rim)
    if (hour.point) points.push_back(*hour.point);
  Plane plane = plane_through(points, std::vector<double>(points.size(), 1), opening);
  plane = reweighted(points, plane, [&](double d) { return 1 / std::max(d, narrowest); });
  std::vector<double> off;
  for (const Vec3& p : points) off.push_back(plane.distance(p));
  const double reach = std::max(deviations_kept * kinematics::robust_deviation(std::move(off)), narrowest);
  plane = reweighted(points, plane, [&](double d) {
    const double rest = 1 - d * d / (reach * reach);
    return rest > 0 ? rest * rest : 0;
  });
  for (RimHour& hour : rim) hour.is_in_plane = hour.point && plane.distance(*hour.point) < reach;
  return plane;
}

std::optional<RimGeometry> circle_in(const Plane& plane, const std::vector<RimHour>& rim,
                                     const motion::ClockFace& clock) {
  const Vec3 x = clock.twelve, y = plane.normal.cross(x);
  std::vector<Vec2> points;
  for (const RimHour& hour : rim)
    if (hour.is_in_plane)
      points.emplace_back((*hour.point - plane.point).dot(x), (*hour.point - plane.point).dot(y));
  const auto circle = circle_through(points);
  if (!circle) return std::nullopt;
  return RimGeometry{plane.point + circle->centre.x() * x + circle->centre.y() * y, plane.normal,
                     circle->radius, clock};
}

/// Why a rim is not that of the head's socket; empty if it is.
std::string why_not_of_head(const RimGeometry& rim, const Sphere& head) {
  const Vec3 ray = rim.centre - head.centre;
  const double beside = (ray - ray.dot(rim.normal) * rim.normal).norm();
  if (rim.radius_mm >= narrowest_rim * head.radius && beside <= farthest_beside * head.radius) return {};
  return core::formatted(
      "what faces the head ends in a circle of %.0f mm radius, %.0f mm beside the head: no socket that it is "
      "in",
      rim.radius_mm, beside);
}

/// Mean edge of the triangles at each vertex.
std::vector<double> mean_edges(const TriMesh& mesh) {
  std::vector<double> sums(mesh.vertices.size()), counts(sums.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double edges = 0;
    for (int k = 0; k < 3; ++k) edges += (mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)).norm();
    for (const Index v : mesh.triangles[t]) sums[v] += edges, counts[v] += 3;
  }
  for (std::size_t v = 0; v < sums.size(); ++v) sums[v] /= std::max(counts[v], 1.0);
  return sums;
}

}  // namespace

SocketWall socket_wall(const TriMesh& hip_bone, const Sphere& head, const std::vector<char>& ends) {
  MeshPart part = facing_part(hip_bone, {head.centre, head.radius + by_head(farthest_wall_mm, head)});
  SocketWall wall{std::move(part.mesh), {}, {}};
  for (const Index v : part.vertices) wall.ends.push_back(ends[v]);
  wall.edge_mm = mean_edges(wall.mesh);
  return wall;
}

std::string edge_grain_note(const SocketWall& wall, const Sphere& head, const Vec3& point) {
  double nearest = HUGE_VAL, edge = 0;
  for (std::size_t v = 0; v < wall.edge_mm.size(); ++v)
    if (const double off = (wall.mesh.vertices[v] - point).squaredNorm(); off < nearest)
      nearest = off, edge = wall.edge_mm[v];
  if (!(edge > by_head(coarse_edge_mm, head))) return {};
  return core::formatted("triangles of %.1f mm cut off the rim here: it may end %.0f degrees farther", edge,
                         core::arctangent(edge / 2, (point - head.centre).norm()) / degree);
}

RimFinding find_rim(const SocketWall& wall, const Sphere& head, const Vec3& opening, const BodyAxes& axes) {
  RimFinding found;
  Vec3 about = opening;
  for (int round = 0; round < rim_rounds; ++round) {
    const auto clock = clock_about(about, axes.superior, axes.anterior);
    if (!clock) {
      found.why_none = "the socket opens straight up or down: no 12 o'clock";
      return found;
    }
    found.hours = rim_about(wall, head, about, *clock, axes);
    const auto seen = static_cast<std::size_t>(
        std::count_if(found.hours.begin(), found.hours.end(), [](const RimHour& h) { return h.point; }));
    if (seen < fewest_rim_steps) {
      found.plane.reset();
      found.why_none = core::formatted("the rim is in the mesh over %.0f of 360 degrees (needs %.0f)",
                                       360.0 * static_cast<double>(seen) / rim_steps,
                                       360.0 * fewest_rim_steps / rim_steps);
      return found;
    }
    const Plane plane = fit_plane(found.hours, about, head);
    // The face about the normal: the rim that it is fitted to was found about one that is as good as it.
    const auto face = clock_about(plane.normal, axes.superior, axes.anterior);
    found.plane = face ? circle_in(plane, found.hours, *face) : std::nullopt;
    if (!found.plane) {
      found.why_none = "the points of the rim lie on no circle";
      return found;
    }
    about = plane.normal;
  }
  found.why_none = why_not_of_head(*found.plane, head);
  if (!found.why_none.empty()) found.plane.reset();
  return found;
}

}  // namespace condyle::measure
