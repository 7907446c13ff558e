#include "mesh/ray_hits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/turned.hpp"

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

/// A point in the frame of a ray.
struct RayPoint {
  Lanes x, y;
};

/// Twice the area of the triangle that two points make with the ray, which is the origin. A product of rounded factors is
/// rounded monotonously: where the exact area is above 0 this is not below 0, and the other way.
HWY_INLINE Lanes doubled_area(const RayPoint& a, const RayPoint& b) {
  return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
}

template <class Tag>
HWY_INLINE unsigned bits_of(Tag tag, hn::Mask<Tag> mask) {
  HWY_ALIGN std::uint8_t bits[8] = {};
  hn::StoreMaskBits(tag, mask, bits);
  return bits[0];
}

/// A ray in the target's frame, and its nearest hit so far.
class PlacedRay {
 public:
  PlacedRay() = default;
  /// `size` is the largest coordinate of the target.
  PlacedRay(const Pose& X, const Ray& ray, double reach, float size)
      : origin_(posed(X, ray.origin)), direction_(core::turned(X, ray.direction)), distance_(reach) {
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
  float rough_direction(int k) const noexcept { return rough_direction_[k]; }
  float rough_origin(int k) const noexcept { return rough_origin_[k]; }
  float rough_end() const noexcept { return rough_end_; }
  float slack() const noexcept { return slack_; }
  double distance() const noexcept { return is_hit() ? distance_ : none; }
  Index triangle() const noexcept { return is_hit() ? static_cast<Index>(triangle_) : no_index; }

  /// The boxes that the ray may meet before its end, one bit each.
  HWY_INLINE unsigned boxes_met(const RayTarget::Boxes& boxes) const {
    unsigned met = 0;
    const auto slack = hn::Set(f, slack_);
    for (std::size_t i = 0; i < width; i += hn::Lanes(f)) {
      Floats centre[3], half[3];
      for (int k = 0; k < 3; ++k) {
        centre[k] = hn::Sub(hn::Load(f, boxes.centre[k] + i), hn::Set(f, rough_origin_[k]));
        half[k] = hn::Load(f, boxes.half[k] + i);
      }
      // Apart along an axis of the box, or along what is at right angles to one and to the ray. What is not a number may be
      // met.
      auto apart = hn::Zero(f);
      for (int k = 0; k < 3; ++k) {
        const auto middle = hn::Sub(centre[k], hn::Set(f, middle_[k]));
        apart = hn::Max(apart, hn::Sub(hn::Abs(middle), hn::Add(half[k], hn::Set(f, reached_[k]))));
        const int y = (k + 1) % 3, z = (k + 2) % 3;
        const auto beside = hn::Sub(hn::Mul(centre[y], hn::Set(f, rough_direction_[z])),
                                    hn::Mul(centre[z], hn::Set(f, rough_direction_[y])));
        const auto wide =
            hn::Add(hn::Mul(half[y], hn::Set(f, slope_[z])), hn::Mul(half[z], hn::Set(f, slope_[y])));
        apart = hn::Max(apart, hn::Sub(hn::Abs(beside), hn::Add(wide, slack)));
      }
      met |= bits_of(f, hn::Not(hn::Gt(apart, hn::Zero(f)))) << i;
    }
    return met & boxes.used;
  }

  /// Takes the nearest triangle of a leaf that the ray meets, if that is nearer than what it met before.
  HWY_INLINE void meet(const RayTarget::Leaf& leaf) {
    const auto zero = hn::Zero(d);
    const auto o = set(origin_), u = set(direction_);
    bool nearer = false;
    for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
      const auto at_a = in_ray_frame(leaf.corner[0], i), at_b = in_ray_frame(leaf.corner[1], i),
                 at_c = in_ray_frame(leaf.corner[2], i);
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
  /// Corners slid along the ray into a plane across its steepest axis.
  HWY_INLINE RayPoint in_ray_frame(const double (&corner)[3][width], std::size_t i) const {
    const auto from = [&](std::size_t k) {
      return hn::Sub(hn::Load(d, corner[k] + i), hn::Set(d, origin_[static_cast<int>(k)]));
    };
    const auto along = from(along_);
    return {hn::Sub(from(across_[0]), hn::Mul(along, hn::Set(d, shear_[0]))),
            hn::Sub(from(across_[1]), hn::Mul(along, hn::Set(d, shear_[1])))};
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

/// Bounds of some rays up to their ends: slabs along the axes of the target, along the rays and across them. No ray
/// meets a box beyond one of the slabs.
class Hull {
 public:
  explicit Hull(std::span<const PlacedRay> rays) {
    Vec3 sum = Vec3::Zero();
    for (const PlacedRay& ray : rays)
      sum += Vec3(ray.rough_direction(0), ray.rough_direction(1), ray.rough_direction(2));
    // Directions that cancel have no mean: then any serves.
    const Vec3 u = sum.norm() > 1e-3 ? Vec3(sum.normalized()) : Vec3(Vec3::UnitX()), v = u.unitOrthogonal(),
               w = u.cross(v);
    const Vec3 directions[slabs] = {
        Vec3::UnitX(),           Vec3::UnitY(), Vec3::UnitZ(), u, v, w, (v + w) * std::sqrt(0.5),
        (v - w) * std::sqrt(0.5)};
    for (std::size_t i = 0; i < slabs; ++i)
      for (int k = 0; k < 3; ++k) axis_[k][i] = static_cast<float>(directions[i][k]);
    for (std::size_t i = 0; i < slabs; i += hn::Lanes(f)) {
      auto low = hn::Set(f, std::numeric_limits<float>::infinity()), high = hn::Neg(low);
      float slack = 0;
      for (const PlacedRay& ray : rays) {
        const auto along = [&](float x, float y, float z) {
          return hn::Add(hn::Add(hn::Mul(hn::Load(f, axis_[0] + i), hn::Set(f, x)),
                                 hn::Mul(hn::Load(f, axis_[1] + i), hn::Set(f, y))),
                         hn::Mul(hn::Load(f, axis_[2] + i), hn::Set(f, z)));
        };
        const auto from = along(ray.rough_origin(0), ray.rough_origin(1), ray.rough_origin(2));
        const auto way = along(ray.rough_direction(0), ray.rough_direction(1), ray.rough_direction(2));
        const auto to = hn::Add(from, hn::Mul(way, hn::Set(f, ray.rough_end())));
        low = hn::Min(low, hn::Min(from, to)), high = hn::Max(high, hn::Max(from, to));
        slack = std::max(slack, ray.slack());
      }
      const auto half = hn::Set(f, 0.5f);
      hn::Store(hn::Mul(hn::Add(low, high), half), f, centre_ + i);
      hn::Store(hn::Add(hn::Mul(hn::Sub(high, low), half), hn::Set(f, slack)), f, half_ + i);
    }
  }

  /// The boxes that a ray may meet, one bit each.
  HWY_INLINE unsigned boxes_met(const RayTarget::Boxes& boxes) const {
    unsigned met = 0;
    for (std::size_t i = 0; i < width; i += hn::Lanes(f)) {
      auto apart = hn::Zero(f);
      for (std::size_t s = 0; s < slabs; ++s) {
        auto at = hn::Neg(hn::Set(f, centre_[s])), wide = hn::Set(f, half_[s]);
        for (int k = 0; k < 3; ++k) {
          at = hn::Add(at, hn::Mul(hn::Load(f, boxes.centre[k] + i), hn::Set(f, axis_[k][s])));
          wide = hn::Add(wide,
                         hn::Mul(hn::Load(f, boxes.half[k] + i), hn::Set(f, std::abs(axis_[k][s]) + 1e-6f)));
        }
        apart = hn::Max(apart, hn::Sub(hn::Abs(at), wide));
      }
      // A NaN may be met.
      met |= bits_of(f, hn::Not(hn::Gt(apart, hn::Zero(f)))) << i;
    }
    return met & boxes.used;
  }

 private:
  static constexpr std::size_t slabs = 8;

  alignas(64) float axis_[3][slabs], centre_[slabs], half_[slabs];
};

/// A tree is at most as deep as the bits of its sorting key, and 32 for equal ones; a branch leaves seven boxes behind.
constexpr std::size_t most_open = 128 * (width - 1) + 1;

/// The leaves that a hull may meet, eight boxes at a time.
void gather(const RayTarget& target, const Hull& hull, std::vector<RayTarget::Boxes>& leaves) {
  leaves.clear();
  std::size_t used = width;
  std::array<Index, most_open> open;
  std::size_t count = 0;
  open[count++] = 0;
  while (count > 0) {
    const auto& branch = target.branches()[open[--count]];
    for (unsigned bits = hull.boxes_met(branch.boxes); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      if ((branch.leaves >> lane & 1) == 0) {
        open[count++] = branch.boxes.below[lane];
        continue;
      }
      if (used == width) leaves.emplace_back(), used = 0;
      RayTarget::Boxes& boxes = leaves.back();
      for (int k = 0; k < 3; ++k) {
        boxes.centre[k][used] = branch.boxes.centre[k][lane];
        boxes.half[k][used] = branch.boxes.half[k][lane];
      }
      boxes.below[used] = branch.boxes.below[lane];
      boxes.used |= 1u << used++;
    }
  }
}

void nearest_hits_any(const RayTarget& target, const Pose& X_TR, std::span<const Ray> rays, double reach,
                      std::span<const Index> first, RayHits& out) {
  constexpr std::size_t together = 8;
  std::array<PlacedRay, together> some;
  std::array<Index, together> tried;  // the leaf that each ray was held against before all others
  Index likely = no_index;
  const auto try_likely = [&](PlacedRay& ray) {
    if (likely == no_index) return no_index;
    const Index leaf = target.leaf_of(likely);
    ray.meet(target.leaves()[leaf]);
    return leaf;
  };
  for (std::size_t begin = 0; begin < rays.size(); begin += together) {
    const std::size_t end = std::min(begin + together, rays.size());
    for (std::size_t i = begin; i < end; ++i) {
      if (!first.empty()) likely = first[i];
      some[i - begin] = PlacedRay(X_TR, rays[i], reach, target.size());
      tried[i - begin] = try_likely(some[i - begin]);
    }
    gather(target, Hull(std::span(some).first(end - begin)), out.leaves);
    for (std::size_t i = begin; i < end; ++i) {
      PlacedRay& ray = some[i - begin];
      Index& before = tried[i - begin];
      if (first.empty() && !ray.is_hit()) before = try_likely(ray);
      for (const auto& boxes : out.leaves) {
        for (unsigned bits = ray.boxes_met(boxes); bits != 0; bits &= bits - 1) {
          const Index leaf = boxes.below[static_cast<std::size_t>(std::countr_zero(bits))];
          if (leaf != before) ray.meet(target.leaves()[leaf]);
        }
      }
      out.distance[i] = ray.distance();
      out.triangle[i] = ray.triangle();
      if (ray.is_hit()) likely = ray.triangle();
    }
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
  build();
}

void RayTarget::build() {
  branches_.clear(), leaves_.clear();
  measure_size();
  if (!tree_.empty()) add_branch(0);
}

void RayTarget::measure_size() {
  size_ = 0;
  for (const Vec3& vertex : tree_.vertices())
    size_ = std::max(size_, static_cast<float>(vertex.cwiseAbs().maxCoeff()));
}

void RayTarget::update(const TriMesh& mesh, std::span<const char> is_moved) {
  tree_.refit(mesh.vertices, is_moved);
  if (tree_.is_worn()) {
    tree_ = TriangleTree(mesh);
    return build();
  }
  measure_size();
  for (Branch& branch : branches_) set_boxes(branch);
  const auto has_moved = [&](const Leaf& leaf) {
    if (is_moved.empty()) return true;
    for (Index t = leaf.first; t < leaf.first + leaf.count; ++t)
      for (const Index v : mesh.triangles[tree_.mesh_triangles()[t]])
        if (is_moved[v]) return true;
    return false;
  };
  for (Leaf& leaf : leaves_)
    if (has_moved(leaf)) set_triangles(leaf);
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
    if (box.is_leaf()) branches_[number].leaves |= 1u << lane;
    branches_[number].node[lane] = boxes[lane];
    Boxes& of_branch = branches_[number].boxes;
    of_branch.below[lane] = below;
    of_branch.used |= 1u << lane;
  }
  set_boxes(branches_[number]);
  return number;
}

void RayTarget::set_boxes(Branch& branch) const {
  for (unsigned bits = branch.boxes.used; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    const auto& box = tree_.nodes()[branch.node[lane]];
    for (std::size_t k = 0; k < 3; ++k)
      branch.boxes.centre[k][lane] = box.centre[k], branch.boxes.half[k][lane] = box.half[k];
  }
}

Index RayTarget::add_leaf(const TriangleTree::Node& node) {
  const auto number = static_cast<Index>(leaves_.size());
  Leaf& leaf = leaves_.emplace_back();
  leaf.first = node.first, leaf.count = node.last - node.first;
  set_triangles(leaf);
  for (Index t = node.first; t < node.last; ++t) leaf_of_[tree_.mesh_triangles()[t]] = number;
  return number;
}

void RayTarget::set_triangles(Leaf& leaf) const {
  for (std::size_t lane = 0; lane < leaf.count; ++lane) {
    const Index t = leaf.first + static_cast<Index>(lane);
    const auto corners = tree_.corners(t);
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    for (int k = 0; k < 3; ++k) {
      for (std::size_t c = 0; c < 3; ++c) leaf.corner[c][k][lane] = corners[c][k];
      leaf.normal[k][lane] = normal[k];
    }
    leaf.flat[lane] = least_cosine * normal.norm();
    leaf.number[lane] = static_cast<double>(tree_.mesh_triangles()[t]);
  }
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
