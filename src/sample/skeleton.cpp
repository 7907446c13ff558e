#include "sample/skeleton.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "core/trigonometry.hpp"

namespace condyle::sample {
namespace {

/// Subdivisions: with one less, the finest meshes show the facets of the wing and the joints of the rami.
constexpr int sheet_levels = 3, chain_levels = 4;

Ball operator+(const Ball& a, const Ball& b) {
  return {a.centre + b.centre, a.radius + b.radius};
}
Ball operator*(double s, const Ball& a) {
  return {s * a.centre, s * a.radius};
}

using Edge = std::pair<Index, Index>;
using Triangles = std::vector<std::array<Index, 3>>;

/// The one or two corners opposite an edge.
std::map<Edge, std::vector<Index>> opposite_corners(const Triangles& triangles) {
  std::map<Edge, std::vector<Index>> found;
  for (const auto& t : triangles) {
    for (int k = 0; k < 3; ++k) found[std::minmax(t[k], t[(k + 1) % 3])].push_back(t[(k + 2) % 3]);
  }
  return found;
}

/// One step of Loop's subdivision: old balls smoothed, one new ball per edge.
void subdivide_sheet(std::vector<Ball>& balls, Triangles& triangles) {
  const auto opposite = opposite_corners(triangles);
  std::vector<std::vector<Index>> ring(balls.size()), border(balls.size());
  for (const auto& [edge, corners] : opposite) {
    assert(corners.size() <= 2);
    for (const auto& [v, n] : {edge, Edge{edge.second, edge.first}}) {
      ring[v].push_back(n);
      if (corners.size() == 1) border[v].push_back(n);
    }
  }

  std::vector<Ball> finer;
  for (std::size_t v = 0; v < balls.size(); ++v) {
    if (!border[v].empty()) {
      finer.push_back(0.75 * balls[v] + 0.125 * (balls[border[v][0]] + balls[border[v][1]]));
      continue;
    }
    const auto n = static_cast<double>(ring[v].size());
    const double c = 0.375 + 0.25 * core::cosine(2 * std::numbers::pi / n), weight = (0.625 - c * c) / n;
    Ball sum = (1 - n * weight) * balls[v];
    for (const Index neighbour : ring[v]) sum = sum + weight * balls[neighbour];
    finer.push_back(sum);
  }

  std::map<Edge, Index> middle;
  for (const auto& [edge, corners] : opposite) {
    middle[edge] = static_cast<Index>(finer.size());
    const Ball ends = balls[edge.first] + balls[edge.second];
    finer.push_back(corners.size() == 1 ? 0.5 * ends
                                        : 0.375 * ends + 0.125 * (balls[corners[0]] + balls[corners[1]]));
  }

  Triangles split;
  for (const auto& [a, b, c] : triangles) {
    const Index ab = middle[std::minmax(a, b)], bc = middle[std::minmax(b, c)],
                ca = middle[std::minmax(c, a)];
    split.insert(split.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  balls = std::move(finer);
  triangles = std::move(split);
}

/// One step of the cubic B-spline's subdivision, ends kept.
std::vector<Ball> subdivided_chain(const std::vector<Ball>& balls) {
  std::vector<Ball> finer;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const bool is_end = i == 0 || i + 1 == balls.size();
    finer.push_back(is_end ? balls[i] : 0.75 * balls[i] + 0.125 * (balls[i - 1] + balls[i + 1]));
    if (i + 1 < balls.size()) finer.push_back(0.5 * (balls[i] + balls[i + 1]));
  }
  return finer;
}

}  // namespace

Skeleton Skeleton::chain(std::span<const Ball> control) {
  assert(control.size() >= 2);
  Skeleton chain;
  chain.balls_.assign(control.begin(), control.end());
  for (int level = 0; level < chain_levels; ++level) chain.balls_ = subdivided_chain(chain.balls_);
  for (Index i = 0; i + 1 < chain.balls_.size(); ++i) chain.pieces_.push_back({i, i + 1, i + 1});
  chain.group(std::size_t{1} << chain_levels);
  return chain;
}

Skeleton Skeleton::sheet(std::span<const Ball> control, std::span<const std::array<Index, 3>> triangles) {
  Skeleton sheet;
  sheet.balls_.assign(control.begin(), control.end());
  Triangles split(triangles.begin(), triangles.end());
  for (int level = 0; level < sheet_levels; ++level) subdivide_sheet(sheet.balls_, split);
  for (const auto& [a, b, c] : split) {
    sheet.pieces_.push_back({a, b, c});
    sheet.plates_.emplace_back(sheet.balls_[a], sheet.balls_[b], sheet.balls_[c]);
  }
  sheet.group(std::size_t{1} << (2 * sheet_levels));
  return sheet;
}

Ball Skeleton::around(std::size_t first, std::size_t last) const {
  std::vector<Ball> inside;
  for (std::size_t i = first; i < last; ++i) {
    for (const Index v : {pieces_[i].a, pieces_[i].b, pieces_[i].c}) inside.push_back(balls_[v]);
  }
  const Box box = box_around(inside);
  Ball around = {(box.low + box.high) / 2, 0};
  for (const Ball& b : inside)
    around.radius = std::max(around.radius, (b.centre - around.centre).norm() + b.radius);
  return around;
}

void Skeleton::group(std::size_t pieces_per_group) {
  for (std::size_t i = 0; i < pieces_.size(); ++i) around_piece_.push_back(around(i, i + 1));
  assert(pieces_per_group % pieces_per_block == 0);
  for (std::size_t first = 0; first < pieces_.size(); first += pieces_per_block)
    around_block_.push_back(around(first, std::min(first + pieces_per_block, pieces_.size())));
  for (std::size_t first = 0; first < pieces_.size(); first += pieces_per_group) {
    const std::size_t last = std::min(first + pieces_per_group, pieces_.size());
    groups_.push_back({around(first, last), first, last});
  }
  assert(groups_.size() <= most_groups);
}

FieldValue Skeleton::up_to(double most, const Vec3& p) const noexcept {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double limit = most + rounding_mm;
  FieldValue nearest = {limit, Vec3::Zero()};
  const auto visit_block = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Ball& around_piece = around_piece_[i];
      const double reach = nearest.value + around_piece.radius;
      if (reach <= 0 || (p - around_piece.centre).squaredNorm() >= reach * reach) continue;
      if (!plates_.empty() && plates_[i].is_above(nearest.value, p)) continue;
      const FieldValue piece =
          plates_.empty() ? bar(balls_[pieces_[i].a], balls_[pieces_[i].b], p) : plates_[i](p);
      if (piece.value < nearest.value) nearest = piece;
    }
  };
  const auto visit = [&](const Group& group) {
    for (std::size_t begin = group.first; begin < group.last; begin += pieces_per_block) {
      const Ball& around_block = around_block_[begin / pieces_per_block];
      const double reach = nearest.value + around_block.radius + rounding_mm;
      if (reach < 0 || (p - around_block.centre).squaredNorm() > reach * reach) continue;
      visit_block(begin, std::min(begin + pieces_per_block, group.last));
    }
  };
  // The group that looks nearest goes first: most others are then out at one comparison.
  std::array<double, most_groups> bound;
  std::size_t first = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    bound[g] = (p - groups_[g].around.centre).norm() - groups_[g].around.radius;
    if (bound[g] < bound[first]) first = g;
  }
  if (!groups_.empty() && bound[first] < nearest.value) visit(groups_[first]);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (g != first && bound[g] < nearest.value) visit(groups_[g]);
  }
  return nearest.value < limit ? nearest : FieldValue{none, Vec3::Zero()};
}

}  // namespace condyle::sample
