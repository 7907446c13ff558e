#pragma once

#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// Small closed meshes with known geometry, all wound outwards.

namespace condyle::test {

/// Axis-aligned box, 8 vertices, 12 triangles.
TriMesh box(const Vec3& low, const Vec3& high);

/// A flat square of side 2 half about the origin, normal +y, in n x n squares cut in two: an open sheet.
TriMesh plane(double half, int n);

/// Octahedron split 1-to-4 `levels` times, vertices laid on the sphere about `centre`. Its vertices include
/// the six axis points; flat triangles sag inside the sphere by at most edge^2 / (8 radius).
TriMesh sphere(const Vec3& centre, double radius, int levels);

/// Thick hemispherical shell on the side y > 0 of `centre`, open towards -y: a socket. Outer radius `outer`,
/// inner radius `inner`, closed, genus 0.
TriMesh socket(const Vec3& centre, double inner, double outer, int levels);

/// Ring torus about +z.
TriMesh torus(double major, double minor, int around, int across);

/// Both meshes as one, not welded.
TriMesh joined(const TriMesh& a, const TriMesh& b);

/// Wound the other way.
TriMesh flipped(TriMesh mesh);

/// The mesh with its vertices in the coordinates of the axis.
TriMesh in_axis_frame(const AxisFrame& axis, TriMesh mesh);

}  // namespace condyle::test
