#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "condyle/pose.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::mesh {

struct Ray {
  Vec3 origin, direction;  ///< of length 1
};

/// A surface made ready for rays: a tree in which eight boxes, or eight triangles, are held against a ray at once.
class RayTarget {
 public:
  explicit RayTarget(const TriMesh& mesh);

  /// The surface has deformed: TriangleTree::refit(). A worn tree is made anew.
  void update(const TriMesh& mesh, std::span<const char> is_moved = {});

  const TriangleTree& tree() const noexcept { return tree_; }

  static constexpr std::size_t width = 8;
  static_assert(width >= TriangleTree::leaf_triangles);

  struct alignas(64) Boxes {
    float centre[3][width] = {}, half[3][width] = {};
    Index below[width] = {};  ///< the number of what a box holds
    unsigned used = 0;        ///< the lanes with a box, one bit each
  };
  /// Three generations of the tree of triangles.
  struct Branch {
    Boxes boxes;
    unsigned leaves = 0;     ///< the lanes that hold a leaf; the others hold branches
    Index node[width] = {};  ///< of the tree, of each lane
  };
  /// Triangles; lanes beyond the last have none that a ray could meet.
  struct alignas(64) Leaf {
    double corner[3][3][width] = {};  ///< by corner and coordinate
    double normal[3][width] = {};     ///< twice the area along the normal
    double flat[width] = {};          ///< a normal less than this along a ray is seen from the side
    double number[width] = {};        ///< in the mesh; exact as a double
    Index first = 0, count = 0;       ///< places of the triangles in the tree
  };
  const std::vector<Branch>& branches() const noexcept { return branches_; }
  const std::vector<Leaf>& leaves() const noexcept { return leaves_; }
  Index leaf_of(Index mesh_triangle) const noexcept { return leaf_of_[mesh_triangle]; }
  float size() const noexcept { return size_; }  ///< the largest coordinate

 private:
  void build();
  void measure_size();
  void set_boxes(Branch& branch) const;
  void set_triangles(Leaf& leaf) const;
  Index add_branch(Index node);
  Index add_leaf(const TriangleTree::Node& node);

  TriangleTree tree_;
  std::vector<Branch> branches_;
  std::vector<Leaf> leaves_;
  std::vector<Index> leaf_of_;
  float size_ = 0;
};

/// The first triangle along each ray, within a reach.
struct RayHits {
  std::vector<double> distance;  ///< mm, >= 0; infinite if nothing is met
  std::vector<Index> triangle;   ///< of the target's mesh; no_index if nothing is met

  bool is_hit(std::size_t ray) const noexcept { return triangle[ray] != no_index; }

  std::vector<RayTarget::Boxes> leaves;  ///< nearest_hits()' own, kept for the next question
};

/// The nearest hit of each ray, given in R, with the target, at 0 <= distance <= reach; X_TR is the pose of the rays' frame in
/// the target's. If several triangles are met at one distance the one of the lowest number counts. Fast if rays that
/// follow each other start near each other and run alike: eight rays share one search for the triangles that they may
/// meet.
///
/// A ray sees the mesh as a plane figure: each vertex is turned into two coordinates, rounded, the same ones in all its
/// triangles; and of the areas that decide on which side of an edge the ray passes none has a wrong sign, and zero counts as
/// inside (Woop et al., Journal of Computer Graphics Techniques 2, 2013). So no ray slips between triangles, at edges or at
/// vertices. Triangles seen at less than 1e-9 radians are not met. Distances are rounded to some 1e-15 of the coordinates over
/// the cosine between ray and normal. The same bits on every instruction set.
///
/// `first` may name a triangle for each ray that it is likely to meet: the answers are the same, and sooner found.
void nearest_hits(const RayTarget& target, const Pose& X_TR, std::span<const Ray> rays, double reach,
                  RayHits& out, std::span<const Index> first = {});

}  // namespace condyle::mesh
