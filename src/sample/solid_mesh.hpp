#pragma once

#include "condyle/mesh.hpp"
#include "sample/remesh.hpp"

namespace condyle::sample {

/// How a solid is meshed.
struct Meshing {
  Sizing sizing;
  /// Lattice spacing of the first contour, mm: below half of the thinnest part.
  double contour_spacing;
  /// Triangles that the coarsest mesh worth subdividing has.
  std::size_t least_base;
};

/// A closed, outward-wound mesh of the solid with exactly `triangles` triangles, its vertices on the surface.
/// The genus g is that of the solid at the contour's spacing; triangles must be even.
///
/// A base mesh is remeshed from the contour; finer meshes are its 1-to-4 subdivisions, every midpoint laid on
/// the surface, and where the count is no such multiple, the longest edges are split until it is reached.
/// Meshes of 4 N triangles hence hold the vertices of those of N. Raises MeshError when no such mesh is
/// found.
TriMesh meshed(const Solid& solid, const Meshing& meshing, std::size_t triangles);

/// The even number of triangles that makes edges about `edge_length` long, in mm, where the sizing is 1.
std::size_t triangles_for(const Solid& solid, const Meshing& meshing, double edge_length);

/// Genus of a closed manifold connected mesh: handles, 0 for a sphere, 1 for a ring.
int genus(const TriMesh& mesh);

}  // namespace condyle::sample
