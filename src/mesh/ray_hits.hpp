#pragma once

#include <array>
#include <cstddef>
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
  /// After the last ray and before the first question. A bundle that is not full repeats its last ray.
  void close();

  std::size_t size() const noexcept { return size_; }

  struct alignas(64) Bundle {
    std::array<std::array<double, width>, 3> origin, direction;
    Vec3 axis;  ///< the mean direction
  };
  const std::vector<Bundle>& bundles() const noexcept { return bundles_; }

 private:
  std::size_t size_ = 0;
  std::vector<Bundle> bundles_;
};

/// The first triangle along each ray, within a reach; padded to whole bundles.
struct RayHits {
  std::vector<double> distance;  ///< mm, >= 0; infinite where nothing is met
  std::vector<Index> triangle;   ///< of the mesh the tree was built from; no_index where nothing is met

  bool is_hit(std::size_t ray) const noexcept { return triangle[ray] != no_index; }
};

/// The nearest hit of each ray, given in R, with the tree's surface, at 0 <= distance <= reach; X_TR is the pose of the
/// rays' frame in the tree's. Of triangles met at one distance the one of the lowest number counts.
///
/// A ray sees the mesh as a plane figure: each vertex is turned into two coordinates, rounded, the same ones in all its
/// triangles; and of the areas that decide on which side of an edge the ray passes none has a wrong sign, and zero counts as
/// inside (Woop et al., Journal of Computer Graphics Techniques 2, 2013). So no ray slips between triangles, at edges or at
/// vertices. Triangles seen at less than 1e-9 radians are not met. Distances are rounded to some 1e-15 of the coordinates over
/// the cosine between ray and normal. The same bits on every instruction set.
void nearest_hits(const TriangleTree& tree, const Pose& X_TR, const RayBundles& rays, double reach,
                  RayHits& out);

}  // namespace condyle::mesh
