#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "condyle/radial.hpp"
#include "condyle/tangential.hpp"
#include "contact/body_pair.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/winding_number.hpp"
#include "method.hpp"

/// Reference for every method's answer.

namespace bench {

/// Exact answers for one fixed body. Whether a vertex is inside comes from the winding number along +z: exact
/// arithmetic, and no code in common with the tables. Pairs are those of the two bodies' trees with the exact
/// test of two triangles. The tests of the repository hold both against CGAL's exact predicates, and
/// CGAL is among the methods here.
class Reference {
 public:
  Reference(const Bodies& bodies, std::vector<condyle::Pose> poses);

  struct Inside {
    condyle::Index vertex;
    bool is_on_surface;
  };

  /// All vertices inside or on the surface, ascending. Made when first asked for, like all here.
  const std::vector<Inside>& inside(std::size_t pose);

  /// How deep each of `inside` is, mm. Along the ray and the arc by the plain tables; otherwise the nearest
  /// point of the surface.
  const std::vector<double>& depths(std::size_t pose, DepthKind kind);

  /// How deep the bodies are in each other: between these bounds, which are 0.01 mm apart at most, is the distance of the
  /// deepest place of either surface from the other one. Found by dividing triangles: signed distances differ by no more
  /// than the points they are taken at are apart.
  struct DepthBounds {
    double low_mm = 0, high_mm = 0;
  };
  DepthBounds depth(std::size_t pose);

  /// Ascending.
  const std::vector<condyle::contact::TrianglePair>& pairs(std::size_t pose);

 private:
  condyle::Points inside_points(std::size_t pose);
  const condyle::mesh::SurfaceDistance& distance();

  const condyle::TriMesh* fixed_;
  const condyle::TriMesh* mobile_;
  std::vector<condyle::Pose> poses_;
  condyle::mesh::WindingNumber winding_;
  condyle::radial::RadialTable radial_;
  condyle::contact::BodyPair pair_;
  std::unique_ptr<condyle::tangential::RingTable> rings_;
  std::unique_ptr<condyle::mesh::SurfaceDistance> distance_;
  /// Made when the depth of the bodies is first asked for.
  std::unique_ptr<condyle::mesh::WindingNumber> mobile_winding_;
  std::unique_ptr<condyle::mesh::SurfaceDistance> mobile_distance_;
  std::map<std::size_t, std::vector<Inside>> inside_;
  std::map<std::pair<std::size_t, DepthKind>, std::vector<double>> depths_;
  std::map<std::size_t, std::vector<condyle::contact::TrianglePair>> pairs_;
};

}  // namespace bench
