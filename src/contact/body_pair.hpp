#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "condyle/contact.hpp"
#include "contact/reaching.hpp"
#include "core/lazy.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::contact {

/// Two bodies made ready to be asked, at any pose, whether and where they touch: a tree on each. Built once.
///
/// Every answer is exact for the vertices of M as `posed` rounds them into F. A pose that turns about the
/// origin of both frames is answered fastest; any other is answered right.
class BodyPair {
 public:
  BodyPair(const Mesh& fixed, const Mesh& mobile);

  /// A body has deformed: its mesh now, moved from the one before, and a mark for each vertex that says whether it has moved; without
  /// marks, all have. Its tree is refitted, or made anew where it is worn.
  void update(BodyRole body, const Mesh& mesh, std::span<const char> is_moved = {});

  /// Whether the bodies share a point: surfaces that meet (touching counts; triangles of zero area meet
  /// nothing), or one body inside the other's solid, where that one is closed.
  ///
  /// Ends at the first pair of triangles found. `last_witness` is asked first and becomes that pair: along a
  /// motion the next pose mostly touches there too. It changes how long the answer takes, never the answer.
  bool touch(const Pose& X_FM, std::optional<TrianglePair>& last_witness) const;
  bool touch(const Pose& X_FM) const;

  /// The exact set of intersecting triangle pairs, ascending; open meshes too. One thread.
  std::vector<TrianglePair> pairs(const Pose& X_FM) const;

  /// Which triangles of a body have a point inside the other's solid, or on it: those of `pairs`, and all that lie inside as a whole, which
  /// meet none. Exact as pairs(), but that triangles without area may be among them, and what they lead to.
  /// The other body has to be closed.
  Reaching reaching(BodyRole body, const Pose& X_FM, std::span<const TrianglePair> pairs) const;

  /// Over the triangles of each body in its own frame.
  const mesh::TriangleTree& fixed_tree() const noexcept { return *fixed_.tree; }
  const mesh::TriangleTree& mobile_tree() const noexcept { return *mobile_.tree; }

 private:
  struct Body {
    std::shared_ptr<const mesh::TriangleTree> tree;  ///< the mesh's own, until it has deformed
    std::shared_ptr<mesh::TriangleTree> refitted;    ///< then this one
    bool is_closed;

    explicit Body(const Mesh& mesh);
    void update(const Mesh& mesh, std::span<const char> is_moved);

    /// The place of a triangle, by its number in the mesh.
    const std::vector<Index>& place_of_triangle() const;

   private:
    core::Lazy<std::vector<Index>> place_of_triangle_;
  };
  bool one_inside_other(const Pose& X_FM) const;

  Body fixed_, mobile_;
};

/// That of a joint's two bodies, made when it is first needed.
const BodyPair& body_pair_of(const JointContact& joint);

}  // namespace condyle::contact
