#pragma once

#include <cmath>

#include "condyle/inspect.hpp"
#include "core/ordered_sums.hpp"

namespace condyle::mesh {

/// Such a triangle is a point or runs along an edge and back: it has no sides of its own.
inline bool names_a_vertex_twice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// A sum that carries its rounding errors along (Neumaier): as good as one in twice the precision.
class CompensatedSum {
 public:
  void add(double value) {
    const double sum = sum_ + value;
    error_ += std::abs(sum_) >= std::abs(value) ? (sum_ - sum) + value : (value - sum) + sum_;
    sum_ = sum;
  }
  double value() const { return sum_ + error_; }

 private:
  double sum_ = 0, error_ = 0;
};

/// Bounds of the triangles; the origin where there are none.
BoundingBox bounds_of_surface(const TriMesh& mesh);

/// Around all vertices, those of no triangle among them; a point if there are none.
BoundingBox bounds_of_vertices(const TriMesh& mesh);

/// Signed volume of the tetrahedron from p to a triangle. From the centre of the bounds the terms are small,
/// and a mesh far from the origin loses nothing.
inline double volume_below(const TriMesh& mesh, std::size_t triangle, const Vec3& p) {
  const Vec3 a = mesh.corner(triangle, 0) - p, b = mesh.corner(triangle, 1) - p,
             c = mesh.corner(triangle, 2) - p;
  return core::ordered_dot(a, b.cross(c)) / 6;
}

/// Volume that a closed mesh encloses; negative where it is inverted.
double enclosed_volume(const TriMesh& mesh);

/// Whether that is negative. A plain sum decides mostly; the sign of a two-sided mesh is rounding. Linear.
bool is_inside_out(const TriMesh& mesh);

}  // namespace condyle::mesh
