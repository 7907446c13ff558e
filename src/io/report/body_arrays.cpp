#include "io/report/body_arrays.hpp"

namespace condyle::io {

std::vector<double> interleaved(PointsView points) {
  std::vector<double> xyz;
  xyz.reserve(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    xyz.insert(xyz.end(), {points.x[i], points.y[i], points.z[i]});
  return xyz;
}

std::vector<std::uint32_t> corners_of(const Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * mesh.triangles().size());
  for (const Triangle& triangle : mesh.triangles())
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  return corners;
}

void add_body(BlockArrays& arrays, const std::string& role, const Mesh& mesh) {
  arrays.add(role + "_vertices", interleaved(mesh.vertices().view()));
  arrays.add(role + "_triangles", corners_of(mesh));
}

}  // namespace condyle::io
