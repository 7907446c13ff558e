#pragma once

#include <optional>
#include <span>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/mesh.hpp"

/// The centre of a ball joint, from the surface of its head or socket, and the axis of a hinge, from the
/// surface that rotates about it.

namespace condyle {

struct Sphere {
  Vec3 centre;
  double radius;
};

/// Lengths that belong to a hip or shoulder are stated for a head of this radius, mm, and grow with the head: no angle depends on the
/// size of a child or an animal, nor on the unit of a file.
inline constexpr double usual_head_radius_mm = 24;
[[nodiscard]] inline double by_head(double usual_mm, double head_radius) noexcept {
  return usual_mm * (head_radius / usual_head_radius_mm);
}
[[nodiscard]] inline double by_head(double usual_mm, const Sphere& head) noexcept {
  return by_head(usual_mm, head.radius);
}

struct SphereFit {
  Sphere sphere;
  double rms_residual;          ///< of |vertex - centre| - radius, mm
  double largest_residual;      ///< its largest magnitude, mm
  std::vector<Index> vertices;  ///< used, ascending
};

/// The sphere that minimises the sum of squared distances of these points to it. Throws MeshError if fewer
/// than four points, or points (nearly) in one plane, leave it undetermined.
[[nodiscard]] SphereFit fit_sphere(PointsView points, std::span<const Index> vertices);
[[nodiscard]] SphereFit fit_sphere(PointsView points);

/// Which side of the sphere the solid is on: inside (a head) or outside (a socket). Inferred from the winding: in a
/// mesh of inverted orientation, heads are sockets.
enum class SphericalPart { head, socket };

/// Radii between which a sphere is looked for by default, in parts of the root of the surface's area, so that a bone of any size has
/// its head: 10 to 72 mm on a whole adult femur, whose head has 24. A ball has 0.282, a thin hemispherical cup of two sides as much, the
/// socket of a whole pelvis with its sacrum 0.06.
inline constexpr double smallest_radius_share = 1 / 24.4, largest_radius_share = 1 / 3.4;
/// ... of an open sheet, such as a cartilage: a cap of an eighth of a sphere has 0.8.
inline constexpr double largest_radius_share_of_sheet = 0.8;

/// Where a spherical part is looked for. Lengths in mm.
struct SphereSearch {
  SphericalPart part = SphericalPart::head;
  std::optional<double> smallest_radius = {};  ///< default: smallest_radius_share of the surface
  std::optional<double> largest_radius = {};   ///< default: largest_radius_share of the surface
  std::optional<Sphere> within = {};           ///< only vertices inside this ball are considered
  std::size_t resamples = 0;  ///< fits to resampled parts of the surface, for a bound on the centre
};

/// A spherical part of a surface.
struct SphericalPatch {
  SphereFit fit;
  double coverage;  ///< its area over that of the whole sphere; a femoral head has 0.6 to 0.8
  /// Bound of the centre, mm: 95 % of fits to resampled parts lie within. Set if resamples were requested.
  std::optional<double> centre_bound_mm = {};
};

/// The spherical part of a surface: the head that covers most of its sphere, or the socket with most supporting area, by
/// how well its normals point to the centre. Found without a hint, fitted only to the vertices of that part.
/// Deterministic. Only surface that faces the outside is considered: no piece of it inside another. Throws MeshError if no part of the
/// surface is spherical: at least a tenth of a sphere, spread in all directions (no strip, as where a sphere touches a cylinder from
/// inside), 12 vertices or more.
[[nodiscard]] SphericalPatch find_sphere(const Mesh& mesh, const SphereSearch& search = {});

struct Cylinder {
  Vec3 point;      ///< on the axis, nearest the centroid of the vertices used
  Vec3 direction;  ///< unit; of its two senses the one whose largest component is positive
  double radius;
};

struct CylinderFit {
  Cylinder cylinder;
  double rms_residual;          ///< of the distance to the axis minus the radius, mm
  double largest_residual;      ///< its largest magnitude, mm
  std::vector<Index> vertices;  ///< used, ascending
  double coverage = 0;          ///< the share of a turn about the axis in which there are vertices
  /// Bounds of the direction, and of the axis beside its point, mm: 95 % of fits to resampled parts lie within. Set
  /// by find_cylinder().
  std::optional<Angle> direction_bound = {};
  std::optional<double> axis_bound_mm = {};
};

/// The cylinder near `start` that minimises the sum of squared distances of these points to it. Throws
/// MeshError if the points leave it undetermined (fewer than five, or all on one line or plane).
[[nodiscard]] CylinderFit fit_cylinder(PointsView points, std::span<const Index> vertices,
                                       const Cylinder& start);

/// Parts of one surface that give axes farther apart give no axis.
inline constexpr Angle largest_direction_bound = Angle::degrees(15);

/// Where a cylindrical part is looked for. Lengths in mm.
struct CylinderSearch {
  double smallest_radius = 5;
  double largest_radius = 45;
  std::optional<Sphere> within = {};  ///< only vertices inside this ball are considered
};

/// The cylindrical part of a surface that has most area for its radius squared (the angle around the axis
/// times the length in radii, so that a long and full one wins): found without a hint, fitted only to the
/// vertices of that part. On a whole long bone that is its shaft: limit the search to the condyles to get
/// those, and inside a ball the part with most area is taken and may be as imperfect as a talar dome, whose residuals
/// are a twentieth of its radius. Deterministic. Only surface that faces the outside is considered. Throws MeshError if no part of the
/// surface is cylindrical, or where its parts do not agree on a direction within largest_direction_bound.
[[nodiscard]] CylinderFit find_cylinder(const Mesh& mesh, const CylinderSearch& search = {});

}  // namespace condyle
