#include "mesh/plane_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/predicates.hpp"
#include "core/trigonometry.hpp"

namespace condyle::mesh {
namespace {

using core::Sign;
using Loop = std::vector<Index>;

/// Vertices as seen along the axis nearest to a normal, counter-clockwise staying so: two coordinates, to the bit.
class PlaneView {
 public:
  PlaneView(const Points& vertices, const Vec3& normal) : vertices_(vertices) {
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    u_ = static_cast<int>(axis + 1) % 3, v_ = static_cast<int>(axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u_, v_);
  }

  double u(Index i) const { return vertices_[i][u_]; }
  double v(Index i) const { return vertices_[i][v_]; }
  Sign turn(Index a, Index b, Index c) const {
    return core::orientation_2d(u(a), v(a), u(b), v(b), u(c), v(c));
  }
  bool is_left(Index a, Index b, Index c) const { return turn(a, b, c) == Sign::positive; }
  double squared_distance(Index a, Index b) const {
    return (u(b) - u(a)) * (u(b) - u(a)) + (v(b) - v(a)) * (v(b) - v(a));
  }
  double twice_area(Index a, Index b, Index c) const {
    return (u(b) - u(a)) * (v(c) - v(a)) - (v(b) - v(a)) * (u(c) - u(a));
  }
  /// From the direction b to c clockwise to that from b to d, in (0, 2 pi].
  double clockwise(Index b, Index c, Index d) const {
    const double angle =
        core::arctangent(v(c) - v(b), u(c) - u(b)) - core::arctangent(v(d) - v(b), u(d) - u(b));
    return angle > 0 ? angle : angle + 2 * std::numbers::pi;
  }
  /// Whether a triangle holds p, one that reaches `margin` farther beyond its side from c to a.
  bool holds(Index a, Index b, Index c, Index p, double margin) const {
    if (turn(a, b, p) == Sign::negative || turn(b, c, p) == Sign::negative) return false;
    return turn(c, a, p) != Sign::negative ||
           (margin > 0 && -twice_area(c, a, p) < margin * std::sqrt(squared_distance(c, a)));
  }
  /// Whether segments without a common end have a point in common.
  bool meet(Index a, Index b, Index c, Index d) const {
    const Sign abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
    if (abc == Sign::zero && abd == Sign::zero)
      return is_between(a, b, c) || is_between(a, b, d) || is_between(c, d, a);
    return abc * abd != Sign::positive && cda * cdb != Sign::positive;
  }
  bool is_between(Index a, Index b, Index p) const {
    return std::min(u(a), u(b)) <= u(p) && u(p) <= std::max(u(a), u(b)) && std::min(v(a), v(b)) <= v(p) &&
           v(p) <= std::max(v(a), v(b));
  }

 private:
  const Points& vertices_;
  int u_ = 0, v_ = 1;
};

Index after(const Loop& loop, std::size_t i) {
  return loop[(i + 1) % loop.size()];
}
Index before(const Loop& loop, std::size_t i) {
  return loop[(i + loop.size() - 1) % loop.size()];
}

/// Runs along the edges. If outlines meet in a vertex, each goes on with the edge that its inside lies next to.
std::optional<std::vector<Loop>> loops_of(const PlaneView& view, const std::vector<DirectedEdge>& edges) {
  std::map<Index, std::vector<Index>> next;
  for (const auto& [from, to] : edges) next[from].push_back(to);
  std::vector<Loop> loops;
  for (auto& [first, targets] : next)
    while (!targets.empty()) {
      Loop loop = {first, targets.back()};
      targets.pop_back();
      while (loop.back() != first || loop.size() < 3) {
        const Index at = loop.back(), from = loop[loop.size() - 2];
        const auto found = next.find(at);
        if (found == next.end() || found->second.empty()) return std::nullopt;
        std::vector<Index>& choice = found->second;
        const auto on = std::min_element(choice.begin(), choice.end(), [&](Index a, Index b) {
          return view.clockwise(at, from, a) < view.clockwise(at, from, b);
        });
        const Index to = *on;
        choice.erase(on);
        loop.push_back(to);
      }
      loop.pop_back();
      loops.push_back(std::move(loop));
    }
  return loops;
}

double area_of(const PlaneView& view, const Loop& loop) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    area += view.twice_area(loop[0], loop[i], loop[i + 1]) / 2;
  return area;
}

/// Crossings of the ray from p towards +u, with edges half open along v.
bool is_inside(const PlaneView& view, const Loop& loop, Index p) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Index a = loop[i], b = after(loop, i);
    if ((view.v(a) > view.v(p)) == (view.v(b) > view.v(p))) continue;
    inside ^= view.is_left(a, b, p) == (view.v(b) > view.v(a));
  }
  return inside;
}

