#pragma once

#include <optional>
#include <vector>

#include "contact/body_pair.hpp"
#include "contact/triangle_pairs.hpp"
#include "condyle/radial.hpp"

namespace condyle {

/// Everything about two bodies in one pose, by the radial method.
struct RadialContact {
  /// Every mobile vertex against the fixed body; empty where the fixed mesh is open.
  std::optional<RadialResults> mobile_in_fixed;
  /// Every fixed vertex against the mobile body; empty where the mobile mesh is open.
  std::optional<RadialResults> fixed_in_mobile;
  /// The exact set of intersecting triangle pairs, ascending.
  std::vector<TrianglePair> pairs;
  /// Whether the bodies share a point: surfaces that meet, or one body wholly inside the other.
  bool in_contact = false;
};

/// A fixed and a mobile body, each in its own frame with the joint centre as origin, and their tables, built
/// once.
///
/// A pose rounds coordinates: mobile vertices into F, fixed vertices into M. Every answer is the exact one
/// for the vertices so rounded, each into the frame of the table it is asked of.
class JointContact {
 public:
  /// Raises MeshError, naming the body, where the origin lies on a surface.
  JointContact(const Mesh& fixed, const Mesh& mobile, RadialOptions options = {});

  /// Vertices of both bodies, all pairs, and whether they touch. X_FM need not be a pure rotation: the fixed
  /// body is seen from the centre of F, the mobile one from the centre of M.
  RadialContact radial(const Pose& X_FM) const;

  /// The exact set of intersecting triangle pairs alone; open meshes too.
  std::vector<TrianglePair> pairs(const Pose& X_FM) const;

  const Mesh& fixed() const noexcept { return fixed_mesh_; }
  const Mesh& mobile() const noexcept { return mobile_mesh_; }
  const RadialTable& fixed_table() const noexcept { return fixed_; }
  const RadialTable& mobile_table() const noexcept { return mobile_; }
  /// The two surfaces, for "do they touch" alone.
  const contact::BodyPair& bodies() const noexcept { return bodies_; }

 private:
  Mesh fixed_mesh_, mobile_mesh_;
  RadialTable fixed_, mobile_;
  contact::BodyPair bodies_;
};

}  // namespace condyle
