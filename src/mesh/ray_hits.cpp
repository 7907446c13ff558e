#include "mesh/ray_hits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/ray_hits.cpp"
#include <hwy/foreach_target.h>
#include "simd/prelude-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::mesh::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, RayBundles::width>;
constexpr D d;
using Lanes = hn::Vec<D>;

constexpr double none = std::numeric_limits<double>::infinity();
/// A triangle seen at a smaller angle than this, radians, is not met: its distance would be rounding, and whichever ray
/// passes between its edges passes its neighbours too.
constexpr double least_cosine = 1e-9;

constexpr std::size_t deepest =
    128;  // a tree is at most as deep as the bits of its sorting key, and 32 for equal ones

struct Lanes3 {
  Lanes x, y, z;
};

HWY_INLINE Lanes3 minus(const Vec3& a, const Lanes3& b) {
  return {hn::Sub(hn::Set(d, a.x()), b.x), hn::Sub(hn::Set(d, a.y()), b.y), hn::Sub(hn::Set(d, a.z()), b.z)};
}

HWY_INLINE Lanes dot(const Vec3& n, const Lanes3& a) {
  return hn::Add(hn::Add(hn::Mul(hn::Set(d, n.x()), a.x), hn::Mul(hn::Set(d, n.y()), a.y)),
                 hn::Mul(hn::Set(d, n.z()), a.z));
}

HWY_INLINE Lanes dot(const Lanes3& a, const Lanes3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// A point as a ray sees it.
struct Seen {
  Lanes x, y;
};

/// Twice the area of the triangle that two points make with the ray, which is the origin. A product of rounded factors is
/// rounded monotonously: where the exact area is above 0 this is not below 0, and the other way.
HWY_INLINE Lanes doubled_area(const Seen& a, const Seen& b) {
  return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
}

/// A bundle in the tree's frame, and the nearest hits so far. Numbers of triangles are exact as doubles.
struct alignas(64) Placed {
  double origin[3][RayBundles::width], direction[3][RayBundles::width];
  double across[2][3][RayBundles::width];  ///< two directions at right angles to the ray
  double distance[RayBundles::width], triangle[RayBundles::width];
  Vec3 axis;
};

void place(const Pose& X, const RayBundles::Bundle& from, Placed& to) {
  const auto& m = X.matrix();
  for (int r = 0; r < 3; ++r) {
    for (std::size_t i = 0; i < RayBundles::width; ++i) {
      const auto rotated = [&](const auto& v) {
        return (m(r, 0) * v[0][i] + m(r, 1) * v[1][i]) + m(r, 2) * v[2][i];
      };
      to.origin[r][i] = rotated(from.origin) + m(r, 3);
      to.direction[r][i] = rotated(from.direction);
    }
  }
  for (std::size_t i = 0; i < RayBundles::width; ++i) {
    const Vec3 u(to.direction[0][i], to.direction[1][i], to.direction[2][i]), v = u.unitOrthogonal(),
                                                                              w = u.cross(v);
    for (int r = 0; r < 3; ++r) to.across[0][r][i] = v[r], to.across[1][r][i] = w[r];
  }
  std::fill_n(to.distance, RayBundles::width, none);
  std::fill_n(to.triangle, RayBundles::width, static_cast<double>(no_index));
  to.axis = (X.linear() * from.axis).normalized();
}

using Float4 = Eigen::Array4f;

/// The part of a bundle that hits nearer than those found may lie in, as two boxes: along the axes of the tree, and along the
/// bundle's own. A node that either leaves out is met by no ray. Single precision, widened by more than it rounds.
class Reached {
 public:
  Reached(const Placed& rays, double length) {
    // Two axes at right angles to the bundle's.
    const Vec3 u = rays.axis, v = u.unitOrthogonal(), w = u.cross(v);
    for (int k = 0; k < 3; ++k) {
      column_[k] = Float4(float(u[k]), float(v[k]), float(w[k]), 0);
      size_[k] = column_[k].abs() + 1e-6f;
    }
    Vec3 low = Vec3::Constant(none), high = -low, own_low = low, own_high = high;
    for (std::size_t i = 0; i < RayBundles::width; ++i) {
      const Vec3 from(rays.origin[0][i], rays.origin[1][i], rays.origin[2][i]);
      const Vec3 to = from + length * Vec3(rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]);
      for (const Vec3& end : {from, to}) {
        low = low.cwiseMin(end), high = high.cwiseMax(end);
        const Vec3 own(u.dot(end), v.dot(end), w.dot(end));
        own_low = own_low.cwiseMin(own), own_high = own_high.cwiseMax(own);
      }
    }
    // Coordinates round to singles, each sum of three products to some more: 2^-21 of the largest one covers them.
    const double slack = 0x1p-21 * (low.cwiseAbs().maxCoeff() + high.cwiseAbs().maxCoeff());
    const auto array = [](const Vec3& a) { return Float4(float(a.x()), float(a.y()), float(a.z()), 0); };
    const auto widened = [&](const Vec3& a) { return Float4(array(a) + float(slack)); };
    centre_ = array((low + high) / 2), half_ = widened((high - low) / 2);
    own_centre_ = array((own_low + own_high) / 2), own_half_ = widened((own_high - own_low) / 2);
    node_slack_ = 0x1p-21f;
  }

  /// Where a node begins to be met, about.
  float along(const TriangleTree::Node& node) const noexcept {
    return column_[0][0] * node.centre[0] + column_[1][0] * node.centre[1] + column_[2][0] * node.centre[2];
  }

  bool may_meet(const TriangleTree::Node& node) const noexcept {
    const auto c = Eigen::Map<const Float4, Eigen::Aligned16>(node.centre.data());
    const auto h = Eigen::Map<const Float4, Eigen::Aligned16>(node.half.data());
    const Float4 apart = (c - centre_).abs() - (half_ + h);
    const Float4 own = column_[0] * c[0] + column_[1] * c[1] + column_[2] * c[2];
    const Float4 own_h = size_[0] * h[0] + size_[1] * h[1] + size_[2] * h[2];
    const float slack = node_slack_ * (std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]));
    const Float4 own_apart = (own - own_centre_).abs() - (own_half_ + own_h + slack);
    return !(apart.max(own_apart).maxCoeff() > 0);  // what is not a number may be met
  }

 private:
  std::array<Float4, 3> column_, size_;
  Float4 centre_, half_, own_centre_, own_half_;
  float node_slack_;
};

