#include "ball.hpp"
#include "kinds.hpp"

namespace bench {

/// Sphere trees: a ball has no orientation, so that turning the body costs one point per node, but holds a
/// patch of a surface loosely (Quinlan 1994, "Efficient distance computation between non-convex objects";
/// Hubbard 1996, "Approximating polyhedra with spheres for time-critical collision detection").
///
/// As in Quinlan's, the tree halves a set of leaves along the longest side of their box. Unlike his, which
/// covers each triangle with many small balls and goes on until they are apart, a leaf is the ball of one
/// triangle and the triangles themselves decide, exactly. Hubbard's balls fill the solid along its medial
/// axis and approximate; ours hold the surface.
std::vector<MethodKind> sphere_tree_kinds() {
  return {{"sphere_tree",
           "bounding volume hierarchies",
           "balls (Quinlan 1994), plain",
           {.touch = true, .pairs = true, .deforms = true},
           DepthKind::none,
           true,
           [](const Bodies& bodies) { return std::make_unique<TwoTrees<Ball>>(bodies); }}};
}

}  // namespace bench
