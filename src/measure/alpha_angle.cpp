#include "measure/alpha_angle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/formatted.hpp"
#include "core/trigonometry.hpp"
#include "measure/degree.hpp"

namespace condyle::measure {
namespace {

/// Share of the radius: beyond any head's contour.
constexpr double farthest_off_circle = 0.25;
/// Contour that a circle needs, as an angle at its centre: a third of a turn of the 210 degrees that there are.
constexpr double least_arc = 120 * degree;
/// Along the neck, in radii: where the head ends, and where the trochanters begin.
constexpr double neck_begins = 0.3;
/// Intervals that miss each other by less, rad, meet.
constexpr double meeting = 1e-9;

struct Interval {
  double begin, end;
  Vec2 at_end;
};

/// Angles of the ends of a contour piece from the centre.
Interval seen(const ContourPiece& piece, const Vec2& from) {
  const auto angle = [&](const Vec2& p) { return core::arctangent(p.y() - from.y(), p.x() - from.x()); };
  const double a = angle(piece.from), b = angle(piece.to);
  return a < b ? Interval{a, b, piece.to} : Interval{b, a, piece.from};
}

/// Contour outside the widened circle, and within it, as angles from the centre.
struct VisibleContour {
  std::vector<Interval> beyond, within;
};

VisibleContour visible_contour(const Contour& half, const Circle& circle, double radius, double reach) {
  VisibleContour visible;
  for (ContourPiece piece : half) {
    if (!clip_to_circle(piece, Vec2::Zero(), reach)) continue;
    ContourPiece inner = piece;
    if (!clip_to_circle(inner, circle.centre, radius)) {
      visible.beyond.push_back(seen(piece, circle.centre));
      continue;
    }
    visible.within.push_back(seen(inner, circle.centre));
    for (const ContourPiece& outer : {ContourPiece{piece.from, inner.from}, ContourPiece{inner.to, piece.to}})
      if (outer.from != outer.to) visible.beyond.push_back(seen(outer, circle.centre));
  }
  const auto earlier = [](const Interval& a, const Interval& b) { return a.begin < b.begin; };
  std::sort(visible.beyond.begin(), visible.beyond.end(), earlier);
  return visible;
}

bool goes_on_at(const std::vector<Interval>& within, double angle) {
  return std::any_of(within.begin(), within.end(), [&](const Interval& one) {
    return one.begin <= angle + meeting && one.end > angle + meeting;
  });
}

}  // namespace

std::optional<CircleFit> head_circle(const Contour& section, double head_radius) {
  Contour head;
  const double slope = 1 / core::tangent(circle_begins_deg * degree);
  const auto before = [&](const Vec2& p) { return p.x() - slope * std::abs(p.y()); };
  for (ContourPiece piece : section) {
    if (!faces_outwards(piece)) continue;
    if (!clip_to_circle(piece, Vec2::Zero(), (1 + farthest_off_circle) * head_radius)) continue;
    if ((piece.from + piece.to).norm() / 2 < (1 - farthest_off_circle) * head_radius) continue;
    const double a = before(piece.from), b = before(piece.to);
    if (a > 0 && b > 0) continue;
    if ((a > 0) != (b > 0)) {
      const Vec2 on_ray = piece.from + a / (a - b) * (piece.to - piece.from);
      (a > 0 ? piece.from : piece.to) = on_ray;
    }
    head.push_back(piece);
  }
  auto fit = fit_circle(head, head_radius);
  if (!fit || fit->kept_length < least_arc * fit->circle.radius ||
      std::abs(fit->circle.radius - head_radius) > farthest_off_circle * head_radius)
    return std::nullopt;
  return fit;
}

AlphaFinding alpha_angle(const Contour& half, const Circle& circle, double head_radius, double tolerance_mm) {
  const auto parts = visible_contour(half, circle, circle.radius + tolerance_mm, neck_reach * head_radius);
  if (parts.beyond.empty()) return {{}, "no contour leaves the head's circle: the neck is not in this mesh"};
  Interval reached = parts.beyond.front();
  const auto found = [&]() -> std::optional<AlphaPoint> {
    if (!goes_on_at(parts.within, reached.end)) return std::nullopt;
    AlphaPoint alpha{reached.end / degree, reached.at_end, {}};
    for (const Interval& other : parts.beyond)
      if (other.begin > reached.end + meeting && other.begin < std::numbers::pi / 2)
        alpha.outside_again_deg = std::max(alpha.outside_again_deg.value_or(0), other.end / degree);
    return alpha;
  };
  for (const Interval& next : parts.beyond) {
    if (next.begin > reached.end + meeting) {
      if (auto alpha = found()) return {alpha, {}};
    }
    if (next.end > reached.end) reached = next;
  }
  if (auto alpha = found()) return {alpha, {}};
  return {{}, core::formatted("the contour nowhere comes within %.1f mm of the head's circle", tolerance_mm)};
}

bool neck_ends(const Contour& half, double head_radius) {
  const auto is_end = [&](const Vec2& p, bool ends) {
    return ends && p.y() < head_radius && p.x() >= neck_begins * head_radius &&
           p.x() <= neck_reach * head_radius;
  };
  return std::any_of(half.begin(), half.end(), [&](const ContourPiece& piece) {
    return is_end(piece.from, piece.from_end) || is_end(piece.to, piece.to_end);
  });
}

std::optional<Vec2> narrowest_neck(const Contour& half, double head_radius) {
  std::optional<Vec2> nearest;
  for (ContourPiece piece : half) {
    if (!faces_away_from_axis(piece)) continue;
    if (!clip_to_range(piece, neck_begins * head_radius, neck_reach * head_radius)) continue;
    for (const Vec2& p : {piece.from, piece.to})
      if (!nearest || p.y() < nearest->y()) nearest = p;
  }
  return nearest;
}

}  // namespace condyle::measure
