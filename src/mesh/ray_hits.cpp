#include "mesh/ray_hits.hpp"

#include <algorithm>
#include <array>
#include <bit>
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

constexpr std::size_t width = RayTarget::width;
using D = hn::CappedTag<double, width>;
constexpr D d;
using Lanes = hn::Vec<D>;
using F = hn::CappedTag<float, width>;
constexpr F f;
using Floats = hn::Vec<F>;

constexpr double none = std::numeric_limits<double>::infinity();

struct Lanes3 {
  Lanes x, y, z;
};

HWY_INLINE Lanes3 set(const Vec3& a) {
  return {hn::Set(d, a.x()), hn::Set(d, a.y()), hn::Set(d, a.z())};
}
HWY_INLINE Lanes3 load(const double (&a)[3][width], std::size_t i) {
  return {hn::Load(d, a[0] + i), hn::Load(d, a[1] + i), hn::Load(d, a[2] + i)};
}
HWY_INLINE Lanes3 minus(const Lanes3& a, const Lanes3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
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

/// A ray in the target's frame, and its nearest hit so far.
class PlacedRay {
 public:
  /// Of the target, `size` is the largest coordinate.
  PlacedRay(const Pose& X, const Ray& ray, double reach, float size)
      : origin_(placed(X, ray.origin) + X.translation()),
        direction_(placed(X, ray.direction)),
        distance_(reach) {
    Eigen::Index steepest;
    direction_.cwiseAbs().maxCoeff(&steepest);
    along_ = static_cast<std::size_t>(steepest);
    across_ = {(along_ + 1) % 3, (along_ + 2) % 3};
    for (std::size_t i = 0; i < 2; ++i)
      shear_[i] = direction_[static_cast<int>(across_[i])] / direction_[steepest];
    // Coordinates and products round by 2^-22 of the size and less; distances to triangles seen at the least angle by 2^-19.
    slack_ = static_cast<float>(0x1p-17 * std::max(reach, origin_.cwiseAbs().maxCoeff())) + 0x1p-20f * size;
    for (int k = 0; k < 3; ++k) {
      rough_origin_[k] = static_cast<float>(origin_[k]);
      rough_direction_[k] = static_cast<float>(direction_[k]);
      slope_[k] = std::abs(rough_direction_[k]) + 1e-6f;
    }
    shorten();
  }

  bool is_hit() const noexcept { return triangle_ != none; }
  double distance() const noexcept { return is_hit() ? distance_ : none; }
  Index triangle() const noexcept { return is_hit() ? static_cast<Index>(triangle_) : no_index; }

  /// Whether a hit that is not before `along`, as boxes_met() tells it, may be nearer.
  bool may_meet_from(float along) const noexcept { return !(along > rough_end_); }

  /// The boxes that the ray may meet before its end, one bit each, and from where on.
  HWY_INLINE unsigned boxes_met(const RayTarget::Branch& branch, float* from) const {
    unsigned met = 0;
    for (std::size_t i = 0; i < width; i += hn::Lanes(f)) {
      Floats centre[3], half[3];
      for (int k = 0; k < 3; ++k) {
        centre[k] = hn::Sub(hn::Load(f, branch.centre[k] + i), hn::Set(f, rough_origin_[k]));
        half[k] = hn::Load(f, branch.half[k] + i);
      }
      const auto slack = hn::Set(f, slack_);
      // Apart along an axis of the box, or along what is at right angles to one and to the ray. What is not a number may be
      // met.
      Floats apart = hn::Zero(f), along = hn::Zero(f), extent = slack;
      for (int k = 0; k < 3; ++k) {
        const auto middle = hn::Sub(centre[k], hn::Set(f, middle_[k]));
        apart = hn::Max(apart, hn::Sub(hn::Abs(middle), hn::Add(half[k], hn::Set(f, reached_[k]))));
        const int y = (k + 1) % 3, z = (k + 2) % 3;
        const auto beside = hn::Sub(hn::Mul(centre[y], hn::Set(f, rough_direction_[z])),
                                    hn::Mul(centre[z], hn::Set(f, rough_direction_[y])));
        const auto wide = hn::Add(
            hn::Add(hn::Mul(half[y], hn::Set(f, slope_[z])), hn::Mul(half[z], hn::Set(f, slope_[y]))), slack);
        apart = hn::Max(apart, hn::Sub(hn::Abs(beside), wide));
        along = hn::Add(along, hn::Mul(centre[k], hn::Set(f, rough_direction_[k])));
        extent = hn::Add(extent, hn::Mul(half[k], hn::Set(f, slope_[k])));
      }
      hn::Store(hn::Sub(along, extent), f, from + i);
      met |= bits_of(f, hn::Not(hn::Gt(apart, hn::Zero(f)))) << i;
    }
    return met & branch.used;
  }

  /// Takes the nearest triangle of a leaf that the ray meets, if that is nearer than what it met before.
  HWY_INLINE void meet(const RayTarget::Leaf& leaf) {
    const auto zero = hn::Zero(d);
    const auto o = set(origin_), u = set(direction_);
    bool nearer = false;
    for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
      const auto at_a = seen(leaf.corner[0], i), at_b = seen(leaf.corner[1], i),
                 at_c = seen(leaf.corner[2], i);
      const auto ab = doubled_area(at_a, at_b), bc = doubled_area(at_b, at_c), ca = doubled_area(at_c, at_a);
      const auto least = hn::Min(hn::Min(ab, bc), ca), most = hn::Max(hn::Max(ab, bc), ca);
      const auto oa = minus(load(leaf.corner[0], i), o), normal = load(leaf.normal, i);
      const auto speed = dot(normal, u);
      const auto passes = hn::And(hn::Or(hn::Ge(least, zero), hn::Le(most, zero)),
                                  hn::Gt(hn::Abs(speed), hn::Load(d, leaf.flat + i)));
      if (hn::AllFalse(d, passes)) continue;
      const auto at = hn::Div(dot(normal, oa), speed);
      const auto met = hn::And(passes, hn::And(hn::Ge(at, zero), hn::Le(at, hn::Set(d, distance_))));
      HWY_ALIGN double distances[width];
      hn::Store(at, d, distances);
      for (unsigned bits = bits_of(d, met); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
        const double number = leaf.number[i + lane];
        if (distances[lane] > distance_ || (distances[lane] == distance_ && !(number < triangle_))) continue;
        distance_ = distances[lane], triangle_ = number;
        nearer = true;
      }
    }
    if (nearer) shorten();
  }

 private:
  static Vec3 placed(const Pose& X, const Vec3& v) {
    const auto& m = X.matrix();
    Vec3 out;
    for (int r = 0; r < 3; ++r) out[r] = (m(r, 0) * v[0] + m(r, 1) * v[1]) + m(r, 2) * v[2];
    return out;
  }

  /// Corners slid along the ray into a plane across its steepest axis.
  HWY_INLINE Seen seen(const double (&corner)[3][width], std::size_t i) const {
    const auto from = [&](std::size_t k) {
      return hn::Sub(hn::Load(d, corner[k] + i), hn::Set(d, origin_[static_cast<int>(k)]));
    };
    const auto along = from(along_);
    return {hn::Sub(from(across_[0]), hn::Mul(along, hn::Set(d, shear_[0]))),
            hn::Sub(from(across_[1]), hn::Mul(along, hn::Set(d, shear_[1])))};
  }

  template <class Tag>
  static HWY_INLINE unsigned bits_of(Tag tag, hn::Mask<Tag> mask) {
    HWY_ALIGN std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, mask, bits);
    return bits[0];
  }

  void shorten() {
    rough_end_ = static_cast<float>(distance_);
    for (int k = 0; k < 3; ++k) {
      middle_[k] = rough_direction_[k] * rough_end_ / 2;
      reached_[k] = std::abs(middle_[k]) + slack_;
    }
  }

  Vec3 origin_, direction_;
  std::size_t along_;                  ///< the axis of the target's frame that the ray is steepest along
  std::array<std::size_t, 2> across_;  ///< the others
  double shear_[2];                    ///< what the ray goes along these for each mm along that
  double distance_;                    ///< of the hit, or the reach
  double triangle_ = none;
  /// In single precision: the ray; half its way to its end; and how far it reaches to both sides of that.
  float rough_origin_[3], rough_direction_[3], slope_[3], middle_[3], reached_[3], rough_end_;
  float slack_;  ///< more than rounding moves rays and distances by, mm
};

