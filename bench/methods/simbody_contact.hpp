#pragma once

#include <array>
#include <memory>
#include <vector>

/// Simbody behind plain C++17: two of its headers' comparisons are ambiguous in C++20.

namespace bench {

/// Three coordinates a vertex, three vertices a triangle.
struct PlainMesh {
  std::vector<double> coordinates;
  std::vector<int> corners;
};

/// Two bodies as Simbody's contact meshes.
class SimbodyContact {
 public:
  SimbodyContact(const PlainMesh& fixed, const PlainMesh& mobile);
  ~SimbodyContact();

  /// Rows of the mobile body's pose in the fixed one's frame: rotation and translation.
  using PoseRows = std::array<std::array<double, 4>, 3>;

  /// Mobile triangles that are partly or wholly inside the fixed body, ascending. Reused by the next call.
  const std::vector<int>& buried_mobile_triangles(const PoseRows& X_FM);

  struct Nearest {
    bool is_inside;
    int triangle;
    double distance;
  };
  /// Nearest point of the fixed surface.
  Nearest nearest(const std::array<double, 3>& point) const;

 private:
  struct Meshes;
  std::unique_ptr<Meshes> meshes_;
};

}  // namespace bench
