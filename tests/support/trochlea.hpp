#pragma once

#include "condyle/angle.hpp"
#include "condyle/mesh.hpp"
#include "support/test.hpp"

namespace condyle::test {

/// A block whose top is part of a cylinder about the z axis, as the trochlea of a talus is: `arc` of a turn about +y,
/// from z = -length / 2 to length / 2, flat sides and ends, a neck-like taper below. `off(turn, z)` is added to the
/// radius of the top. Edges are about `edge` long. Closed.
///
///        . - ~ - .        y
///      /           \      ^
///     |    axis     |     |
///      \     +     /      +--> x
///       |         |
///       |_________|
inline TriMesh trochlea(double radius, double length, Angle arc, double edge,
                        const std::function<double(double, double)>& off) {
  const double half = arc.radians() / 2;
  // The outline, counter-clockwise seen from +z; the top's part is given by angles, the rest by corners.
  struct Place {
    double x, y, turn;
    bool top;
  };
  std::vector<Place> outline;
  const int steps = std::max(2, static_cast<int>(std::lround(radius * arc.radians() / edge)));
  for (int i = 0; i <= steps; ++i) {
    const double turn = -half + 2 * half * i / steps;
    outline.push_back({-radius * std::sin(turn), radius * std::cos(turn), turn, true});
  }
  const auto line_to = [&](double x, double y) {
    const Place from = outline.back();
    const int pieces = std::max(1, static_cast<int>(std::lround(std::hypot(x - from.x, y - from.y) / edge)));
    for (int i = 1; i <= pieces; ++i)
      outline.push_back({from.x + (x - from.x) * i / pieces, from.y + (y - from.y) * i / pieces, 0, false});
  };
  const double wide = 0.7 * radius;
  line_to(-wide, -0.2 * radius);
  line_to(-wide, -0.8 * radius);
  line_to(wide, -0.8 * radius);
  line_to(wide, -0.2 * radius);
  line_to(radius * std::sin(half), radius * std::cos(half));
  outline.pop_back();  // where it began

  TriMesh mesh;
  const int around = static_cast<int>(outline.size());
  const int along = std::max(2, static_cast<int>(std::lround(length / edge)));
  const int rings = std::max(2, static_cast<int>(std::lround(radius / edge)));
  const auto add_ring = [&](double z, double scale) {
    for (const Place& p : outline) {
      const double grown = p.top ? (radius + off(p.turn, z)) / radius : 1;
      mesh.vertices.push_back({scale * grown * p.x, scale * grown * p.y, z});
    }
  };
  for (int ring = 1; ring <= rings; ++ring) add_ring(-length / 2, 1.0 * ring / rings);
  for (int slice = 1; slice <= along; ++slice) add_ring(length * (1.0 * slice / along - 0.5), 1);
  for (int ring = rings - 1; ring >= 1; --ring) add_ring(length / 2, 1.0 * ring / rings);
  const int all = 2 * rings + along - 1;
  const auto vertex = [&](int ring, int k) { return static_cast<Index>(ring * around + k % around); };
  for (int ring = 0; ring + 1 < all; ++ring)
    for (int k = 0; k < around; ++k) {
      mesh.triangles.push_back({vertex(ring, k), vertex(ring, k + 1), vertex(ring + 1, k + 1)});
      mesh.triangles.push_back({vertex(ring, k), vertex(ring + 1, k + 1), vertex(ring + 1, k)});
    }
  for (const int end : {0, all - 1}) {
    const auto middle = static_cast<Index>(mesh.vertices.size());
    mesh.vertices.push_back({0, 0, end == 0 ? -length / 2 : length / 2});
    for (int k = 0; k < around; ++k) {
      const Index a = vertex(end, k), b = vertex(end, k + 1);
      mesh.triangles.push_back(end == 0 ? Triangle{middle, b, a} : Triangle{middle, a, b});
    }
  }
  return mesh;
}

}  // namespace condyle::test
