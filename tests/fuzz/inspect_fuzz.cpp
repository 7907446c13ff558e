#include <cmath>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/inspect.hpp"
#include "fuzz/fuzz_input.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"
#include "support/brute_force.hpp"

namespace condyle::test {
namespace {

bool share_vertex(const TriMesh& mesh, std::size_t i, std::size_t j) {
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) {
      if (mesh.corner(i, k) == mesh.corner(j, l)) return true;
    }
  }
  return false;
}

/// Triangles of non-zero area that share a point and no vertex, pair by pair.
std::size_t count_crossings(const TriMesh& mesh) {
  std::vector<std::size_t> triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_degenerate(mesh, t)) triangles.push_back(t);
  }
  const auto corners = [&](std::size_t t) {
    return std::array{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      const std::size_t a = triangles[i], b = triangles[j];
      count += !share_vertex(mesh, a, b) && triangles_intersect(corners(a), corners(b));
    }
  }
  return count;
}

std::size_t count_degenerate(const TriMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) count += is_degenerate(mesh, t);
  return count;
}

}  // namespace

std::string fuzz_inspect(std::string_view bytes) {
  FuzzInput input(bytes);
  try {
    const Mesh mesh = input.mesh();
    const MeshReport report = inspect(mesh);
    if (report.triangles != mesh.triangles().size()) return "another number of triangles";
    if (report.is_closed() != mesh.is_closed()) return "closed for one, open for the other";
    if (report.degenerate_triangles.count != count_degenerate(mesh)) return "degenerate triangles miscounted";
    if (report.self_crossings.count != count_crossings(mesh)) return "self-crossings miscounted";
    if (!std::isfinite(report.area)) return "an area that is not finite";
    if (report.signed_volume && !std::isfinite(*report.signed_volume)) return "a volume that is not finite";
    if (report.boundary_edges.count > 0 && describe_boundary(report).empty())
      return "a boundary without words";
  } catch (const MeshError& error) {
    return fault_of_message(error.what());
  }
  return {};
}

}  // namespace condyle::test