/// A hole lies in an outline if a vertex of its own does that is none of the outline's.
bool is_inside(const PlaneView& view, const Loop& outline, const Loop& hole) {
  for (const Index v : hole)
    if (std::find(outline.begin(), outline.end(), v) == outline.end()) return is_inside(view, outline, v);
  return true;
}

/// Whether the way from a corner of a loop to p begins on the loop's left.
bool begins_inside(const PlaneView& view, const Loop& loop, std::size_t corner, Index p) {
  const Index a = before(loop, corner), b = loop[corner], c = after(loop, corner);
  if (view.turn(a, b, c) != Sign::negative) return view.is_left(a, b, p) && view.is_left(b, c, p);
  return view.is_left(a, b, p) || view.is_left(b, c, p);
}

bool crosses(const PlaneView& view, const Loop& loop, Index p, Index q) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Index a = loop[i], b = after(loop, i);
    const bool at_a = a == p || a == q, at_b = b == p || b == q;
    if (at_a && at_b) return true;
    if (at_a || at_b) {
      // Edges from an end of the way may still lie along it.
      const Index other = at_a ? b : a;
      if (view.turn(p, q, other) == Sign::zero && view.is_between(p, q, other)) return true;
      continue;
    }
    if (view.meet(a, b, p, q)) return true;
  }
  return false;
}

/// Cuts the outline open to the hole, there and back along one way that meets neither.
bool join_hole(const PlaneView& view, Loop& outline, const Loop& hole, const std::vector<Loop>& others) {
  const auto rightmost = static_cast<std::size_t>(
      std::max_element(hole.begin(), hole.end(), [&](Index a, Index b) { return view.u(a) < view.u(b); }) -
      hole.begin());
  const Index h = hole[rightmost];
  std::vector<std::size_t> corners(outline.size());
  std::iota(corners.begin(), corners.end(), std::size_t{0});
  std::sort(corners.begin(), corners.end(), [&](std::size_t a, std::size_t b) {
    return view.squared_distance(outline[a], h) < view.squared_distance(outline[b], h);
  });
  for (const std::size_t corner : corners) {
    const Index p = outline[corner];
    const bool is_shared = p == h;
    if (!is_shared &&
        (!begins_inside(view, outline, corner, h) || !begins_inside(view, hole, rightmost, p) ||
         crosses(view, outline, p, h) || crosses(view, hole, p, h) ||
         std::any_of(others.begin(), others.end(), [&](const Loop& o) { return crosses(view, o, p, h); })))
      continue;
    Loop joined(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(corner) + 1);
    for (std::size_t k = is_shared ? 1 : 0; k <= hole.size(); ++k)
      joined.push_back(hole[(rightmost + k) % hole.size()]);
    joined.insert(joined.end(), outline.begin() + static_cast<std::ptrdiff_t>(corner) + (is_shared ? 1 : 0),
                  outline.end());
    outline = std::move(joined);
    return true;
  }
  return false;
}

/// Twice the area over the square of the longest side: 0 of a sliver.
double shape_of(const PlaneView& view, Index a, Index b, Index c) {
  const double longest =
      std::max({view.squared_distance(a, b), view.squared_distance(b, c), view.squared_distance(c, a)});
  return view.twice_area(a, b, c) / longest;
}

