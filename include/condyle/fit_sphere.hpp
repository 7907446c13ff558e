#pragma once

#include <optional>
#include <span>
#include <vector>

#include "condyle/mesh.hpp"

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

/// Which side of the sphere the solid is on: inside (a head) or outside (a socket). Told by the winding: of a
/// mesh wound inside out, heads are sockets.
enum class SphericalPart { head, socket };

/// Where a spherical part is looked for. Lengths in mm.
struct SphereSearch {
  SphericalPart part = SphericalPart::head;
  double smallest_radius = 10;  ///< heads of children's femora and of adult humeri lie well inside
  double largest_radius = 45;
  std::optional<Sphere> within = {};  ///< only vertices inside this ball are considered
};

/// A spherical part of a surface.
struct SphericalPatch {
  SphereFit fit;
  double coverage;  ///< its area over that of the whole sphere; a femoral head has 0.6 to 0.8
};

/// The spherical part of a surface that covers most of its sphere: found without a hint, fitted to the
/// vertices of that part alone. Deterministic. Throws MeshError where no part of the surface is spherical: at
/// least a tenth of a sphere, spread in all directions (no strip, as where a sphere touches a cylinder from
/// inside), 12 vertices or more.
SphericalPatch find_sphere(const TriMesh& mesh, const SphereSearch& search = {});

}  // namespace condyle
