#include "mesh/label_surface/bone_components.hpp"

#include <algorithm>

#include "condyle/inspect.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle::mesh {

std::size_t drop_components(Contour& contour, const PieceChoice& choice) {
  std::vector<bool> kept;
  std::vector<std::size_t> of_triangle;
  {
    const Mesh mesh(contour.mesh);
    const SurfacePieces& pieces = pieces_of(mesh);
    if (pieces.all.size() < 2) return 0;
    kept = kept_pieces(pieces, choice);
    of_triangle = pieces.of_triangle;
  }
  const auto dropped = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), false));
  if (dropped == 0) return 0;
  TriMesh& mesh = contour.mesh;
  std::size_t next = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!kept[of_triangle[t]]) continue;
    mesh.triangles[next] = mesh.triangles[t];
    contour.cap[next++] = contour.cap[t];
  }
  mesh.triangles.resize(next);
  contour.cap.resize(next);
  drop_unreferenced_vertices(mesh);
  return dropped;
}

}  // namespace condyle::mesh
