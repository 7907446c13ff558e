#include "tangential/query/circle_cuts.hpp"

#include <algorithm>
#include <limits>

#include "core/predicates.hpp"
#include "tangential/build/free_directions.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangential/query/circle_cuts.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tangential/query/arctangent-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::tangential::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using Doubles = hn::Vec<D>;
constexpr D d;

/// Points in as many lanes.
struct Points3 {
  Doubles x, y, z;
};

using Column = std::array<double, CircleCuts::most>;

/// What pairs are about: corners as four doubles side by side, before they are turned into lanes.
struct Staged {
  alignas(64) std::array<std::array<double, 4 * CircleCuts::most>, 3> corner;
  alignas(64) Column height, squared_radius;
};

HWY_INLINE void copy_four(const double* from, double* to) {
  constexpr hn::CappedTag<double, 4> d4;
  for (std::size_t k = 0; k < 4; k += hn::Lanes(d4)) hn::Store(hn::Load(d4, from + k), d4, to + k);
}

HWY_INLINE void stage(const CutSource& source, const TurningPoint* points, const Index* circle,
                      const Index* triangle, std::size_t count, Staged& staged) {
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle& corners = source.triangles[triangle[i]];
    for (std::size_t c = 0; c < 3; ++c)
      copy_four(source.vertices[corners[c]].at.data(), staged.corner[c].data() + 4 * i);
    const TurningPoint& point = points[circle[i]];
    staged.height[i] = point.z, staged.squared_radius[i] = point.squared_radius;
  }
}

HWY_INLINE Points3 if_then_else(hn::Mask<D> mask, const Points3& yes, const Points3& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

/// One end of the cuts.
struct Ends {
  Doubles x, y, squared_radius;
};

/// Where edges from `alone` to `other` are at the height, from their lower corners upwards: upper - lower is
/// alone - other or, exactly, its negative, which leaves products and quotients of two such as they are.
HWY_INLINE Ends ends_of(const Points3& alone, const Points3& other, hn::Mask<D> alone_above, Doubles height) {
  const Points3 lower = if_then_else(alone_above, other, alone);
  const auto t = hn::Div(hn::Sub(height, lower.z), hn::Sub(alone.z, other.z));
  const auto x = hn::Add(lower.x, hn::Mul(t, hn::Sub(alone.x, other.x)));
  const auto y = hn::Add(lower.y, hn::Mul(t, hn::Sub(alone.y, other.y)));
  return {x, y, hn::Add(hn::Mul(x, x), hn::Mul(y, y))};
}

/// As `cut_at_height` in circle_crossing.cpp, but for which end is p.
struct Cuts {
  Ends a, b;
  hn::Mask<D> a_is_p;
  /// The triangle lies above or below the height, or touches it from above; else there is a cut.
  hn::Mask<D> missed, touches;
};

/// Of corners 0, 1 and 2 one is alone on its side of the height, the others follow it in the order 1, 2 or 0,
/// 1 or, where 1 is alone, the other way round.
HWY_INLINE Cuts cuts_of(const Staged& staged, Doubles height, std::size_t i) {
  const auto corner = [&](std::size_t c) {
    Points3 at;
    Doubles unused;
    hn::LoadInterleaved4(d, staged.corner[c].data() + 4 * i, at.x, at.y, at.z, unused);
    return at;
  };
  const Points3 p0 = corner(0), p1 = corner(1), p2 = corner(2);
  const auto above0 = hn::Ge(p0.z, height), above1 = hn::Ge(p1.z, height), above2 = hn::Ge(p2.z, height);
  const auto differ01 = hn::Xor(above0, above1), differ12 = hn::Xor(above1, above2);
  const auto alone0 = hn::AndNot(differ12, differ01), alone1 = hn::And(differ01, differ12);
  const auto alone2 = hn::AndNot(differ01, differ12);
  const Points3 alone = if_then_else(alone0, p0, if_then_else(alone1, p1, p2));
  const Points3 first = if_then_else(alone0, p1, p0), second = if_then_else(alone2, p1, p2);
  const auto alone_above = hn::Ge(alone.z, height);
  const auto all_above = hn::And(hn::And(above0, above1), above2);
  const auto any_above = hn::Or(hn::Or(above0, above1), above2);
  const auto lowest = hn::Min(hn::Min(p0.z, p1.z), p2.z);
  const auto touches = hn::And(all_above, hn::Eq(lowest, height));
  return {ends_of(alone, first, alone_above, height), ends_of(alone, second, alone_above, height),
          hn::Xor(alone_above, alone1), hn::Or(hn::Not(any_above), hn::AndNot(touches, all_above)), touches};
}

/// Ways along cuts from the end inside a circle, (x, y), to the end outside, and what the ends alone tell.
struct Ways {
  alignas(64) Column x, y, end_squared_radius, dx, dy, verdict, point_x, point_y, squared_radius;
};

HWY_INLINE Doubles value(CutVerdict verdict) {
  return hn::Set(d, static_cast<double>(verdict));
}

/// In units of the scale M, as circle_predicates.cpp derives them.
struct Bounds {
  Doubles end, dot, room;
};

HWY_INLINE Bounds bounds_of(double scale) {
  const double scale2 = scale * scale;
  return {hn::Set(d, 96 * core::rounding_unit * scale2), hn::Set(d, 128 * core::rounding_unit * scale2),
          hn::Set(d, 1024 * core::rounding_unit * scale2 * scale2)};
}

/// Of cuts with both ends beyond the circle, and (dx, dy) from q to p: certainly no chord of it.
HWY_INLINE hn::Mask<D> no_chord(const Ends& p, const Ends& q, Doubles dx, Doubles dy, Doubles squared_radius,
                                const Bounds& bounds) {
  const auto at_p = hn::Add(hn::Mul(p.x, dx), hn::Mul(p.y, dy));
  const auto at_q = hn::Add(hn::Mul(q.x, dx), hn::Mul(q.y, dy));
  const auto turn = hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x));
  const auto length2 = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
  const auto room = hn::Sub(hn::Mul(squared_radius, length2), hn::Mul(turn, turn));
  return hn::Or(hn::Or(hn::Lt(at_p, hn::Neg(bounds.dot)), hn::Gt(at_q, bounds.dot)),
                hn::Lt(room, hn::Neg(bounds.room)));
}

