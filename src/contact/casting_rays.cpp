#include "contact/casting_rays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "contact/along_rays.hpp"
#include "core/parallel.hpp"
#include "core/trigonometry.hpp"
#include "mesh/triangle_tree.hpp"
#include "mesh/vertex_triangles.hpp"

namespace condyle::contact {
namespace {

/// Faces that meet at a larger angle than this meet at a crease: each side has its own normals there.
const double crease_cosine = core::cosine(40 * std::numbers::pi / 180);

/// Faces within half of that angle of one of them are within all of it of each other, whatever is rounded.
const double smooth_cosine = core::cosine(20 * std::numbers::pi / 180) + 1e-9;

/// Faces, or vertices, that a thread takes at once: some tens of microseconds.
constexpr std::size_t grain = 512;

/// The face of a cube that a normal points to. Rays of one side after those of another: the two sides of a thin layer lie
/// so near each other that rays in the order of places alone would run both ways in one bundle.
int side_of(const Vec3& normal) {
  Eigen::Index axis;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * static_cast<int>(axis) + (normal[axis] < 0 ? 1 : 0);
}

/// The elements that are marked, or all if there are no marks.
std::vector<Index> numbers_of(std::size_t count, const auto& is_taken) {
  std::vector<Index> numbers;
  for (Index i = 0; i < count; ++i)
    if (is_taken(i)) numbers.push_back(i);
  return numbers;
}

}  // namespace

struct CastingRays::SideOfCrease {
  Index ray;
  Vec3 normal;
};

CastingRays::CastingRays(const Mesh& casting, FaceRule rule)
    : rule_(rule),
      face_area_(casting.triangles().size()),
      face_normal_(casting.triangles().size()),
      longest_edge_(casting.triangles().size()),
      corner_angle_(rule == FaceRule::cut_faces ? casting.triangles().size() : 0) {
  core::parallel_chunks(faces(), grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t face = first; face < last; ++face) measure_face(casting, static_cast<Index>(face));
  });
  make_rays(casting);
}

void CastingRays::measure_face(const TriMesh& casting, Index face) {
  const Vec3 area = area_vector(casting, face);
  face_area_[face] = area.norm();
  face_normal_[face] = unit(area);
  const std::array<Vec3, 3> p = {casting.corner(face, 0), casting.corner(face, 1), casting.corner(face, 2)};
  longest_edge_[face] = std::max({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()});
  if (rule_ != FaceRule::cut_faces) return;
  for (std::size_t k = 0; k < 3; ++k) corner_angle_[face][k] = angle_at(p, k);
}

void CastingRays::make_rays(const Mesh& casting) {
  last_ray_.assign(rule_ == FaceRule::cut_faces ? casting.vertices().size() : 0, no_index);
  if (rule_ == FaceRule::face_centre)
    make_centre_rays(casting);
  else
    make_corner_rays(casting);
}

mesh::Ray CastingRays::centre_ray(const TriMesh& casting, Index face) const {
  return {(casting.corner(face, 0) + casting.corner(face, 1) + casting.corner(face, 2)) / 3,
          -face_normal_[face]};
}

void CastingRays::make_centre_rays(const Mesh& casting) {
  std::vector<Index> order;
  for (const Index face : mesh::tree_of(casting)->mesh_triangles())
    if (face_area_[face] > 0) order.push_back(face);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return side_of(face_normal_[a]) < side_of(face_normal_[b]); });
  centre_ray_.assign(faces(), no_index);
  for (const Index face : order) {
    centre_ray_[face] = static_cast<Index>(size());
    add_ray(face, centre_ray(casting, face));
  }
}

bool CastingRays::is_smooth_at(std::span<const Index> around) const {
  const auto are_near = [&](Index a, Index b, double cosine) {
    return face_area_[a] == 0 || face_area_[b] == 0 || face_normal_[a].dot(face_normal_[b]) >= cosine;
  };
  const auto first =
      std::find_if(around.begin(), around.end(), [&](Index face) { return face_area_[face] > 0; });
  if (std::all_of(first, around.end(), [&](Index face) { return are_near(face, *first, smooth_cosine); }))
    return true;
  for (auto a = first; a != around.end(); ++a)
    if (!std::all_of(first, a, [&](Index b) { return are_near(*a, b, crease_cosine); })) return false;
  return true;
}

