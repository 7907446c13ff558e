#pragma once

#include <memory>

#include "condyle/core/pose.hpp"
#include "condyle/mesh/tri_mesh.hpp"

namespace bench {

/// Two bodies in the Flexible Collision Library, each in a hierarchy of OBBRSS volumes (an oriented box and a
/// rectangle swept by a sphere), with its default splitting: what the library uses for meshes. In double.
class FclObbrss {
 public:
  FclObbrss(const condyle::TriMesh& fixed, const condyle::TriMesh& mobile);
  ~FclObbrss();
  FclObbrss(const FclObbrss&) = delete;
  FclObbrss& operator=(const FclObbrss&) = delete;

  /// Whether the surfaces touch: its boolean query, which ends at the first pair of triangles found. Decided
  /// in floating point with tolerances of its own.
  bool touch(const condyle::Pose& X_FM) const;

 private:
  struct Models;
  std::unique_ptr<Models> models_;
};

}  // namespace bench
