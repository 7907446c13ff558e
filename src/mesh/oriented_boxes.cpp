#include "mesh/oriented_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/float_bounds.hpp"

namespace condyle::mesh {
namespace {

/// Halves are wider by these parts of the box and of its coordinates: more than axes in single precision are not at right angles, and
/// than doubles round.
constexpr double wider_by_reach = 0x1p-20, wider_by_place = 0x1p-24;

Vec3 longest_edge(const TriangleCorners& t) {
  Vec3 longest = t[1] - t[0];
  for (const Vec3& edge : {Vec3(t[2] - t[1]), Vec3(t[0] - t[2])})
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
  return longest;
}

Vec3 area_normal(const TriangleCorners& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

}  // namespace

OrientedBoxes::OrientedBoxes(const TriangleTree& tree) : boxes_(tree.nodes().size()) {
  std::vector<Vec3> longest(boxes_.size(), Vec3::Zero()), normals(boxes_.size(), Vec3::Zero());
  // Children come after their parent.
  for (auto i = static_cast<Index>(boxes_.size()); i-- > 0;) {
    const TriangleTree::Node& node = tree.nodes()[i];
    Box& box = boxes_[i];
    const auto add = [&](const Vec3& edge, const Vec3& normal) {
      if (edge.squaredNorm() > longest[i].squaredNorm()) longest[i] = edge;
      normals[i] += normal;
    };
    if (node.is_leaf())
      for (Index t = node.first; t < node.last; ++t)
        add(longest_edge(tree.corners(t)), area_normal(tree.corners(t)));
    else
      for (const Index child : {node.child, node.child + 1}) add(longest[child], normals[child]);
    set_axes(box, longest[i], normals[i]);

    const Vec3 centre(double{node.centre[0]}, double{node.centre[1]}, double{node.centre[2]});
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 axis = box.axis(k);
      double &least = low[static_cast<int>(k)], &most = high[static_cast<int>(k)];
      const auto extend = [&](const Vec3& p, double half) {
        const double along = axis.dot(p - centre);
        least = std::min(least, along - half), most = std::max(most, along + half);
      };
      if (node.is_leaf())
        for (Index t = node.first; t < node.last; ++t)
          for (const Vec3& p : tree.corners(t)) extend(p, 0);
      else
        for (const Index child : {node.child, node.child + 1}) {
          const Box& inner = boxes_[child];
          double half = 0;
          for (std::size_t m = 0; m < 3; ++m)
            half += std::abs(axis.dot(inner.axis(m))) * double{inner.half[m]};
          extend(inner.centre, half);
        }
    }
    set_bounds(box, centre, low, high);
  }
}

void OrientedBoxes::set_axes(Box& box, const Vec3& longest, const Vec3& normal) {
  const Vec3 along = longest.norm() > 0 ? Vec3(longest.normalized()) : Vec3(Vec3::UnitX());
  Vec3 across = normal.cross(along);
  if (!(across.norm() > 0)) across = along.unitOrthogonal();
  across.normalize();
  const std::array<Vec3, 3> axes = {across, along, along.cross(across)};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t m = 0; m < 3; ++m) box.axes[k][m] = static_cast<float>(axes[k][static_cast<int>(m)]);
}

/// `low` and `high` are along the axes, from the given centre.
void OrientedBoxes::set_bounds(Box& box, const Vec3& centre, const Vec3& low, const Vec3& high) {
  box.centre = centre;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<int>(k);
    box.centre += (low[axis] + high[axis]) / 2 * box.axis(k);
  }
  const double reach = low.cwiseAbs().cwiseMax(high.cwiseAbs()).sum();
  const double wider = wider_by_reach * reach + wider_by_place * centre.norm();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<int>(k);
    box.half[k] = core::float_above((high[axis] - low[axis]) / 2 + wider);
  }
}

bool OrientedBoxes::apart(Index i, Index j) const noexcept {
  const Box &a = boxes_[i], &b = boxes_[j];
  const Vec3 from_a_to_b = b.centre - a.centre;
  std::array<std::array<double, 3>, 3> cosine;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 axis = a.axis(k);
    double reach = double{a.half[k]};
    for (std::size_t m = 0; m < 3; ++m) {
      cosine[k][m] = std::abs(axis.dot(b.axis(m)));
      reach += cosine[k][m] * double{b.half[m]};
    }
    if (std::abs(axis.dot(from_a_to_b)) > reach) return true;
  }
  for (std::size_t m = 0; m < 3; ++m) {
    double reach = double{b.half[m]};
    for (std::size_t k = 0; k < 3; ++k) reach += cosine[k][m] * double{a.half[k]};
    if (std::abs(b.axis(m).dot(from_a_to_b)) > reach) return true;
  }
  return false;
}

bool are_often_slender(const TriangleTree& tree) {
  constexpr double most = 16;
  constexpr Index one_in = 8, sample = 4096;
  const auto count = static_cast<Index>(tree.triangles().size());
  const Index step = count / sample + 1;
  Index slender = 0;
  for (Index t = 0; t < count; t += step) {
    const TriangleCorners c = tree.corners(t);
    const double squared = longest_edge(c).squaredNorm();
    slender += squared * squared > most * most * area_normal(c).squaredNorm();
  }
  return one_in * slender > count / step;
}

TriangleStrip::TriangleStrip(const TriangleCorners& triangle)
    : origin_(triangle[0]), across_(area_normal(triangle).cross(longest_edge(triangle))) {
  const double length = across_.norm();
  across_ = length > 0 && std::isfinite(length) ? Vec3(across_ / length) : Vec3(Vec3::Zero());
  own_ = of(triangle);
}

TriangleStrip::Interval TriangleStrip::of(const TriangleCorners& triangle) const noexcept {
  Interval interval{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  double largest = 0;
  for (const Vec3& p : triangle) {
    const Vec3 from = p - origin_;
    const double along = across_.dot(from);
    interval.low = std::min(interval.low, along), interval.high = std::max(interval.high, along);
    largest = std::max(largest, from.cwiseAbs().maxCoeff());
  }
  const double rounding = 0x1p-48 * largest + std::numeric_limits<double>::min();
  return {interval.low - rounding, interval.high + rounding};
}

bool TriangleStrip::apart(const TriangleCorners& other) const noexcept {
  const Interval its = of(other);
  return its.low > own_.high || its.high < own_.low;
}

}  // namespace condyle::mesh
