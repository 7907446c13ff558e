#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "condyle/pose.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::mesh {

/// Rays in bundles of eight, which look for their hits together: fast where rays that follow each other start near each
/// other and run alike.
class RayBundles {
 public:
  static constexpr std::size_t width = 8;

  void clear() noexcept { size_ = 0, bundles_.clear(); }
  /// Directions of length 1.
  void push_back(const Vec3& origin, const Vec3& direction);
  Vec3 origin(std::size_t ray) const { return lane(bundles_[ray / width].origin, ray % width); }
  Vec3 direction(std::size_t ray) const { return lane(bundles_[ray / width].direction, ray % width); }
  /// After the last ray and before the first question. A bundle that is not full repeats its last ray.
  void close();

  std::size_t size() const noexcept { return size_; }

  struct alignas(64) Bundle {
    std::array<std::array<double, width>, 3> origin, direction;
    Vec3 axis;  ///< the mean direction
  };
  const std::vector<Bundle>& bundles() const noexcept { return bundles_; }

 private:
  static Vec3 lane(const std::array<std::array<double, width>, 3>& of, std::size_t at) {
    return {of[0][at], of[1][at], of[2][at]};
  }

  std::size_t size_ = 0;
  std::vector<Bundle> bundles_;
};

/// A surface made ready for rays.
class RayTarget {
 public:
  explicit RayTarget(const TriMesh& mesh);

  const TriangleTree& tree() const noexcept { return tree_; }

  /// A ball that holds a triangle, by its place in the tree, widened by what its centre and radius round.
  struct Ball {
    std::array<float, 3> centre;
    float radius;
  };
  const std::vector<Ball>& balls() const noexcept { return balls_; }
  /// By places: twice the area along the normal, and how long that is.
  const std::vector<Vec3>& normals() const noexcept { return normals_; }
  const std::vector<double>& normal_lengths() const noexcept { return normal_lengths_; }
  Index place_of(Index mesh_triangle) const noexcept { return place_of_[mesh_triangle]; }
  float size() const noexcept { return size_; }  ///< the largest coordinate

 private:
  TriangleTree tree_;
  std::vector<Ball> balls_;
  std::vector<Vec3> normals_;
  std::vector<double> normal_lengths_;
  std::vector<Index> place_of_;
  float size_ = 0;
};

/// The first triangle along each ray, within a reach; padded to whole bundles.
struct RayHits {
  std::vector<double> distance;  ///< mm, >= 0; infinite where nothing is met
  std::vector<Index> triangle;   ///< of the target's mesh; no_index where nothing is met

  bool is_hit(std::size_t ray) const noexcept { return triangle[ray] != no_index; }
};

/// The nearest hit of each ray, given in R, with the target, at 0 <= distance <= reach; X_TR is the pose of the rays' frame in
/// the target's. Of triangles met at one distance the one of the lowest number counts.
///
/// A ray sees the mesh as a plane figure: each vertex is turned into two coordinates, rounded, the same ones in all its
/// triangles; and of the areas that decide on which side of an edge the ray passes none has a wrong sign, and zero counts as
/// inside (Woop et al., Journal of Computer Graphics Techniques 2, 2013). So no ray slips between triangles, at edges or at
/// vertices. Triangles seen at less than 1e-9 radians are not met. Distances are rounded to some 1e-15 of the coordinates over
/// the cosine between ray and normal. The same bits on every instruction set.
///
/// `first` may name a triangle for each ray that it is likely to meet: the answers are the same, and sooner found.
void nearest_hits(const RayTarget& target, const Pose& X_TR, const RayBundles& rays, double reach,
                  RayHits& out, std::span<const Index> first = {});

}  // namespace condyle::mesh
