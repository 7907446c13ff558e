#pragma once

#include <string>
#include <vector>

#include "condyle/fit.hpp"

namespace condyle::measure {

/// Fineness of a spherical part of a surface.
struct SurfaceGrain {
  double edge_mm = 0;  ///< mean, over its area, of its triangles' longest edges
  /// Standard deviation by which each vertex is off what its neighbours are from the centre: 0 on a sphere of any triangles.
  double roughness_mm = 0;
};

/// Grain of the triangles whose corners are all among the vertices. Linear in the mesh.
SurfaceGrain grain_of(const TriMesh& mesh, const std::vector<Index>& vertices, const Vec3& centre);

/// Triangles longer than this cut off of a rim and of a contour what a measure of theirs depends on, mm: on sample hips with longer ones
/// centre-edge angles are off by up to 5.6 degrees and alpha by 2.5, with shorter ones by 0.7.
inline constexpr double coarse_edge_mm = 4;
/// Vertices that stray by more leave a circle by the tolerance of an alpha angle here and there, mm.
inline constexpr double rough_mm = 0.15;

/// Caveat of alpha angles of such a head; empty if there is none.
std::string alpha_grain_note(const SurfaceGrain& head, double radius);

}  // namespace condyle::measure
