#include "tangential/query/classify_crossings.hpp"

#include <algorithm>
#include <limits>

#include "core/predicates.hpp"
#include "tangential/build/free_directions.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangential/query/classify_crossings.cpp"
#include <hwy/foreach_target.h>
#include "simd/prelude-inl.hpp"

#include "simd/lane_numbers-inl.hpp"
#include "tangential/exact/arctangent-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::tangential::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace simd = simd::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using Doubles = hn::Vec<D>;
constexpr D d;

/// Points in as many lanes.
struct Points3 {
  Doubles x, y, z;
};

using Column = std::array<double, ClassifiedPairs::most>;

/// The input of some pairs: corners as four doubles side by side, before they are transposed into lanes.
struct Staged {
  alignas(64) std::array<std::array<double, 4 * ClassifiedPairs::most>, 3> corner;
  alignas(64) Column height, squared_radius;
};

HWY_INLINE void copy_four(const double* from, double* to) {
  constexpr hn::CappedTag<double, 4> d4;
  for (std::size_t k = 0; k < 4; k += hn::Lanes(d4)) hn::Store(hn::Load(d4, from + k), d4, to + k);
}

HWY_INLINE void stage(const CircleTriangles& source, const CirclePoint* points, const Index* circle,
                      const Index* triangle, std::size_t count, Staged& staged) {
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle& corners = source.triangles[triangle[i]];
    for (std::size_t c = 0; c < 3; ++c)
      copy_four(source.vertices[corners[c]].at.data(), staged.corner[c].data() + 4 * i);
    const CirclePoint& point = points[circle[i]];
    staged.height[i] = point.z, staged.squared_radius[i] = point.squared_radius;
  }
}

HWY_INLINE Points3 if_then_else(hn::Mask<D> mask, const Points3& yes, const Points3& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

/// One end of each cut.
struct Ends {
  Doubles x, y, squared_radius;
};

/// Where edges from `apex` to `other` are at the height, from their lower corners upwards: upper - lower is
/// apex - other or, exactly, its negative, which leaves products and quotients of two such as they are.
HWY_INLINE Ends ends_of(const Points3& apex, const Points3& other, hn::Mask<D> apex_above, Doubles height) {
  const Points3 lower = if_then_else(apex_above, other, apex);
  const auto t = hn::Div(hn::Sub(height, lower.z), hn::Sub(apex.z, other.z));
  const auto x = hn::Add(lower.x, hn::Mul(t, hn::Sub(apex.x, other.x)));
  const auto y = hn::Add(lower.y, hn::Mul(t, hn::Sub(apex.y, other.y)));
  return {x, y, hn::Add(hn::Mul(x, x), hn::Mul(y, y))};
}

/// As `cut_at_height` in exact/circle_crossing.cpp, but for which end is p.
struct Cuts {
  Ends a, b;
  hn::Mask<D> a_is_p;
  /// The triangle lies above or below the height, or touches it from above; else there is a cut.
  hn::Mask<D> missed, touches;
};

/// Among corners 0, 1 and 2 one, the apex, is the only one on its side of the height; the others follow it in the
/// order 1, 2 or 0, 1 or, if 1 is the apex, reversed.
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
  const auto apex_is_0 = hn::AndNot(differ12, differ01), apex_is_1 = hn::And(differ01, differ12);
  const auto apex_is_2 = hn::AndNot(differ01, differ12);
  const Points3 apex = if_then_else(apex_is_0, p0, if_then_else(apex_is_1, p1, p2));
  const Points3 first = if_then_else(apex_is_0, p1, p0), second = if_then_else(apex_is_2, p1, p2);
  const auto apex_above = hn::Ge(apex.z, height);
  const auto all_above = hn::And(hn::And(above0, above1), above2);
  const auto any_above = hn::Or(hn::Or(above0, above1), above2);
  const auto lowest = hn::Min(hn::Min(p0.z, p1.z), p2.z);
  const auto touches = hn::And(all_above, hn::Eq(lowest, height));
  return {.a = ends_of(apex, first, apex_above, height),
          .b = ends_of(apex, second, apex_above, height),
          .a_is_p = hn::Xor(apex_above, apex_is_1),
          .missed = hn::Or(hn::Not(any_above), hn::AndNot(touches, all_above)),
          .touches = touches};
}