/// Notes the places from `first` on of those lanes, as far as there are `count`, that are not done; returns
/// how many are noted then. Without a branch: which they are nobody could foretell.
HWY_INLINE std::size_t note_open(hn::Mask<D> done, std::size_t first, std::size_t count, std::uint32_t* open,
                                 std::size_t noted) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, done, bits);
  const unsigned there = (1u << std::min(count - first, hn::Lanes(d))) - 1;
  const unsigned left = ~static_cast<unsigned>(bits[0]) & there;
  for (std::size_t k = 0; k < hn::MaxLanes(d); ++k) {
    open[noted] = static_cast<std::uint32_t>(first + k);
    noted += left >> k & 1;
  }
  return noted;
}

/// What the ends of the cuts tell. Notes the places of those pairs that are not done with that, and returns
/// how many they are.
HWY_INLINE std::size_t compare_ends(const Staged& staged, double scale, std::size_t count, Ways& ways,
                                    std::uint32_t* open) {
  const Bounds bounds = bounds_of(scale);
  std::size_t open_count = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto height = hn::Load(d, staged.height.data() + i);
    const auto squared_radius = hn::Load(d, staged.squared_radius.data() + i);
    const auto [p, q, in_order, missed, touches] = cuts_of(staged, height, i);
    const auto p_value = hn::Sub(p.squared_radius, squared_radius);
    const auto q_value = hn::Sub(q.squared_radius, squared_radius);
    const auto p_inside = hn::Lt(p_value, hn::Neg(bounds.end)), p_outside = hn::Gt(p_value, bounds.end);
    const auto q_inside = hn::Lt(q_value, hn::Neg(bounds.end)), q_outside = hn::Gt(q_value, bounds.end);
    // With both ends outside, from q to p.
    const auto x = hn::IfThenElse(p_inside, p.x, q.x), y = hn::IfThenElse(p_inside, p.y, q.y);
    const auto dx = hn::Sub(hn::IfThenElse(p_inside, q.x, p.x), x);
    const auto dy = hn::Sub(hn::IfThenElse(p_inside, q.y, p.y), y);
    const auto beyond =
        hn::And(hn::And(p_outside, q_outside), no_chord(p, q, dx, dy, squared_radius, bounds));
    const auto none = hn::Or(missed, hn::AndNot(touches, hn::Or(hn::And(p_inside, q_inside), beyond)));

    const auto one = hn::Or(hn::And(p_inside, q_outside), hn::And(q_inside, p_outside));
    const auto passage =
        hn::IfThenElse(hn::Xor(p_inside, in_order), value(CutVerdict::leaves), value(CutVerdict::enters));
    const auto verdict = hn::IfThenElse(hn::AndNot(touches, one), passage, value(CutVerdict::undecided));
    const auto store = [&](Doubles values, Column& column) { hn::Store(values, d, column.data() + i); };
    store(x, ways.x), store(y, ways.y), store(dx, ways.dx), store(dy, ways.dy), store(verdict, ways.verdict);
    store(hn::IfThenElse(p_inside, p.squared_radius, q.squared_radius), ways.end_squared_radius);
    open_count = note_open(none, i, count, open, open_count);
  }
  return open_count;
}

