#include "mesh/enclosed_volume.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include "core/lazy.hpp"
#include "core/predicates.hpp"
#include "mesh/findings.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::mesh {
namespace {

struct KeptSense {
  core::Lazy<bool> is_inside_out;
};

}  // namespace

BoundingBox bounds_of_surface(const TriMesh& mesh) {
  if (mesh.triangles.empty()) return {Vec3::Zero(), Vec3::Zero()};
  std::vector<char> is_used(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (const Index v : t) is_used[v] = true;
  BoundingBox bounds{mesh.corner(0, 0), mesh.corner(0, 0)};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_used[v]) continue;
    bounds.low = bounds.low.cwiseMin(mesh.vertices[v]);
    bounds.high = bounds.high.cwiseMax(mesh.vertices[v]);
  }
  return bounds;
}

BoundingBox bounds_of_vertices(const TriMesh& mesh) {
  const Points& points = mesh.vertices;
  if (points.size() == 0) return {Vec3::Zero(), Vec3::Zero()};
  BoundingBox box{points[0], points[0]};
  for (std::size_t v = 0; v < points.size(); ++v) {
    box.low = box.low.cwiseMin(points[v]);
    box.high = box.high.cwiseMax(points[v]);
  }
  return box;
}

double enclosed_volume(const TriMesh& mesh) {
  const BoundingBox bounds = bounds_of_surface(mesh);
  const Vec3 centre = (bounds.low + bounds.high) / 2;
  CompensatedSum volume;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!names_a_vertex_twice(mesh.triangles[t])) volume.add(volume_below(mesh, t, centre));
  }
  return volume.value();
}

/// Coordinates from the centre of the box are at most its half h, so each product of three at most h_x h_y h_z, and rounded eight times; six make a
/// term, and a plain sum of n terms t is off by at most n u sum |t|. The compensated sum, of other terms, is off by less: hence twice. The box is in
/// single precision, a little wider.
bool is_inside_out(const Mesh& mesh) {
  return findings_of(mesh).get<KeptSense>().is_inside_out.get([&](bool& is) {
    const std::shared_ptr<const TriangleTree> tree = tree_of(mesh);
    if (tree->empty()) return;
    const TriangleTree::Node& root = tree->nodes()[0];
    const Vec3 centre(root.centre[0], root.centre[1], root.centre[2]);
    double volume = 0, sizes = 0;
    for (Index t = 0; t < tree->triangles().size(); ++t) {
      const double term = volume_below(tree->corners(t), centre);
      volume += term, sizes += std::abs(term);
    }
    const double of_each = 8 * Vec3(root.half[0], root.half[1], root.half[2]).prod();
    const double bound =
        2 * static_cast<double>(tree->triangles().size()) * core::rounding_unit * (of_each + sizes);
    is = std::abs(volume) > bound + core::filter_floor ? volume < 0 : enclosed_volume(mesh) < 0;
  });
}

}  // namespace condyle::mesh