/// Chords along cuts from the end inside a circle, (x, y), to the end outside, and the class by the ends only.
struct Chords {
  alignas(64) Column x, y, end_squared_radius, dx, dy, crossing_class, point_x, point_y, squared_radius;
};

HWY_INLINE Doubles value(CrossingClass crossing_class) {
  return hn::Set(d, static_cast<double>(crossing_class));
}

/// Error bounds of rounding, in units of the scale M, as circle_predicates.cpp derives them.
struct Bounds {
  Doubles end, dot, discriminant;
};

HWY_INLINE Bounds bounds_of(double scale) {
  const double scale2 = scale * scale;
  return {.end = hn::Set(d, 96 * core::rounding_unit * scale2),
          .dot = hn::Set(d, 128 * core::rounding_unit * scale2),
          .discriminant = hn::Set(d, 1024 * core::rounding_unit * scale2 * scale2)};
}

/// For cuts with both ends beyond the circle, and (dx, dy) from q to p: certainly no chord of it.
HWY_INLINE hn::Mask<D> no_chord(const Ends& p, const Ends& q, Doubles dx, Doubles dy, Doubles squared_radius,
                                const Bounds& bounds) {
  const auto at_p = hn::Add(hn::Mul(p.x, dx), hn::Mul(p.y, dy));
  const auto at_q = hn::Add(hn::Mul(q.x, dx), hn::Mul(q.y, dy));
  const auto cross = hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x));
  const auto length2 = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
  const auto discriminant = hn::Sub(hn::Mul(squared_radius, length2), hn::Mul(cross, cross));
  return hn::Or(hn::Or(hn::Lt(at_p, hn::Neg(bounds.dot)), hn::Gt(at_q, bounds.dot)),
                hn::Lt(discriminant, hn::Neg(bounds.discriminant)));
}

/// Classifies pairs by the ends of their cuts. Writes the slots of those pairs that may cross, and returns how
/// many they are.
HWY_INLINE std::size_t classify_ends(const Staged& staged, double scale, std::size_t count, Chords& chords,
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
    const auto passage = hn::IfThenElse(hn::Xor(p_inside, in_order), value(CrossingClass::leaves),
                                        value(CrossingClass::enters));
    const auto crossing_class =
        hn::IfThenElse(hn::AndNot(touches, one), passage, value(CrossingClass::uncertain));
    const auto store = [&](Doubles values, Column& column) { hn::Store(values, d, column.data() + i); };
    store(x, chords.x), store(y, chords.y), store(dx, chords.dx), store(dy, chords.dy),
        store(crossing_class, chords.crossing_class);
    store(hn::IfThenElse(p_inside, p.squared_radius, q.squared_radius), chords.end_squared_radius);
    const auto may_cross = hn::AndNot(none, hn::FirstN(d, count - i));
    open_count += simd::store_lane_numbers(d, may_cross, i, open + open_count);
  }
  return open_count;
}

/// The fraction of the chord at which the circle is crossed: the operations of `crossing_point` in
/// exact/circle_crossing.cpp.
HWY_INLINE Doubles fraction_to_circle(Doubles x, Doubles y, Doubles squared, Doubles dx, Doubles dy,
                                      Doubles squared_radius) {
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const auto a = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), b = hn::Add(hn::Mul(x, dx), hn::Mul(y, dy));
  const auto c = hn::Min(zero, hn::Sub(squared, squared_radius));
  const auto root = hn::Sqrt(hn::Sub(hn::Mul(b, b), hn::Mul(a, c)));
  const auto outwards = hn::Gt(b, zero);
  const auto t = hn::Div(hn::IfThenElse(outwards, hn::Neg(c), hn::Sub(root, b)),
                         hn::IfThenElse(outwards, hn::Add(b, root), a));
  return hn::Min(hn::Max(t, zero), one);
}