/// A tree is at most as deep as the bits of its sorting key, and 32 for equal ones; a branch leaves seven boxes behind.
constexpr std::size_t most_open = 128 * (width - 1) + 1;

struct Open {
  Index below;
  bool is_leaf;
  float from;
};

void trace(const RayTarget& target, PlacedRay& ray) {
  std::array<Open, most_open> open;
  std::size_t count = 0;
  open[count++] = {0, false, 0};
  while (count > 0) {
    const Open here = open[--count];
    if (!ray.may_meet_from(here.from)) continue;
    if (here.is_leaf) {
      ray.meet(target.leaves()[here.below]);
      continue;
    }
    const auto& branch = target.branches()[here.below];
    HWY_ALIGN float from[width];
    // Once a ray is short, the order in which the last boxes are looked at hardly matters.
    const bool any_order = ray.is_hit();
    const std::size_t first = count;
    for (unsigned bits = ray.boxes_met(branch, from); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const bool is_leaf = (branch.leaves >> lane & 1) != 0;
      if (any_order && is_leaf) {
        ray.meet(target.leaves()[branch.below[lane]]);
        continue;
      }
      std::size_t at = count++;
      // The nearest last, to be looked at first.
      if (!any_order)
        for (; at > first && open[at - 1].from < from[lane]; --at) open[at] = open[at - 1];
      open[at] = {branch.below[lane], is_leaf, from[lane]};
    }
  }
}