/// The fraction of the way after which the circle is crossed: the operations of `way_out` in
/// circle_crossing.cpp.
HWY_INLINE Doubles fraction_to_circle(Doubles x, Doubles y, Doubles squared, Doubles dx, Doubles dy,
                                      Doubles squared_radius) {
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const auto a = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), b = hn::Add(hn::Mul(x, dx), hn::Mul(y, dy));
  const auto c = hn::Min(zero, hn::Sub(squared, squared_radius));
  const auto root = hn::Sqrt(hn::Sub(hn::Mul(b, b), hn::Mul(a, c)));
  const auto forth = hn::Gt(b, zero);
  const auto t = hn::Div(hn::IfThenElse(forth, hn::Neg(c), hn::Sub(root, b)),
                         hn::IfThenElse(forth, hn::Add(b, root), a));
  return hn::Min(hn::Max(t, zero), one);
}

/// Crossings err by less than 2^-13 where the radius is no less than 2^-20 M (see `add_crossings`): what is
/// twice as far from the point is on the side of the point where it seems to be.
HWY_INLINE void cross(double scale, const Ways& ways, CircleCuts& out) {
  const auto least_radius2 = hn::Set(d, 0x1p-40 * scale * scale);
  const auto least_angle = hn::Set(d, FreeDirections::clearance);
  for (std::size_t k = 0; k < out.count; k += hn::Lanes(d)) {
    const auto of = [&](const Column& column) { return hn::Load(d, column.data() + k); };
    const auto px = of(ways.point_x), py = of(ways.point_y), squared_radius = of(ways.squared_radius);
    const auto x = of(ways.x), y = of(ways.y), dx = of(ways.dx), dy = of(ways.dy);
    const auto t = fraction_to_circle(x, y, of(ways.end_squared_radius), dx, dy, squared_radius);
    const auto at_x = hn::Add(x, hn::Mul(t, dx)), at_y = hn::Add(y, hn::Mul(t, dy));
    const auto angle = arctangent(d, hn::Sub(hn::Mul(px, at_y), hn::Mul(py, at_x)),
                                  hn::Add(hn::Mul(px, at_x), hn::Mul(py, at_y)));
    const auto certain = hn::And(hn::Gt(hn::Abs(angle), least_angle), hn::Ge(squared_radius, least_radius2));
    const auto verdict = hn::IfThenElse(certain, of(ways.verdict), value(CutVerdict::undecided));
    hn::Store(angle, d, out.angle.data() + k), hn::Store(verdict, d, out.verdict.data() + k);
  }
}

void cut_circles_any(const CutSource& source, std::span<const TurningPoint> points,
                     std::span<const Index> circle, std::span<const Index> triangle, std::size_t first,
                     double scale, CircleCuts& out) {
  const std::size_t count = std::min(triangle.size() - first, CircleCuts::most);
  Staged staged;
  stage(source, points.data(), circle.data() + first, triangle.data() + first, count, staged);
  Ways ways;
  std::array<std::uint32_t, CircleCuts::most + 1> open;
  out.count = compare_ends(staged, scale, count, ways, open.data());
  // To the front, in place: none goes to where one after it is.
  for (std::size_t k = 0; k < out.count; ++k) {
    const std::size_t from = open[k], pair = first + from;
    for (Column* column : {&ways.x, &ways.y, &ways.end_squared_radius, &ways.dx, &ways.dy, &ways.verdict})
      (*column)[k] = (*column)[from];
    const TurningPoint& point = points[circle[pair]];
    ways.point_x[k] = point.x, ways.point_y[k] = point.y, ways.squared_radius[k] = point.squared_radius;
    out.pair[k] = pair;
  }
  cross(scale, ways, out);
}

}  // namespace
}  // namespace condyle::tangential::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::tangential {

HWY_EXPORT(cut_circles_any);

/// Fourth powers of the scale neither overflow nor lose digits to underflow between these: beyond them
/// nothing is certain.
void cut_circles(const CutSource& source, std::span<const TurningPoint> points, std::span<const Index> circle,
                 std::span<const Index> triangle, std::size_t first, CircleCuts& out) {
  constexpr double least = 0x1p-220, greatest = 0x1p250;
  const bool usual = source.scale > least && source.scale < greatest;
  const double scale = usual ? 1.5 * source.scale : std::numeric_limits<double>::infinity();
  HWY_DYNAMIC_DISPATCH(cut_circles_any)(source, points, circle, triangle, first, scale, out);
}

}  // namespace condyle::tangential
#endif