HWY_INLINE void test_triangle(const TriangleTree& tree, Index place_of_triangle, double reach, Placed& rays) {
  const auto [a, b, c] = tree.corners(place_of_triangle);
  const Vec3 normal = (b - a).cross(c - a);
  const auto flat = hn::Set(d, least_cosine * normal.norm());
  const auto number = hn::Set(d, static_cast<double>(tree.mesh_triangles()[place_of_triangle]));
  const auto zero = hn::Zero(d);
  for (std::size_t i = 0; i < RayBundles::width; i += hn::Lanes(d)) {
    const Lanes3 o{hn::Load(d, rays.origin[0] + i), hn::Load(d, rays.origin[1] + i),
                   hn::Load(d, rays.origin[2] + i)};
    const Lanes3 u{hn::Load(d, rays.direction[0] + i), hn::Load(d, rays.direction[1] + i),
                   hn::Load(d, rays.direction[2] + i)};
    const auto across = [&](int k) {
      return Lanes3{hn::Load(d, rays.across[k][0] + i), hn::Load(d, rays.across[k][1] + i),
                    hn::Load(d, rays.across[k][2] + i)};
    };
    const auto v = across(0), w = across(1);
    const auto oa = minus(a, o), ob = minus(b, o), oc = minus(c, o);
    const Seen at_a{dot(v, oa), dot(w, oa)}, at_b{dot(v, ob), dot(w, ob)}, at_c{dot(v, oc), dot(w, oc)};
    const auto ab = doubled_area(at_a, at_b), bc = doubled_area(at_b, at_c), ca = doubled_area(at_c, at_a);
    const auto least = hn::Min(hn::Min(ab, bc), ca), most = hn::Max(hn::Max(ab, bc), ca);
    const auto speed = dot(normal, u);
    auto passes = hn::And(hn::Or(hn::Ge(least, zero), hn::Le(most, zero)), hn::Gt(hn::Abs(speed), flat));
    if (hn::AllFalse(d, passes)) continue;
    const auto distance = hn::Div(dot(normal, oa), speed);
    const auto best = hn::Load(d, rays.distance + i), best_number = hn::Load(d, rays.triangle + i);
    const auto nearer =
        hn::Or(hn::Lt(distance, best), hn::And(hn::Eq(distance, best), hn::Lt(number, best_number)));
    passes = hn::And(hn::And(passes, nearer),
                     hn::And(hn::Ge(distance, zero), hn::Le(distance, hn::Set(d, reach))));
    hn::Store(hn::IfThenElse(passes, distance, best), d, rays.distance + i);
    hn::Store(hn::IfThenElse(passes, number, best_number), d, rays.triangle + i);
  }
}

