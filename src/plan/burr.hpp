#pragma once

#include <vector>

#include "mesh/triangle_tree.hpp"
#include "mesh/vertex_triangles.hpp"
#include "plan/cut_surface.hpp"

namespace condyle::plan {

/// A ball that makes what is left of a bone: every point of a cut is touched by one that enters no bone.
///
///        |     |                 |     |         The ball that touches the bottom of a groove is to fit between its
///        |     |    becomes     .       .        flanks: they go as far as it needs. From the deepest point upwards,
///        |__.__|                 ` - - ´         so that what is made already is not made again for a flank.
///
/// To within tolerance_mm and what triangles of a ball's hollow lack of it.
class Burr {
 public:
  /// The surface and the mesh that it came from must outlive this.
  Burr(CutSurface& surface, double radius_mm);

  static constexpr double tolerance_mm = 0.01;

  /// Lowers the surface. False if bone that is not near must go first: `elsewhere`.
  bool make();
  /// Where that is, on the surface before.
  const std::vector<Place>& elsewhere() const noexcept { return elsewhere_; }
  /// By how much a ball enters bone that stays, at the most.
  double in_kept_mm() const noexcept { return in_kept_mm_; }

 private:
  struct Ball;
  struct Around;
  bool make_once();
  Around in_ball(const Vec3& centre) const;
  Ball freest(const Vec3& p, const Vec3& outwards) const;
  void lower_into(const Ball& ball, const Need& need);

  CutSurface& surface_;
  double radius_;
  mesh::TriangleTree before_, tree_;
  mesh::VertexTriangles triangles_of_;
  std::vector<std::uint8_t> near_;  ///< of the triangles
  std::vector<std::uint8_t> made_,
      moved_;  ///< of the vertices: touched by a ball that is free; lowered in this round
  std::vector<Place> elsewhere_;
  double in_kept_mm_ = 0;
};

}  // namespace condyle::plan
