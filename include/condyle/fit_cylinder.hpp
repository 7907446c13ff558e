#pragma once

#include <optional>
#include <span>
#include <vector>

#include "condyle/fit_sphere.hpp"

/// The axis of a hinge, from the surface that turns about it.

namespace condyle {

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
};

/// The cylinder near `start` that minimises the sum of squared distances of these points to it. Throws
/// MeshError where the points leave it undetermined (fewer than five, or all on one line or plane).
CylinderFit fit_cylinder(PointsView points, std::span<const Index> vertices, const Cylinder& start);

/// Where a cylindrical part is looked for. Lengths in mm.
struct CylinderSearch {
  double smallest_radius = 5;
  double largest_radius = 45;
  std::optional<Sphere> within = {};  ///< only vertices inside this ball are considered
};

/// The cylindrical part of a surface that has most area for its radius squared (the angle around the axis
/// times the length in radii, so that a long and full one wins): found without a hint, fitted to the vertices
/// of that part alone. On a whole long bone that is its shaft: limit the search to the condyles to get those.
/// Deterministic. Throws MeshError where no part of the surface is cylindrical.
CylinderFit find_cylinder(const TriMesh& mesh, const CylinderSearch& search = {});

}  // namespace condyle
