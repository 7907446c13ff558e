#pragma once

#include <array>
#include <functional>
#include <initializer_list>
#include <vector>

#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// Small closed meshes with known geometry, all wound outwards, and what is done to meshes.

namespace condyle::test {

/// A mesh written out.
TriMesh mesh_of(std::initializer_list<Vec3> vertices, std::vector<Triangle> triangles);

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

/// The solid that a profile (distance from Z, height along Z) sweeps about Z, wound outwards if the solid is on the left of the
/// way; first and last point on the axis, all others off it.
TriMesh turned_solid(const std::vector<std::array<double, 2>>& profile, Index around);

/// Both meshes as one, not welded.
TriMesh joined(const TriMesh& a, const TriMesh& b);
void append(TriMesh& all, const TriMesh& mesh);

/// Wound the other way.
TriMesh flipped(TriMesh mesh);

/// The mesh with each vertex where `place` has it.
TriMesh mapped(TriMesh mesh, const std::function<Vec3(const Vec3&)>& place);
TriMesh scaled_by(const TriMesh& mesh, double factor);
/// By a rotation or a mirror, wound outwards still.
TriMesh turned(const TriMesh& mesh, const Eigen::Matrix3d& by);
TriMesh shifted_by(const TriMesh& mesh, const Vec3& by);

/// Coordinates rounded to floats, and one of them -0.
TriMesh in_floats(TriMesh mesh);

/// Largest distance between vertices of one number.
double farthest(const PointsView& a, const PointsView& b);

/// The mesh with its vertices in the coordinates of the axis.
TriMesh in_axis_frame(const AxisFrame& axis, TriMesh mesh);

}  // namespace condyle::test
