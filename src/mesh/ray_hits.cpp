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

using F = hn::CappedTag<float, RayBundles::width>;
constexpr F f;
using Floats = hn::Vec<F>;

/// A bundle in the tree's frame, and the nearest hits so far. Numbers of triangles are exact as doubles.
struct alignas(64) Placed {
  double origin[3][RayBundles::width], direction[3][RayBundles::width];
  double across[2][3][RayBundles::width];  ///< two directions at right angles to the ray
  double distance[RayBundles::width], triangle[RayBundles::width];
  /// In single precision, and how far each ray still looks for hits.
  float rough_origin[3][RayBundles::width], rough_direction[3][RayBundles::width],
      rough_end[RayBundles::width];
  float slack;  ///< more than rounding moves rays and distances by, mm
  Vec3 axis;
};

void place(const Pose& X, const RayBundles::Bundle& from, double reach, Placed& to) {
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
  double size = reach;
  for (int r = 0; r < 3; ++r) {
    for (std::size_t i = 0; i < RayBundles::width; ++i) {
      to.rough_origin[r][i] = static_cast<float>(to.origin[r][i]);
      to.rough_direction[r][i] = static_cast<float>(to.direction[r][i]);
      size = std::max(size, std::abs(to.origin[r][i]));
    }
  }
  // Coordinates and products round by 2^-22 of the size and less; distances to triangles seen at the least angle by 2^-19.
  to.slack = static_cast<float>(0x1p-17 * size);
  std::fill_n(to.rough_end, RayBundles::width, static_cast<float>(reach));
}

/// The part of a bundle in which nearer hits than those found may lie, between pairs of parallel planes: along the axes of the
/// tree, along the bundle and across it. A node beyond one of them is met by no ray.
class alignas(64) Reached {
 public:
  /// Of the target, `size` is the largest coordinate.
  Reached(const Placed& rays, float size) : slack_(rays.slack + 0x1p-20f * size) {
    const Vec3 u = rays.axis, v = u.unitOrthogonal(), w = u.cross(v);
    const Vec3 directions[width] = {
        Vec3::UnitX(),           Vec3::UnitY(), Vec3::UnitZ(), u, v, w, (v + w) * std::sqrt(0.5),
        (v - w) * std::sqrt(0.5)};
    for (std::size_t i = 0; i < width; ++i) {
      for (int k = 0; k < 3; ++k) {
        axis_[k][i] = static_cast<float>(directions[i][k]);
        size_[k][i] = std::abs(axis_[k][i]) + 1e-6f;
      }
    }
    shorten(rays);
  }

  /// To the rays' ends as they are now.
  void shorten(const Placed& rays) {
    for (std::size_t i = 0; i < width; i += hn::Lanes(f)) {
      auto low = hn::Set(f, std::numeric_limits<float>::infinity()), high = hn::Neg(low);
      for (std::size_t ray = 0; ray < RayBundles::width; ++ray) {
        const auto from =
            along(i, rays.rough_origin[0][ray], rays.rough_origin[1][ray], rays.rough_origin[2][ray]);
        const auto way = along(i, rays.rough_direction[0][ray], rays.rough_direction[1][ray],
                               rays.rough_direction[2][ray]);
        const auto to = hn::Add(from, hn::Mul(way, hn::Set(f, rays.rough_end[ray])));
        low = hn::Min(low, hn::Min(from, to)), high = hn::Max(high, hn::Max(from, to));
      }
      const auto half = hn::Set(f, 0.5f);
      hn::Store(hn::Mul(hn::Add(low, high), half), f, centre_ + i);
      hn::Store(hn::Add(hn::Mul(hn::Sub(high, low), half), hn::Set(f, slack_)), f, half_ + i);
    }
  }

  /// Where a node begins to be met, about.
  float along_bundle(const TriangleTree::Node& node) const noexcept {
    return axis_[0][3] * node.centre[0] + axis_[1][3] * node.centre[1] + axis_[2][3] * node.centre[2];
  }

  HWY_INLINE bool may_meet(const TriangleTree::Node& node) const noexcept {
    for (std::size_t i = 0; i < width; i += hn::Lanes(f)) {
      const auto at = along(i, node.centre[0], node.centre[1], node.centre[2]);
      const auto node_half = hn::Add(hn::Add(hn::Mul(hn::Load(f, size_[0] + i), hn::Set(f, node.half[0])),
                                             hn::Mul(hn::Load(f, size_[1] + i), hn::Set(f, node.half[1]))),
                                     hn::Mul(hn::Load(f, size_[2] + i), hn::Set(f, node.half[2])));
      const auto apart = hn::Abs(hn::Sub(at, hn::Load(f, centre_ + i)));
      // What is not a number may be met.
      if (!hn::AllFalse(f, hn::Gt(apart, hn::Add(node_half, hn::Load(f, half_ + i))))) return false;
    }
    return true;
  }

