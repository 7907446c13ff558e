#pragma once

#include <optional>
#include <vector>

#include "condyle/pose.hpp"
#include "contact/reaching.hpp"
#include "mesh/triangle_tree.hpp"

/// How deep one surface reaches into a closed body, wherever its vertices are. docs/mathematics/03-both-directions.md.

namespace condyle::contact {

/// A place of the surface S inside the target T, all in the frame of T.
struct DeepestPlace {
  double depth_mm;                  ///< from the place to the nearest point of the target's surface
  Vec3 place, exit;                 ///< on S; the nearest point of T to it
  Index triangle, target_triangle;  ///< that hold them, in numbers of the meshes
};

/// What a search for it found.
struct DepthSearched {
  std::optional<DeepestPlace> deepest = {};  ///< empty if no place is deeper than was asked for
  double bound_mm = 0;                       ///< no place is deeper than this, or than was asked for
};

/// The place of a surface that is deepest in a closed target: the largest distance to the target's surface of any point of S, of
/// faces as of vertices, that is inside T.
///
///        ________T_________
///       |    :             |      The depth at p is |p q|, and q is where a ball about p first meets T: p q is along
///       |    q   ____S____ |      T's normal at q, where q is inside a face. Finer triangles on T or S change nothing.
///       |    :..p|        ||
///
/// The depth is 1-Lipschitz, so no point of a ball of radius r is deeper than its centre by more than r; and the distance to one
/// triangle of T is convex, so on a piece of S it is at most that of the piece's corners. Parts of S with the largest bound are cut until
/// no bound exceeds the depth of a point by more than rounding (1e-13 of the coordinates), or `most_parts` were looked at: the bound says
/// which. `target` must be of a closed mesh with its normals outwards. Only places deeper than `deeper_than_mm` are searched for.
///
/// `reaching` are the triangles that have a point inside: BodyPair::reaching(). Without it all may, and those
/// that lie outside as closely as they are large are looked at one by one.
DepthSearched deepest_place(const mesh::TriangleTree& target, const mesh::TriangleTree& surface,
                            const Pose& X_TS, std::optional<Reaching> reaching = {},
                            double deeper_than_mm = 0, std::size_t most_parts = 20'000);

}  // namespace condyle::contact