void CastingRays::visit_corner_normals(const TriMesh& casting, std::span<const Index> around, Index vertex,
                                       const auto& take) const {
  const auto has_area = [&](Index face) { return face_area_[face] > 0; };
  const auto on_one_side = [&](Index a, Index b) {
    return face_normal_[a].dot(face_normal_[b]) >= crease_cosine;
  };
  const auto mean_normal = [&](const auto& counts) {
    Vec3 sum = Vec3::Zero();
    for (const Index face : around) {
      if (!counts(face)) continue;
      for (std::size_t k = 0; k < 3; ++k)
        if (casting.triangles[face][k] == vertex) sum += corner_angle_[face][k] * face_normal_[face];
    }
    return unit(sum);
  };
  const bool is_smooth = is_smooth_at(around);
  const Vec3 of_all = is_smooth ? mean_normal(has_area) : Vec3::Zero();
  for (const Index face : around) {
    if (!has_area(face)) continue;
    const Vec3 normal =
        is_smooth ? of_all : mean_normal([&](Index other) { return on_one_side(other, face); });
    for (std::size_t k = 0; k < 3; ++k)
      if (casting.triangles[face][k] == vertex) take(face, k, normal);
  }
}

void CastingRays::make_corner_rays(const Mesh& casting) {
  const mesh::VertexTriangles& around = mesh::triangles_at_vertices_of(casting);
  std::vector<std::array<Vec3, 3>> normals(faces());
  core::parallel_chunks(casting.vertices().size(), grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto vertex = static_cast<Index>(i);
      visit_corner_normals(casting, around.of(vertex), vertex,
                           [&](Index face, std::size_t k, const Vec3& n) { normals[face][k] = n; });
    }
  });
  corner_ray_.assign(faces(), {0, 0, 0});
  struct VertexRay {
    Index vertex;
    Vec3 normal;
  };
  std::vector<VertexRay> rays;
  for (const Index vertex : mesh::tree_of(casting)->mesh_vertices()) {
    const std::size_t first = rays.size();
    for (const Index face : around.of(vertex)) {
      if (face_area_[face] == 0) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        if (casting.triangles()[face][k] != vertex) continue;
        std::size_t ray = first;
        while (ray < rays.size() && rays[ray].normal != normals[face][k]) ++ray;
        if (ray == rays.size()) rays.push_back({vertex, normals[face][k]});
        corner_ray_[face][k] = static_cast<Index>(ray);
      }
    }
  }
  std::vector<Index> order(rays.size()), place(rays.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return side_of(rays[a].normal) < side_of(rays[b].normal); });
  for (const Index ray : order) {
    const auto& [vertex, n] = rays[ray];
    place[ray] = static_cast<Index>(size());
    add_ray(vertex, {casting.vertices()[vertex], -n});
  }
  for (Index face = 0; face < faces(); ++face)
    if (face_area_[face] > 0)
      for (Index& ray : corner_ray_[face]) ray = place[ray];
}

bool CastingRays::move_corner_rays(const TriMesh& casting, std::span<const Index> around, Index vertex,
                                   std::vector<SideOfCrease>& sides) {
  sides.clear();
  bool are_same = true;
  visit_corner_normals(casting, around, vertex, [&](Index face, std::size_t k, const Vec3& n) {
    const Index ray = corner_ray_[face][k];
    bool is_known = false;
    for (const SideOfCrease& side : sides) {
      are_same = are_same && (side.ray == ray) == (side.normal == n);
      is_known = is_known || side.ray == ray;
    }
    if (!is_known) sides.push_back({ray, n});
  });
  for (const auto& [ray, n] : sides) are_same = are_same && owner_[ray] == vertex && is_used_[ray];
  std::size_t used = 0;
  for (Index ray = last_ray_[vertex]; ray != no_index; ray = ray_before_[ray]) used += is_used_[ray] != 0;
  are_same = are_same && used == sides.size();
  if (are_same)
    for (const auto& [ray, n] : sides) inward_[ray] = {casting.vertices[vertex], -n};
  return are_same;
}

