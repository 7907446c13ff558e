#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "condyle/normal_depth.hpp"
#include "mesh/ray_hits.hpp"

namespace condyle::contact {

/// Rays from a surface along its negative normals, neighbours behind each other: from the centre of each face, or from its corners.
/// A vertex has one ray where the surface is smooth about it, and one for each side of a crease.
class CastingRays {
 public:
  CastingRays(const Mesh& casting, FaceRule rule);

  /// The surface has deformed: `casting` is the mesh now, and the marks, one for each vertex, say which have moved; without marks,
  /// all. False if there are more rays than before, where a crease has come; those of one that has gone stay, without a corner.
  bool update(const Mesh& casting, std::span<const char> is_moved);

  std::span<const mesh::Ray> inward() const noexcept { return inward_; }
  std::size_t size() const noexcept { return inward_.size(); }
  /// Whether a corner has this ray, or a face.
  bool is_used(std::size_t ray) const noexcept { return is_used_[ray]; }
  /// The face, or the vertex, that a ray starts from.
  Index owner(std::size_t ray) const noexcept { return owner_[ray]; }
  /// Outward, of length 1, of the surface where the ray starts.
  Vec3 normal(std::size_t ray) const noexcept { return -inward_[ray].direction; }
  /// With face centres: the ray of a face, or no_index.
  Index of_centre(Index face) const noexcept { return centre_ray_[face]; }
  /// With cut faces: the rays of a face's corners; any of a face without area.
  const std::array<Index, 3>& of_corners(Index face) const noexcept { return corner_ray_[face]; }

  std::size_t faces() const noexcept { return face_area_.size(); }
  double face_area(Index face) const noexcept { return face_area_[face]; }
  double longest_edge(Index face) const noexcept { return longest_edge_[face]; }
  /// Outward, of length 1; zero of a face without area.
  std::span<const Vec3> face_normals() const noexcept { return face_normal_; }

 private:
  void make_rays(const Mesh& casting);
  void make_centre_rays(const Mesh& casting);
  void make_corner_rays(const Mesh& casting);
  void measure_face(const TriMesh& casting, Index face);
  mesh::Ray centre_ray(const TriMesh& casting, Index face) const;
  /// Whether faces with area around a vertex meet at no crease.
  bool is_smooth_at(std::span<const Index> around) const;
  /// take(face, corner, normal) for each face with area around a vertex: the mean of the normals of the faces around it on that
  /// face's side of any crease, weighted by angles, of length 1. Corners on one side have the same normal, to the bit.
  void visit_corner_normals(const TriMesh& casting, std::span<const Index> around, Index vertex,
                            const auto& take) const;
  /// Whether a vertex has the rays that it had; moves them.
  struct SideOfCrease;
  bool move_corner_rays(const TriMesh& casting, std::span<const Index> around, Index vertex,
                        std::vector<SideOfCrease>& sides);
  /// Where a crease has come or gone: the vertex's rays, used before or not, and new ones where those do not suffice.
  void share_out_corner_rays(const TriMesh& casting, std::span<const Index> around, Index vertex);
  void add_ray(Index owner, const mesh::Ray& ray);
  bool update_centre_rays(const Mesh& casting, std::span<const Index> faces);
  bool update_corner_rays(const Mesh& casting, std::span<const Index> faces);

  FaceRule rule_;
  std::vector<double> face_area_;
  std::vector<Vec3> face_normal_;
  std::vector<double> longest_edge_;
  std::vector<std::array<double, 3>> corner_angle_;  ///< radians; with cut faces
  std::vector<Index> owner_;
  std::vector<mesh::Ray> inward_;
  std::vector<char> is_used_;
  /// With cut faces: the last ray of a vertex, and of a ray the one before it of the same vertex; no_index at the end.
  std::vector<Index> last_ray_, ray_before_;
  std::vector<Index> centre_ray_;
  std::vector<std::array<Index, 3>> corner_ray_;
};

}  // namespace condyle::contact
