#pragma once

#include <optional>
#include <vector>

#include "condyle/fit.hpp"

/// What the searches for spherical and cylindrical parts read of a mesh: its vertices with normals and areas.

namespace condyle::kinematics {

/// One vertex of the searched part of a surface.
struct SurfacePoint {
  Index vertex;
  Vec3 position;
  Vec3 normal;  ///< unit; mean of the triangles around it, weighted by area
  double area;  ///< a third of the triangles around it
};

/// The vertices of a mesh that lie inside `within` and belong to triangles with an area (and not so large a
/// one that it overflows), ascending.
std::vector<SurfacePoint> surface_points(const TriMesh& mesh, const std::optional<Sphere>& within);

/// Of the chosen vertices, those of the largest part (by area) that is connected by mesh edges between chosen
/// vertices. `chosen` holds positions in `points`, ascending, and so does the answer.
std::vector<Index> largest_connected_part(const TriMesh& mesh, const std::vector<SurfacePoint>& points,
                                          const std::vector<Index>& chosen);

/// The mesh's numbers of some of the points.
std::vector<Index> vertices_of(const std::vector<SurfacePoint>& points, const std::vector<Index>& chosen);

/// 1.4826 times the median magnitude: the standard deviation of a normal distribution, given by the better
/// half of the residuals and deaf to the rest.
double robust_deviation(std::vector<double> residuals);

}  // namespace condyle::kinematics
