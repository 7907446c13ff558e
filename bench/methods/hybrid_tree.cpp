#include "kinds.hpp"
#include "volume_tree.hpp"

namespace bench {
namespace {

using condyle::Vec3;

/// A box along the axes of the fixed body's frame.
struct AlignedBox {
  Eigen::AlignedBox3d box;

  static AlignedBox around(std::span<const Vec3> corners) {
    AlignedBox made;
    for (const Vec3& p : corners) made.box.extend(p);
    return made;
  }
  static AlignedBox joined(const AlignedBox& a, const AlignedBox& b) { return {a.box.merged(b.box)}; }

  AlignedBox posed(const condyle::Pose& X) const {
    const Vec3 centre = condyle::posed(X, Vec3(box.center())),
               half = X.linear().cwiseAbs() * (0.5 * box.sizes());
    const double rounding = relative_rounding * (box.center().norm() + centre.norm() + half.norm());
    const Vec3 reach = half + Vec3::Constant(rounding);
    return {{Vec3(centre - reach), Vec3(centre + reach)}};
  }
  bool meets(const AlignedBox& other) const { return box.intersects(other.box); }
  double size() const { return box.diagonal().squaredNorm(); }
};

}  // namespace

/// Boxes updated by halves: T. Larsson, T. Akenine-Moeller, "Collision detection for continuously deforming bodies"
/// (Eurographics 2001, short presentations), whose text was not at hand.
///
/// Taken from it: after a deformation the boxes of the middle level are fitted to their triangles and those above joined
/// from them; a box below is fitted when a query visits it. Differing: binary trees, one triangle in a leaf, and the
/// mobile body's boxes are boxes about its turned ones.
std::vector<MethodKind> hybrid_tree_kinds() {
  return {{"hybrid_tree",
           "bounding volume hierarchies",
           "boxes updated by halves (Larsson 2001), plain",
           {.touch = true, .pairs = true, .deforms = true},
           DepthKind::none,
           true,
           [](const Bodies& bodies) { return std::make_unique<TwoTrees<AlignedBox>>(bodies); }}};
}

}  // namespace bench