void nearest_hits_any(const RayTarget& target, const Pose& X_TR, std::span<const Ray> rays, double reach,
                      std::span<const Index> first, RayHits& out) {
  Index likely = no_index;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    PlacedRay ray(X_TR, rays[i], reach, target.size());
    if (!first.empty()) likely = first[i];
    if (likely != no_index) ray.meet(target.leaves()[target.leaf_of(likely)]);
    trace(target, ray);
    out.distance[i] = ray.distance();
    likely = out.triangle[i] = ray.triangle();
  }
}

}  // namespace
}  // namespace condyle::mesh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::mesh {
namespace {

/// A triangle seen at a smaller angle than this, radians, is not met: its distance would be rounding, and whichever ray
/// passes between its edges passes its neighbours too.
constexpr double least_cosine = 1e-9;

}  // namespace

HWY_EXPORT(nearest_hits_any);

RayTarget::RayTarget(const TriMesh& mesh) : tree_(mesh), leaf_of_(mesh.triangles.size(), no_index) {
  for (const Vec3& vertex : tree_.vertices())
    size_ = std::max(size_, static_cast<float>(vertex.cwiseAbs().maxCoeff()));
  if (!tree_.empty()) add_branch(0);
}

Index RayTarget::add_branch(Index node) {
  const auto& nodes = tree_.nodes();
  // The largest box gives way to its two halves as long as there is a lane for them.
  std::vector<Index> boxes{node};
  while (boxes.size() < width) {
    const auto largest = std::max_element(boxes.begin(), boxes.end(), [&](Index a, Index b) {
      return std::pair(!nodes[a].is_leaf(), nodes[a].size()) <
             std::pair(!nodes[b].is_leaf(), nodes[b].size());
    });
    if (nodes[*largest].is_leaf()) break;
    const Index child = nodes[*largest].child;
    *largest = child;
    boxes.push_back(child + 1);
  }
  const auto number = static_cast<Index>(branches_.size());
  branches_.emplace_back();
  for (std::size_t lane = 0; lane < boxes.size(); ++lane) {
    const auto& box = nodes[boxes[lane]];
    const Index below = box.is_leaf() ? add_leaf(box) : add_branch(boxes[lane]);
    Branch& branch = branches_[number];
    branch.below[lane] = below;
    branch.used |= 1u << lane;
    if (box.is_leaf()) branch.leaves |= 1u << lane;
    for (std::size_t k = 0; k < 3; ++k)
      branch.centre[k][lane] = box.centre[k], branch.half[k][lane] = box.half[k];
  }
  return number;
}

Index RayTarget::add_leaf(const TriangleTree::Node& node) {
  const auto number = static_cast<Index>(leaves_.size());
  Leaf& leaf = leaves_.emplace_back();
  for (Index t = node.first; t < node.last; ++t) {
    const std::size_t lane = t - node.first;
    const auto corners = tree_.corners(t);
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    for (int k = 0; k < 3; ++k) {
      for (std::size_t c = 0; c < 3; ++c) leaf.corner[c][k][lane] = corners[c][k];
      leaf.normal[k][lane] = normal[k];
    }
    leaf.flat[lane] = least_cosine * normal.norm();
    leaf.number[lane] = static_cast<double>(tree_.mesh_triangles()[t]);
    leaf_of_[tree_.mesh_triangles()[t]] = number;
  }
  return number;
}

void nearest_hits(const RayTarget& target, const Pose& X_TR, std::span<const Ray> rays, double reach,
                  RayHits& out, std::span<const Index> first) {
  out.distance.assign(rays.size(), std::numeric_limits<double>::infinity());
  out.triangle.assign(rays.size(), no_index);
  if (target.tree().empty()) return;
  HWY_DYNAMIC_DISPATCH(nearest_hits_any)(target, X_TR, rays, reach, first, out);
}

}  // namespace condyle::mesh
#endif
