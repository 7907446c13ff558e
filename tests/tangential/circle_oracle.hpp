#pragma once

#include <vector>

#include "condyle/mesh.hpp"

/// The tangential method without table, order or filter: all triangles, plane by plane.

namespace condyle::test {

/// A piece of a point's circle between two places where it may meet the surface, and the winding number in
/// its middle.
struct CirclePiece {
  double begin, end;  ///< Radians from the point, 0 <= begin < end.
  int winding;        ///< Winding number of the middle, in rational arithmetic.
};

/// The circle of a point about z, cut where it meets a plane of any triangle within 1e-6 of that triangle.
/// The circle is taken 1e-13 lower and 1e-10 smaller than the point's: where it passes exactly through
/// vertices, along edges or within faces of a lattice mesh that is what the library's infinitely small shift
/// decides.
std::vector<CirclePiece> circle_pieces(const TriMesh& mesh, const Vec3& point);

/// The point rotated about z, by an angle in radians.
Vec3 rotated(const Vec3& point, double angle);

}  // namespace condyle::test
