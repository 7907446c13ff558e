#include "kinematics/surface_sag.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/trigonometry.hpp"
#include "mesh/edge_table.hpp"

namespace condyle::kinematics {
namespace {

/// The share of edges that sag more.
constexpr std::size_t one_in = 10;

}  // namespace

double surface_sag_mm(const Mesh& mesh, const Vec3& about, double within_mm) {
  const mesh::EdgeTable& edges = mesh::edges_of(mesh);
  std::vector<double> sags;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.half_edges(e);
    const Vec3 p = mesh.vertices()[edges.ends(e)[0]], q = mesh.vertices()[edges.ends(e)[1]];
    if (sides.size() != 2 || ((p + q) / 2 - about).norm() > within_mm) continue;
    const auto area = [&](mesh::HalfEdge h) {
      const Vec3 a = mesh.corner(h / 3, 0);
      return Vec3((mesh.corner(h / 3, 1) - a).cross(mesh.corner(h / 3, 2) - a));
    };
    const Vec3 a = area(sides[0]), b = area(sides[1]);
    const double length = (q - p).norm();
    if (!(length > 0)) continue;
    // Heights of both triangles over the edge; half of them is between their middles.
    const double chord = (a.norm() + b.norm()) / (2 * length);
    sags.push_back(chord * core::arctangent(a.cross(b).norm(), a.dot(b)) / 8);
  }
  if (sags.empty()) return 0;
  const auto nth = sags.begin() + static_cast<std::ptrdiff_t>((sags.size() - 1) - (sags.size() - 1) / one_in);
  std::nth_element(sags.begin(), nth, sags.end());
  return *nth;
}

}  // namespace condyle::kinematics