 private:
  static constexpr std::size_t width = 8;

  HWY_INLINE Floats along(std::size_t i, float x, float y, float z) const noexcept {
    return hn::Add(hn::Add(hn::Mul(hn::Load(f, axis_[0] + i), hn::Set(f, x)),
                           hn::Mul(hn::Load(f, axis_[1] + i), hn::Set(f, y))),
                   hn::Mul(hn::Load(f, axis_[2] + i), hn::Set(f, z)));
  }

  float axis_[3][width], size_[3][width];
  float centre_[width], half_[width];
  float slack_;
};

/// Whether any ray passes the ball of a triangle before its end: else no ray meets the triangle.
HWY_INLINE bool may_meet(const RayTarget::Ball& ball, const Placed& rays) {
  const auto radius = hn::Set(f, ball.radius + rays.slack);
  for (std::size_t i = 0; i < RayBundles::width; i += hn::Lanes(f)) {
    const auto from = [&](int k) {
      return hn::Sub(hn::Set(f, ball.centre[k]), hn::Load(f, rays.rough_origin[k] + i));
    };
    const Floats x = from(0), y = from(1), z = from(2);
    const Floats ux = hn::Load(f, rays.rough_direction[0] + i), uy = hn::Load(f, rays.rough_direction[1] + i),
                 uz = hn::Load(f, rays.rough_direction[2] + i);
    const auto along = hn::Add(hn::Add(hn::Mul(x, ux), hn::Mul(y, uy)), hn::Mul(z, uz));
    const auto a = hn::Sub(hn::Mul(y, uz), hn::Mul(z, uy)), b = hn::Sub(hn::Mul(z, ux), hn::Mul(x, uz)),
               c = hn::Sub(hn::Mul(x, uy), hn::Mul(y, ux));
    const auto squared = hn::Add(hn::Add(hn::Mul(a, a), hn::Mul(b, b)), hn::Mul(c, c));
    const auto end = hn::Load(f, rays.rough_end + i);
    // What is not a number may be met.
    const auto missed = hn::Or(hn::Gt(squared, hn::Mul(radius, radius)),
                               hn::Or(hn::Lt(along, hn::Neg(radius)), hn::Gt(along, hn::Add(end, radius))));
    if (!hn::AllTrue(f, missed)) return true;
  }
  return false;
}

/// Whether any ray meets it nearer than what it met before.
HWY_INLINE bool test_triangle(const RayTarget& target, Index place_of_triangle, double reach, Placed& rays) {
  const TriangleTree& tree = target.tree();
  const auto [a, b, c] = tree.corners(place_of_triangle);
  const Vec3& normal = target.normals()[place_of_triangle];
  const auto flat = hn::Set(d, least_cosine * target.normal_lengths()[place_of_triangle]);
  const auto number = hn::Set(d, static_cast<double>(tree.mesh_triangles()[place_of_triangle]));
  const auto zero = hn::Zero(d);
  bool any_met = false;
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
    if (hn::AllFalse(d, passes)) continue;
    any_met = true;
    hn::Store(hn::IfThenElse(passes, distance, best), d, rays.distance + i);
    hn::Store(hn::IfThenElse(passes, number, best_number), d, rays.triangle + i);
  }
  return any_met;
}

void take_ends(double reach, Placed& rays) {
  for (std::size_t i = 0; i < RayBundles::width; ++i)
    rays.rough_end[i] = static_cast<float>(std::min(rays.distance[i], reach));
}