void trace(const TriangleTree& tree, double reach, Placed& rays) {
  const auto& nodes = tree.nodes();
  std::array<Index, deepest> open;
  std::size_t count = 0;
  double length = reach;
  Reached reached(rays, length);
  if (reached.may_meet(nodes[0])) open[count++] = 0;
  bool shorter = false;
  while (count > 0) {
    const auto& node = nodes[open[--count]];
    // Looked at again only where hits have shortened the rays since the node was put aside.
    if (shorter && !reached.may_meet(node)) continue;
    if (node.is_leaf()) {
      for (Index t = node.first; t < node.last; ++t) test_triangle(tree, t, reach, rays);
      const double farthest = *std::max_element(rays.distance, rays.distance + RayBundles::width);
      if (farthest < length) length = farthest, reached = Reached(rays, length), shorter = true;
      continue;
    }
    const bool second_is_nearer = reached.along(nodes[node.child + 1]) < reached.along(nodes[node.child]);
    const Index far = node.child + (second_is_nearer ? 0 : 1), near = node.child + (second_is_nearer ? 1 : 0);
    if (reached.may_meet(nodes[far])) open[count++] = far;
    if (reached.may_meet(nodes[near])) open[count++] = near;
  }
}

void nearest_hits_any(const TriangleTree& tree, const Pose& X_TR,
                      const std::vector<RayBundles::Bundle>& bundles, double reach, RayHits& out) {
  Placed rays;
  for (std::size_t b = 0; b < bundles.size(); ++b) {
    place(X_TR, bundles[b], rays);
    trace(tree, reach, rays);
    for (std::size_t i = 0; i < RayBundles::width; ++i) {
      out.distance[b * RayBundles::width + i] = rays.distance[i];
      out.triangle[b * RayBundles::width + i] = static_cast<Index>(rays.triangle[i]);
    }
  }
}

}  // namespace
}  // namespace condyle::mesh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::mesh {

HWY_EXPORT(nearest_hits_any);

void nearest_hits(const TriangleTree& tree, const Pose& X_TR, const RayBundles& rays, double reach,
                  RayHits& out) {
  const std::size_t padded = rays.bundles().size() * RayBundles::width;
  out.distance.resize(padded);
  out.triangle.resize(padded);
  if (tree.empty()) {
    std::fill(out.distance.begin(), out.distance.end(), std::numeric_limits<double>::infinity());
    std::fill(out.triangle.begin(), out.triangle.end(), no_index);
    return;
  }
  HWY_DYNAMIC_DISPATCH(nearest_hits_any)(tree, X_TR, rays.bundles(), reach, out);
}

void RayBundles::push_back(const Vec3& origin, const Vec3& direction) {
  const std::size_t lane = size_++ % width;
  if (lane == 0) bundles_.emplace_back();
  for (int axis = 0; axis < 3; ++axis) {
    bundles_.back().origin[axis][lane] = origin[axis];
    bundles_.back().direction[axis][lane] = direction[axis];
  }
}

void RayBundles::close() {
  for (std::size_t lane = size_ % width; lane != 0 && lane < width; ++lane) {
    for (auto* of : {&bundles_.back().origin, &bundles_.back().direction})
      for (auto& values : *of) values[lane] = values[lane - 1];
  }
  for (Bundle& bundle : bundles_) {
    const auto at = [](const auto& of, std::size_t lane) {
      return Vec3(of[0][lane], of[1][lane], of[2][lane]);
    };
    bundle.axis = Vec3::Zero();
    for (std::size_t lane = 0; lane < width; ++lane) bundle.axis += at(bundle.direction, lane);
    // Directions that cancel have no mean: then any axis serves.
    bundle.axis = bundle.axis.norm() > 1e-3 ? Vec3(bundle.axis.normalized()) : at(bundle.direction, 0);
  }
}

}  // namespace condyle::mesh
#endif