void CastingRays::share_out_corner_rays(const TriMesh& casting, std::span<const Index> around, Index vertex) {
  std::vector<Index> rays;
  for (Index ray = last_ray_[vertex]; ray != no_index; ray = ray_before_[ray]) rays.push_back(ray);
  for (const Index ray : rays) is_used_[ray] = false;
  std::vector<Index> used;
  visit_corner_normals(casting, around, vertex, [&](Index face, std::size_t k, const Vec3& n) {
    auto ray = std::find_if(used.begin(), used.end(), [&](Index known) { return normal(known) == n; });
    if (ray == used.end()) {
      if (rays.empty()) {
        add_ray(vertex, {});
        rays.push_back(last_ray_[vertex]);
      }
      ray = used.insert(used.end(), rays.back());
      rays.pop_back();
      inward_[*ray] = {casting.vertices[vertex], -n}, is_used_[*ray] = true;
    }
    corner_ray_[face][k] = *ray;
  });
}

void CastingRays::add_ray(Index owner, const mesh::Ray& ray) {
  const auto number = static_cast<Index>(size());
  owner_.push_back(owner), inward_.push_back(ray), is_used_.push_back(true);
  if (rule_ == FaceRule::cut_faces) ray_before_.push_back(std::exchange(last_ray_[owner], number));
}

bool CastingRays::update(const Mesh& casting, std::span<const char> is_moved) {
  const auto& triangles = casting.triangles();
  const std::vector<Index> moved_faces = numbers_of(faces(), [&](Index face) {
    const auto& [a, b, c] = triangles[face];
    return is_moved.empty() || is_moved[a] || is_moved[b] || is_moved[c];
  });
  core::parallel_chunks(moved_faces.size(), grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) measure_face(casting, moved_faces[i]);
  });
  return rule_ == FaceRule::face_centre ? update_centre_rays(casting, moved_faces)
                                        : update_corner_rays(casting, moved_faces);
}

bool CastingRays::update_centre_rays(const Mesh& casting, std::span<const Index> moved_faces) {
  const std::size_t before = size();
  for (const Index face : moved_faces) {
    Index& ray = centre_ray_[face];
    if (ray == no_index) {
      if (face_area_[face] == 0) continue;
      ray = static_cast<Index>(size());
      add_ray(face, {});
    }
    is_used_[ray] = face_area_[face] > 0;
    if (is_used_[ray]) inward_[ray] = centre_ray(casting, face);
  }
  return size() == before;
}

bool CastingRays::update_corner_rays(const Mesh& casting, std::span<const Index> moved_faces) {
  const std::size_t before = size();
  const mesh::VertexTriangles& around = mesh::triangles_at_vertices_of(casting);
  std::vector<char> is_at_moved(casting.vertices().size());
  for (const Index face : moved_faces)
    for (const Index v : casting.triangles()[face]) is_at_moved[v] = true;
  const std::vector<Index> vertices = numbers_of(is_at_moved.size(), [&](Index v) { return is_at_moved[v]; });
  std::vector<char> has_other_rays(vertices.size());
  core::parallel_chunks(vertices.size(), grain, [&](std::size_t first, std::size_t last) {
    std::vector<SideOfCrease> sides;
    for (std::size_t i = first; i < last; ++i)
      has_other_rays[i] = !move_corner_rays(casting, around.of(vertices[i]), vertices[i], sides);
  });
  // New rays get their numbers in the order of vertices, whichever threads found them.
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (has_other_rays[i]) share_out_corner_rays(casting, around.of(vertices[i]), vertices[i]);
  return size() == before;
}

}  // namespace condyle::contact
