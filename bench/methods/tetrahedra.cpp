#include "tetrahedra.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <cmath>
#include <limits>

#include "mesh/surface_distance.hpp"
#include "mesh/winding_number.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::PointState;
using condyle::Vec3;

double mean_edge(const condyle::TriMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) sum += (mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)).norm();
  return sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

/// In [-1, 1], without a pattern: the bits of a cell's number, stirred.
double stirred(std::uint64_t number) noexcept {
  number = (number ^ number >> 31) * 0x9e3779b97f4a7c15u;
  number = (number ^ number >> 29) * 0xbf58476d1ce4e5b9u;
  return static_cast<double>(number >> 11) * 0x1p-52 - 1;
}

/// Points of a cubic lattice that are inside and at least 0.75 and less than `most` of its spacing from the
/// surface. Each is moved a little: a perfect lattice has no one Delaunay triangulation.
void add_lattice(const condyle::mesh::WindingNumber& winding, const condyle::mesh::SurfaceDistance& distance,
                 const Vec3& low, const Vec3& high, double spacing, double most, condyle::Points& out) {
  constexpr double least = 0.75, shift = 0.1;
  condyle::Points lattice;
  std::uint64_t number = 0;
  for (double z = low.z(); z < high.z(); z += spacing)
    for (double y = low.y(); y < high.y(); y += spacing)
      for (double x = low.x(); x < high.x(); x += spacing, number += 3) {
        const Vec3 moved(stirred(number), stirred(number + 1), stirred(number + 2));
        lattice.push_back(Vec3(x, y, z) + shift * spacing * moved);
      }
  const auto windings = winding.at(lattice);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    if (windings[i].state != PointState::inside) continue;
    const double depth = distance(lattice[i]);
    if (depth >= least * spacing && depth < most * spacing) out.push_back(lattice[i]);
  }
}

/// Spacings of twice the mesh's edges, four times and so on, each where the surface is as far as that.
void add_inner_points(const condyle::TriMesh& mesh, const condyle::mesh::WindingNumber& winding,
                      condyle::Points& out) {
  Vec3 low = mesh.vertices[0], high = low;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    low = low.cwiseMin(mesh.vertices[v]), high = high.cwiseMax(mesh.vertices[v]);
  const condyle::mesh::SurfaceDistance distance(mesh);
  constexpr int levels = 4;
  double spacing = 2 * mean_edge(mesh);
  for (int level = 0; level < levels; ++level, spacing *= 2) {
    const double most = level + 1 < levels ? 1.5 : std::numeric_limits<double>::infinity();
    add_lattice(winding, distance, low, high, spacing, most, out);
  }
}

}  // namespace

double TetMesh::mean_edge_mm() const {
  double sum = 0;
  for (const auto& t : tetrahedra)
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) sum += (vertices[t[i]] - vertices[t[j]]).norm();
  return sum / (6.0 * static_cast<double>(tetrahedra.size()));
}

TetMesh filled(const condyle::TriMesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>;
  using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex>,
                                                  CGAL::Fast_location>;
  const condyle::mesh::WindingNumber winding(mesh);
  TetMesh out{mesh.vertices, {}};
  add_inner_points(mesh, winding, out.vertices);

  std::vector<std::pair<Kernel::Point_3, Index>> points;
  points.reserve(out.vertices.size());
  for (Index v = 0; v < out.vertices.size(); ++v)
    points.emplace_back(Kernel::Point_3(out.vertices.x[v], out.vertices.y[v], out.vertices.z[v]), v);
  const Delaunay delaunay(points.begin(), points.end());

  condyle::Points centroids;
  for (const auto cell : delaunay.finite_cell_handles()) {
    std::array<Index, 4> corners;
    for (int k = 0; k < 4; ++k) corners[k] = cell->vertex(k)->info();
    out.tetrahedra.push_back(corners);
    centroids.push_back(0.25 * (out.vertices[corners[0]] + out.vertices[corners[1]] +
                                out.vertices[corners[2]] + out.vertices[corners[3]]));
  }
  const auto windings = winding.at(centroids);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < windings.size(); ++t)
    if (windings[t].state == PointState::inside) out.tetrahedra[kept++] = out.tetrahedra[t];
  out.tetrahedra.resize(kept);
  return out;
}

}  // namespace bench
