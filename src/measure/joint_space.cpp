#include "measure/joint_space.hpp"

#include <algorithm>
#include <vector>

#include "measure/near_part.hpp"
#include "mesh/ray_hits.hpp"

namespace condyle::measure {
namespace {

/// In radii of the head: farther out the femur is not its head.
constexpr double farthest_head = 1.3;
/// Rays that must meet the head.
constexpr double least_share = 0.5;

std::vector<double> vertex_areas(const TriMesh& mesh) {
  std::vector<double> areas(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0);
    const double third = (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm() / 6;
    for (const Index v : mesh.triangles[t]) areas[v] += third;
  }
  return areas;
}

double median_of(std::vector<std::pair<double, double>> gap_and_area) {
  std::sort(gap_and_area.begin(), gap_and_area.end());
  double all = 0, below = 0;
  for (const auto& one : gap_and_area) all += one.second;
  for (const auto& one : gap_and_area) {
    below += one.second;
    if (below >= all / 2) return one.first;
  }
  return 0;
}

}  // namespace

JointSpaceFinding joint_space(const Bones& bones, const Sphere& head, const std::vector<Index>& socket) {
  if (socket.empty()) return {{}, "the hip bone shows no socket's sphere around the head"};
  const double reach = farthest_head * head.radius;
  // The wall of a cavity in the head, as of marrow that is not filled, faces the centre.
  const TriMesh near = averted_part(bones.femur, {head.centre, reach}).mesh;
  std::vector<mesh::Ray> rays;
  for (const Index v : socket)
    rays.push_back({head.centre, (bones.hip_bone.vertices[v] - head.centre).normalized()});
  mesh::RayHits hits;
  mesh::nearest_hits(mesh::RayTarget(near), Pose::Identity(), rays, reach, hits);
  const std::vector<double> areas = vertex_areas(bones.hip_bone);
  std::vector<std::pair<double, double>> gaps;
  std::optional<JointSpace> space;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits.is_hit(i)) continue;
    const Vec3 wall = bones.hip_bone.vertices[socket[i]];
    const double gap = (wall - head.centre).norm() - hits.distance[i];
    gaps.emplace_back(gap, areas[socket[i]]);
    if (!space || gap < space->least_mm)
      space = JointSpace{gap, 0, {wall, head.centre + hits.distance[i] * rays[i].direction}};
  }
  if (!space || static_cast<double>(gaps.size()) < least_share * static_cast<double>(rays.size()))
    return {{}, "the head does not face its socket"};
  space->median_mm = median_of(std::move(gaps));
  return {space, {}};
}

}  // namespace condyle::measure
