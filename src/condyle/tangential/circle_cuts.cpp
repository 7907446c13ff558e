#include "condyle/tangential/circle_cuts.hpp"

#include "condyle/core/predicates.hpp"
#include "condyle/tangential/free_directions.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "condyle/tangential/circle_cuts.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "condyle/tangential/arctangent-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using Doubles = hn::Vec<D>;
constexpr D d;

struct Ends {
  Doubles x, y, squared_radius;
};

/// One end of the cuts, from the lower corner to the upper one.
HWY_INLINE Ends ends_of(const CutColumns& c, std::size_t lower, Doubles height, std::size_t i) {
  const auto at = [&](const std::array<CutColumns::Column, 4>& column, std::size_t k) {
    return hn::Load(d, column[k].data() + i);
  };
  const auto lx = at(c.x, lower), ly = at(c.y, lower), lz = at(c.z, lower);
  const auto t = hn::Div(hn::Sub(height, lz), hn::Sub(at(c.z, lower + 1), lz));
  const auto x = hn::Add(lx, hn::Mul(t, hn::Sub(at(c.x, lower + 1), lx)));
  const auto y = hn::Add(ly, hn::Mul(t, hn::Sub(at(c.y, lower + 1), ly)));
  return {x, y, hn::Add(hn::Mul(x, x), hn::Mul(y, y))};
}

/// The fraction of the way from a place within the circle, which is at (x, y), to one beyond it at which it
/// is left. The operations of `way_out` in circle_crossing.cpp.
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

/// Bounds in units of the scale M as those of circle_predicates.cpp, where they are derived.
///
/// Crossings err by less than 2^-13 where the radius is no less than 2^-20 M (see `add_crossings`): what is
/// twice as far from the point is on the side of the point where it seems to be.
void decide_any(CutColumns& c, std::size_t count, double scale) {
  const double scale2 = scale * scale;
  const auto end_bound = hn::Set(d, 96 * rounding_unit * scale2);
  const auto dot_bound = hn::Set(d, 128 * rounding_unit * scale2);
  const auto room_bound = hn::Set(d, 1024 * rounding_unit * scale2 * scale2);
  const auto least_radius2 = hn::Set(d, 0x1p-40 * scale2),
             least_angle = hn::Set(d, FreeDirections::clearance);
  const auto one = hn::Set(d, 1.0);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto px = hn::Load(d, c.point_x.data() + i), py = hn::Load(d, c.point_y.data() + i);
    const auto squared_radius = hn::Load(d, c.squared_radius.data() + i);
    const auto height = hn::Load(d, c.height.data() + i);
    const Ends p = ends_of(c, 0, height, i), q = ends_of(c, 2, height, i);
    const auto p_value = hn::Sub(p.squared_radius, squared_radius);
    const auto q_value = hn::Sub(q.squared_radius, squared_radius);
    const auto p_inside = hn::Lt(p_value, hn::Neg(end_bound)), p_outside = hn::Gt(p_value, end_bound);
    const auto q_inside = hn::Lt(q_value, hn::Neg(end_bound)), q_outside = hn::Gt(q_value, end_bound);

    // From the end inside to the end outside.
    const auto x = hn::IfThenElse(p_inside, p.x, q.x), y = hn::IfThenElse(p_inside, p.y, q.y);
    const auto squared = hn::IfThenElse(p_inside, p.squared_radius, q.squared_radius);
    const auto dx = hn::Sub(hn::IfThenElse(p_inside, q.x, p.x), x);
    const auto dy = hn::Sub(hn::IfThenElse(p_inside, q.y, p.y), y);
    const auto t = fraction_to_circle(x, y, squared, dx, dy, squared_radius);
    const auto at_x = hn::Add(x, hn::Mul(t, dx)), at_y = hn::Add(y, hn::Mul(t, dy));
    const auto angle = arctangent(d, hn::Sub(hn::Mul(px, at_y), hn::Mul(py, at_x)),
                                  hn::Add(hn::Mul(px, at_x), hn::Mul(py, at_y)));
    const auto crosses = hn::Or(hn::And(p_inside, q_outside), hn::And(q_inside, p_outside));
    const auto crossing =
        hn::And(hn::And(crosses, hn::Gt(hn::Abs(angle), least_angle)), hn::Ge(squared_radius, least_radius2));

    // Both ends beyond the circle: dx and dy are those from q to p then.
    const auto at_p = hn::Add(hn::Mul(p.x, dx), hn::Mul(p.y, dy));
    const auto at_q = hn::Add(hn::Mul(q.x, dx), hn::Mul(q.y, dy));
    const auto turn = hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x));
    const auto length2 = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
    const auto room = hn::Sub(hn::Mul(squared_radius, length2), hn::Mul(turn, turn));
    const auto away = hn::Or(hn::Or(hn::Lt(at_p, hn::Neg(dot_bound)), hn::Gt(at_q, dot_bound)),
                             hn::Lt(room, hn::Neg(room_bound)));
    const auto none = hn::Or(hn::And(p_inside, q_inside), hn::And(hn::And(p_outside, q_outside), away));

    const auto passage = hn::IfThenElse(p_inside, one, hn::Neg(one));
    const auto undecided = hn::Set(d, static_cast<double>(CutVerdict::undecided));
    const auto verdict = hn::IfThenElse(crossing, passage, hn::IfThenZeroElse(none, undecided));
    hn::Store(angle, d, c.angle.data() + i), hn::Store(verdict, d, c.verdict.data() + i);
  }
}

}  // namespace
}  // namespace condyle::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle {

HWY_EXPORT(decide_any);

/// Below this scale bounds lose digits to underflow: nothing is certain then.
void CircleCuts::decide() noexcept {
  constexpr double least_scale = 0x1p-220;
  const double scale = scale_ > least_scale ? scale_ : std::numeric_limits<double>::infinity();
  HWY_DYNAMIC_DISPATCH(decide_any)(columns_, count_, scale);
}

}  // namespace condyle
#endif