/// Crossings err by less than 2^-13 where the radius is no less than 2^-20 M (see `add_crossings`): one that is
/// twice as far from the point is on the side of the point where it is computed.
HWY_INLINE void intersect_chords(double scale, const Chords& chords, ClassifiedPairs& out) {
  const auto least_radius2 = hn::Set(d, 0x1p-40 * scale * scale);
  const auto least_angle = hn::Set(d, FreeDirections::clearance);
  for (std::size_t k = 0; k < out.count; k += hn::Lanes(d)) {
    const auto of = [&](const Column& column) { return hn::Load(d, column.data() + k); };
    const auto px = of(chords.point_x), py = of(chords.point_y), squared_radius = of(chords.squared_radius);
    const auto x = of(chords.x), y = of(chords.y), dx = of(chords.dx), dy = of(chords.dy);
    const auto t = fraction_to_circle(x, y, of(chords.end_squared_radius), dx, dy, squared_radius);
    const auto at_x = hn::Add(x, hn::Mul(t, dx)), at_y = hn::Add(y, hn::Mul(t, dy));
    const auto angle = arctangent(d, hn::Sub(hn::Mul(px, at_y), hn::Mul(py, at_x)),
                                  hn::Add(hn::Mul(px, at_x), hn::Mul(py, at_y)));
    const auto certain = hn::And(hn::Gt(hn::Abs(angle), least_angle), hn::Ge(squared_radius, least_radius2));
    const auto crossing_class =
        hn::IfThenElse(certain, of(chords.crossing_class), value(CrossingClass::uncertain));
    hn::Store(angle, d, out.angle.data() + k), hn::Store(crossing_class, d, out.crossing_class.data() + k);
  }
}

void classify_any(const CircleTriangles& source, std::span<const CirclePoint> points,
                  std::span<const Index> circle, std::span<const Index> triangle, std::size_t first,
                  double scale, ClassifiedPairs& out) {
  const std::size_t count = std::min(triangle.size() - first, ClassifiedPairs::most);
  Staged staged;
  stage(source, points.data(), circle.data() + first, triangle.data() + first, count, staged);
  Chords chords;
  // Vectors are stored whole.
  std::array<std::uint32_t, ClassifiedPairs::most + 16> open;
  out.count = classify_ends(staged, scale, count, chords, open.data());
  // Compacted in place: no element moves to the place of a later one.
  for (std::size_t k = 0; k < out.count; ++k) {
    const std::size_t from = open[k], pair = first + from;
    for (Column* column :
         {&chords.x, &chords.y, &chords.end_squared_radius, &chords.dx, &chords.dy, &chords.crossing_class})
      (*column)[k] = (*column)[from];
    const CirclePoint& point = points[circle[pair]];
    chords.point_x[k] = point.x, chords.point_y[k] = point.y, chords.squared_radius[k] = point.squared_radius;
    out.pair[k] = pair;
  }
  intersect_chords(scale, chords, out);
}

}  // namespace
}  // namespace condyle::tangential::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::tangential {

HWY_EXPORT(classify_any);

/// Fourth powers of the scale neither overflow nor lose digits to underflow between these: beyond them
/// nothing is certain.
void classify_crossings(const CircleTriangles& source, std::span<const CirclePoint> points,
                        std::span<const Index> circle, std::span<const Index> triangle, std::size_t first,
                        ClassifiedPairs& out) {
  constexpr double least = 0x1p-220, greatest = 0x1p250;
  const bool usual = source.scale > least && source.scale < greatest;
  const double scale = usual ? 1.5 * source.scale : std::numeric_limits<double>::infinity();
  HWY_DYNAMIC_DISPATCH(classify_any)(source, points, circle, triangle, first, scale, out);
}

}  // namespace condyle::tangential
#endif