/// Clips ears, the best shaped first. Points that lie on a straight line but for rounding are joined to what lies off it, as long as there is
/// anything: a triangle of them would be as narrow as rounding is.
bool clip_ears(const PlaneView& view, Loop loop, std::vector<Triangle>& triangles) {
  std::vector<double> shape(loop.size());
  const auto judge = [&](std::size_t i) {
    shape[i] = shape_of(view, before(loop, i), loop[i], after(loop, i));
  };
  for (std::size_t i = 0; i < loop.size(); ++i) judge(i);
  constexpr double narrowest_mm = 1e-7;
  std::vector<std::size_t> order;
  const auto best_ear = [&](double margin) -> std::optional<std::size_t> {
    const auto is_ear = [&](std::size_t i) {
      const Index a = before(loop, i), b = loop[i], c = after(loop, i);
      return view.is_left(a, b, c) && std::none_of(loop.begin(), loop.end(), [&](Index p) {
               return p != a && p != b && p != c && view.holds(a, b, c, p, margin);
             });
    };
    const auto is_worse = [&](std::size_t a, std::size_t b) { return shape[a] < shape[b]; };
    order.resize(loop.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::make_heap(order.begin(), order.end(), is_worse);
    while (!order.empty()) {
      std::pop_heap(order.begin(), order.end(), is_worse);
      if (is_ear(order.back())) return order.back();
      order.pop_back();
    }
    return std::nullopt;
  };
  while (loop.size() > 3) {
    auto ear = best_ear(narrowest_mm);
    if (!ear) ear = best_ear(0);
    if (!ear) return false;
    triangles.push_back({before(loop, *ear), loop[*ear], after(loop, *ear)});
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(*ear));
    shape.erase(shape.begin() + static_cast<std::ptrdiff_t>(*ear));
    judge(*ear % loop.size());
    judge((*ear + loop.size() - 1) % loop.size());
  }
  if (!view.is_left(loop[0], loop[1], loop[2])) return false;
  triangles.push_back({loop[0], loop[1], loop[2]});
  return true;
}

}  // namespace

std::optional<std::vector<Triangle>> filled_outline(const Points& vertices,
                                                    const std::vector<DirectedEdge>& edges,
                                                    const Vec3& normal) {
  const PlaneView view(vertices, normal);
  auto loops = loops_of(view, edges);
  if (!loops) return std::nullopt;
  struct Outline {
    Loop loop;
    double area;
    std::vector<Loop> holes = {};
  };
  std::vector<Outline> outlines;
  std::vector<Loop> holes;
  for (Loop& loop : *loops) {
    const double area = area_of(view, loop);
    if (area > 0)
      outlines.push_back({std::move(loop), area});
    else
      holes.push_back(std::move(loop));
  }
  for (Loop& hole : holes) {
    Outline* around = nullptr;
    for (Outline& outline : outlines)
      if ((!around || outline.area < around->area) && is_inside(view, outline.loop, hole)) around = &outline;
    if (!around) return std::nullopt;
    around->holes.push_back(std::move(hole));
  }
  std::vector<Triangle> triangles;
  for (auto& [loop, area, inside] : outlines) {
    // From the right: what lies between a hole and the outline to its right is joined already.
    const auto right = [&](const Loop& hole) {
      double most = view.u(hole.front());
      for (const Index v : hole) most = std::max(most, view.u(v));
      return most;
    };
    std::sort(inside.begin(), inside.end(),
              [&](const Loop& a, const Loop& b) { return right(a) < right(b); });
    while (!inside.empty()) {
      const Loop hole = std::move(inside.back());
      inside.pop_back();
      if (!join_hole(view, loop, hole, inside)) return std::nullopt;
    }
    if (loop.size() < 3 || !clip_ears(view, std::move(loop), triangles)) return std::nullopt;
  }
  return triangles;
}

}  // namespace condyle::mesh
