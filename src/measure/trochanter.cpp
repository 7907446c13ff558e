#include "measure/trochanter.hpp"

#include <limits>

namespace condyle::measure {
namespace {

/// Share of the way to the shaft's axis, and how far beyond it a top must lie, mm.
constexpr double trochanter_begins = 0.7, least_beyond = 1;
/// In radii of the head: a shaft under the head has no side.
constexpr double least_offset = 0.3;

}  // namespace

TrochanterFinding greater_trochanter(const TriMesh& femur, const Sphere& head, const ShaftAxis& shaft,
                                     const std::vector<char>& ends) {
  const Vec3 to_line = shaft.point - head.centre;
  const Vec3 across = to_line - to_line.dot(shaft.direction) * shaft.direction;
  const double offset = across.norm();
  if (!(offset >= least_offset * head.radius)) return {{}, 0, "the shaft's axis passes through the head"};
  const Vec3 side = across / offset;
  TrochanterFinding found;
  bool is_end = false;
  double highest = -std::numeric_limits<double>::infinity(), beyond = 0;
  for (const Triangle& t : femur.triangles)
    for (const Index v : t) {
      const Vec3 p = femur.vertices[v] - head.centre;
      const double height = -p.dot(shaft.direction), out = p.dot(side) - trochanter_begins * offset;
      if (out < 0 || height <= highest) continue;
      highest = height, beyond = out, found.top = femur.vertices[v], is_end = ends[v];
    }
  if (!found.top || beyond < by_head(least_beyond, head))
    return {{}, 0, "no greater trochanter rises beside the neck"};
  if (is_end) return {{}, 0, "the mesh ends at the greater trochanter"};
  found.height_mm = highest;
  return found;
}

}  // namespace condyle::measure
