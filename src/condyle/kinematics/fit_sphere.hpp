#pragma once

#include <optional>
#include <span>
#include <vector>

#include "condyle/mesh/tri_mesh.hpp"

/// The centre of a ball joint, from the surface of its head.

namespace condyle {

struct Sphere {
  Vec3 centre;
  double radius;
};

struct SphereFit {
  Sphere sphere;
  double rms_residual;          ///< of |vertex - centre| - radius, mm
  double largest_residual;      ///< its largest magnitude, mm
  std::vector<Index> vertices;  ///< used, ascending
};

/// The sphere that minimises the sum of squared distances of these points to it. Throws MeshError where fewer
/// than four points, or points (nearly) in one plane, leave it undetermined.
SphereFit fit_sphere(PointsView points, std::span<const Index> vertices);
SphereFit fit_sphere(PointsView points);

/// Where a spherical part is looked for. Lengths in mm.
struct SphereSearch {
  double smallest_radius = 10;  ///< heads of children's femora and of adult humeri lie well inside
  double largest_radius = 45;
  std::optional<Sphere> within;  ///< only vertices inside this ball are considered
};

/// The best spherical part of a surface: found without a hint, fitted to the vertices of that part alone.
/// Deterministic. Throws MeshError where no part of the surface is spherical.
SphereFit find_sphere(const TriMesh& mesh, const SphereSearch& search = {});

}  // namespace condyle
