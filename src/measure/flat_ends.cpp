#include "measure/flat_ends.hpp"

#include <algorithm>
#include <map>

#include "mesh/disjoint_sets.hpp"
#include "mesh/edge_table.hpp"

namespace condyle::measure {
namespace {

/// mm^2: the shaft of a small femur has 150, and a face that cuts off less of a rim moves no measure.
constexpr double least_area = 60;
/// The face of a coarse mesh may be one triangle or two.
constexpr std::size_t fewest_vertices = 8;
/// ... in faces of which each has as much: triangles that lie in one plane and share edges.
constexpr double least_face = 15;
/// Cosine of the 0.3 degrees between neighbours of one face: vertices in floats turn triangles a tenth of a millimetre high by less.
constexpr double one_plane = 1 - 1.4e-5;

Vec3 twice_area(const TriMesh& mesh, std::size_t t) {
  const Vec3 a = mesh.corner(t, 0);
  return (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a);
}

struct Face {
  Vec3 area = Vec3::Zero(), point = Vec3::Zero();
};

/// Connected triangles that face one way, those with an area that counts.
std::vector<Face> flat_faces(const Mesh& bone, const std::vector<Vec3>& areas) {
  const mesh::EdgeTable& edges = mesh::edges_of(bone);
  mesh::DisjointSets sets(areas.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.half_edges(e);
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const Index a = sides[0] / 3, b = sides[k] / 3;
      if (areas[a].dot(areas[b]) > one_plane * areas[a].norm() * areas[b].norm()) sets.join(a, b);
    }
  }
  std::map<Index, Face> faces;
  for (std::size_t t = 0; t < areas.size(); ++t) {
    Face& face = faces[sets.find(static_cast<Index>(t))];
    face.area += areas[t] / 2;
    face.point = bone.corner(t, 0);
  }
  std::vector<Face> large;
  for (const auto& numbered : faces)
    if (numbered.second.area.norm() >= least_face) large.push_back(numbered.second);
  return large;
}

bool lies_behind(const TriMesh& bone, const ImageCut& plane) {
  return std::all_of(bone.triangles.begin(), bone.triangles.end(), [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](Index v) {
      return plane.normal.dot(bone.vertices[v]) - plane.offset_mm < on_cut_mm;
    });
  });
}

bool is_large(const TriMesh& bone, const std::vector<Vec3>& areas, const ImageCut& plane) {
  const std::vector<ImageCut> cut{plane};
  double area = 0;
  std::vector<Index> corners;
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const Triangle& triangle = bone.triangles[t];
    if (!std::all_of(triangle.begin(), triangle.end(),
                     [&](Index v) { return is_on_cut(cut, bone.vertices[v]); }))
      continue;
    area += areas[t].norm() / 2;
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return area >= least_area && corners.size() >= fewest_vertices;
}

}  // namespace

std::vector<ImageCut> flat_ends(const Mesh& bone) {
  std::vector<Vec3> areas(bone.triangles().size());
  for (std::size_t t = 0; t < areas.size(); ++t) areas[t] = twice_area(bone, t);
  std::vector<ImageCut> ends;
  for (const Face& face : flat_faces(bone, areas)) {
    const Vec3 normal = face.area.normalized();
    const ImageCut plane{normal, normal.dot(face.point)};
    const bool is_known = std::any_of(
        ends.begin(), ends.end(), [&](const ImageCut& end) { return end.normal.dot(normal) > one_plane; });
    if (!is_known && lies_behind(bone, plane) && is_large(bone, areas, plane)) ends.push_back(plane);
  }
  return ends;
}

}  // namespace condyle::measure