/// The triangle `first` of each ray, by places, is tried before all others where there is one.
void trace(const RayTarget& target, double reach, const Index* first, Placed& rays) {
  const TriangleTree& tree = target.tree();
  const auto& nodes = tree.nodes();
  if (first) {
    bool any_met = false;
    for (std::size_t i = 0; i < RayBundles::width; ++i)
      if (first[i] != no_index && (i == 0 || first[i] != first[i - 1]))
        any_met |= test_triangle(target, first[i], reach, rays);
    if (any_met) take_ends(reach, rays);
  }
  std::array<Index, deepest> open;
  std::size_t count = 0;
  Reached reached(rays, target.size());
  if (reached.may_meet(nodes[0])) open[count++] = 0;
  bool shorter = false;
  while (count > 0) {
    const auto& node = nodes[open[--count]];
    // Looked at again only where hits have shortened the rays since the node was put aside.
    if (shorter && !reached.may_meet(node)) continue;
    if (node.is_leaf()) {
      bool any_met = false;
      for (Index t = node.first; t < node.last; ++t)
        if (may_meet(target.balls()[t], rays)) any_met |= test_triangle(target, t, reach, rays);
      if (!any_met) continue;
      take_ends(reach, rays);
      reached.shorten(rays), shorter = true;
      continue;
    }
    const bool second_is_nearer =
        reached.along_bundle(nodes[node.child + 1]) < reached.along_bundle(nodes[node.child]);
    const Index far = node.child + (second_is_nearer ? 0 : 1), near = node.child + (second_is_nearer ? 1 : 0);
    if (reached.may_meet(nodes[far])) open[count++] = far;
    if (reached.may_meet(nodes[near])) open[count++] = near;
  }
}

void nearest_hits_any(const RayTarget& target, const Pose& X_TR,
                      const std::vector<RayBundles::Bundle>& bundles, double reach, const Index* first,
                      RayHits& out) {
  Placed rays;
  for (std::size_t b = 0; b < bundles.size(); ++b) {
    place(X_TR, bundles[b], reach, rays);
    trace(target, reach, first ? first + b * RayBundles::width : nullptr, rays);
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

RayTarget::RayTarget(const TriMesh& mesh) : tree_(mesh) {
  place_of_.resize(tree_.triangles().size());
  balls_.reserve(tree_.triangles().size());
  for (Index t = 0; t < tree_.triangles().size(); ++t) {
    const auto [a, b, c] = tree_.corners(t);
    const Vec3 centre = (a.cwiseMin(b).cwiseMin(c) + a.cwiseMax(b).cwiseMax(c)) / 2;
    const double radius = std::sqrt(
        std::max({(a - centre).squaredNorm(), (b - centre).squaredNorm(), (c - centre).squaredNorm()}));
    const double rounding = 0x1p-22 * (centre.cwiseAbs().maxCoeff() + radius);
    balls_.push_back(
        {{static_cast<float>(centre.x()), static_cast<float>(centre.y()), static_cast<float>(centre.z())},
         static_cast<float>(radius + rounding)});
    normals_.push_back((b - a).cross(c - a));
    normal_lengths_.push_back(normals_.back().norm());
    place_of_[tree_.mesh_triangles()[t]] = t;
    for (const Vec3& corner : {a, b, c})
      size_ = std::max(size_, static_cast<float>(corner.cwiseAbs().maxCoeff()));
  }
}

void nearest_hits(const RayTarget& target, const Pose& X_TR, const RayBundles& rays, double reach,
                  RayHits& out, std::span<const Index> first) {
  const std::size_t padded = rays.bundles().size() * RayBundles::width;
  out.distance.resize(padded);
  out.triangle.resize(padded);
  if (target.tree().empty()) {
    std::fill(out.distance.begin(), out.distance.end(), std::numeric_limits<double>::infinity());
    std::fill(out.triangle.begin(), out.triangle.end(), no_index);
    return;
  }
  std::vector<Index> places;
  if (!first.empty()) {
    places.resize(padded, no_index);
    for (std::size_t ray = 0; ray < first.size(); ++ray) places[ray] = target.place_of(first[ray]);
  }
  HWY_DYNAMIC_DISPATCH(nearest_hits_any)
  (target, X_TR, rays.bundles(), reach, places.empty() ? nullptr : places.data(), out);
}

void RayBundles::push_back(const Vec3& origin, const Vec3& direction) {
  const std::size_t at = size_++ % width;
  if (at == 0) bundles_.emplace_back();
  for (int axis = 0; axis < 3; ++axis) {
    bundles_.back().origin[axis][at] = origin[axis];
    bundles_.back().direction[axis][at] = direction[axis];
  }
}

void RayBundles::close() {
  for (std::size_t at = size_ % width; at != 0 && at < width; ++at) {
    for (auto* of : {&bundles_.back().origin, &bundles_.back().direction})
      for (auto& values : *of) values[at] = values[at - 1];
  }
  for (Bundle& bundle : bundles_) {
    bundle.axis = Vec3::Zero();
    for (std::size_t at = 0; at < width; ++at) bundle.axis += lane(bundle.direction, at);
    // Directions that cancel have no mean: then any axis serves.
    bundle.axis = bundle.axis.norm() > 1e-3 ? Vec3(bundle.axis.normalized()) : lane(bundle.direction, 0);
  }
}

}  // namespace condyle::mesh
#endif
