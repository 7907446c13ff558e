#include "measure/bone_pieces.hpp"

#include <algorithm>
#include <vector>

#include "core/formatted.hpp"
#include "mesh/edge_table.hpp"

namespace condyle::measure {
namespace {

double area_of(const TriMesh& mesh, std::size_t t) {
  const Vec3 a = mesh.corner(t, 0);
  return (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm() / 2;
}

/// Gives all pieces that were cut from each other the number of the first of them.
void join_cut_pieces(const Mesh& bone, const std::vector<char>& cut, std::vector<Index>& of_triangle,
                     std::size_t count) {
  std::vector<char> is_cut(count);
  for (std::size_t t = 0; t < of_triangle.size(); ++t)
    for (const Index v : bone.triangles()[t]) is_cut[of_triangle[t]] |= cut[v];
  const auto first = static_cast<Index>(std::find(is_cut.begin(), is_cut.end(), 1) - is_cut.begin());
  for (Index& piece : of_triangle)
    if (is_cut[piece]) piece = first;
}

}  // namespace

OwnPieces own_pieces(const Mesh& bone, const std::string& name, const Sphere& ball,
                     const std::vector<char>& cut, const PieceVote& vote) {
  mesh::ConnectedComponents pieces = mesh::edges_of(bone).components();
  const std::size_t count = pieces.first_triangle.size();
  if (count < 2) return {bone, {}};
  if (!cut.empty()) join_cut_pieces(bone, cut, pieces.of_triangle, count);
  std::vector<double> votes(count), areas(count);
  std::vector<char> is_near(count);
  for (std::size_t t = 0; t < bone.triangles().size(); ++t) {
    const Index piece = pieces.of_triangle[t];
    votes[piece] += vote(t), areas[piece] += area_of(bone, t);
    for (const Index v : bone.triangles()[t])
      is_near[piece] |= (bone.vertices()[v] - ball.centre).squaredNorm() < ball.radius * ball.radius;
  }
  const auto own = static_cast<std::size_t>(std::max_element(votes.begin(), votes.end()) - votes.begin());
  is_near[own] = false;
  const auto others = static_cast<std::size_t>(std::count(is_near.begin(), is_near.end(), 1));
  if (others == 0) return {bone, {}};
  TriMesh rest{bone.vertices(), {}};
  double all = 0, left = 0;
  for (std::size_t t = 0; t < bone.triangles().size(); ++t)
    if (!is_near[pieces.of_triangle[t]]) rest.triangles.push_back(bone.triangles()[t]);
  for (std::size_t piece = 0; piece < count; ++piece) {
    all += areas[piece];
    if (is_near[piece]) left += areas[piece];
  }
  return {Mesh(std::move(rest)),
          core::formatted("%s has %zu other piece%s near the head, %.2g %% of its surface: left out",
                          name.c_str(), others, others == 1 ? "" : "s", 100 * left / all)};
}

}  // namespace condyle::measure
