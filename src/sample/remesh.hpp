#pragma once

#include <functional>

#include "condyle/mesh.hpp"
#include "sample/field.hpp"

namespace condyle::sample {

/// Wanted edge length at a point, up to one common factor: 0.5 asks for edges half as long as 1.
using Sizing = std::function<double(const Vec3&)>;

/// A mesh of the same solid with exactly `vertex_count` vertices, all of them laid on the surface, triangles
/// near equilateral, same genus. The start must be closed and manifold, its vertices near the surface.
///
/// Isotropic remeshing (Botsch and Kobbelt 2004) with a common edge length chosen for the count: split long
/// edges, collapse short ones, flip towards larger smallest angles, move vertices towards the centroid of
/// their neighbours along the surface. What is still missing or too much is split or collapsed one by one,
/// then only flips and moves follow. Sequential, ties in order of vertex numbers: the same input gives the
/// same bytes.
///
/// Raises MeshError when the count cannot be reached without folding a triangle over.
TriMesh remeshed(const TriMesh& start, const Field& solid, const Sizing& sizing, std::size_t vertex_count);

/// A few vertices more, up to `vertex_count`: the relatively longest edges split, then flips and one sweep of
/// moves.
TriMesh refined(const TriMesh& mesh, const Field& solid, const Sizing& sizing, std::size_t vertex_count);

/// Area of a mesh in units of the square of the sizing at each place: the number of triangles it needs, up to
/// a factor.
double sized_area(const TriMesh& mesh, const Sizing& sizing);

}  // namespace condyle::sample
