// Included once for every instruction set, by the pass that finds crossings.
#if defined(CONDYLE_RADIAL_CROSSING_DECISION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_RADIAL_CROSSING_DECISION_INL
#undef CONDYLE_RADIAL_CROSSING_DECISION_INL
#else
#define CONDYLE_RADIAL_CROSSING_DECISION_INL
#endif

#include "simd/prelude-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {
namespace {

using simd::HWY_NAMESPACE::numbers_from;
using simd::HWY_NAMESPACE::store_compacted;

/// More crossings of one ray are left to double precision.
constexpr std::size_t most_of_a_ray = 24;

/// The crossings of one ray from the centre outwards: with falling |s|.
struct Ray {
  struct Crossing {
    float s, error;
    int outwards;
    std::uint32_t triangle;
  };
  std::array<Crossing, most_of_a_ray> crossing;
  std::size_t count = 0;

  Ray(const Crossings& all, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::size_t k = count++;
      const Crossing next{std::abs(all.s[i]), all.error[i], all.s[i] > 0 ? 1 : -1, all.triangle[i]};
      for (; k > 0 && crossing[k - 1].s < next.s; --k) crossing[k] = crossing[k - 1];
      crossing[k] = next;
    }
  }
};

struct NearestExit {
  std::uint32_t triangle;
  bool away_from_centre;
};

/// The triangle through which a point inside leaves, by the nearer exit; false if floats cannot decide.
///
/// The gaps 1 - 1/s before and 1/s' - 1 behind compare as 2 s s' does with s + s'.
HWY_INLINE bool nearest_exit(const Ray& ray, int winding_at_centre, NearestExit& way) {
  using Crossing = Ray::Crossing;
  for (std::size_t i = 1; i < ray.count; ++i) {
    const Crossing &nearer = ray.crossing[i - 1], &further = ray.crossing[i];
    if (!(nearer.s - further.s > nearer.error + further.error)) return false;
  }
  const Crossing *before = nullptr, *after = nullptr;
  int winding = winding_at_centre;
  for (std::size_t i = 0; i < ray.count; ++i) {
    const Crossing& crossing = ray.crossing[i];
    const bool was_inside = winding > 0;
    winding -= crossing.outwards;
    if (was_inside == (winding > 0)) continue;
    if (crossing.s > 1) {
      before = &crossing;
    } else if (!after) {
      after = &crossing;
    }
  }
  // Surface that is too far behind to matter was not tested, unless the centre is inside.
  if (!after && (!before || winding_at_centre > 0)) return false;
  way.away_from_centre = !before;
  if (before && after) {
    const float b = before->s, a = after->s;
    const float difference = a + b - 2 * a * b;
    const float error = 1.01f * (before->error * (1 + 2 * a) + after->error * (1 + 2 * b));
    if (!(std::abs(difference) > error)) return false;
    way.away_from_centre = difference < 0;
  }
  way.triangle = (way.away_from_centre ? after : before)->triangle;
  return true;
}

/// Decides near points [first, last), whose crossings these are, wherever the centre is.
HWY_INLINE void decide(const CubeView& cube, const NearPoints& points, std::size_t first, std::size_t last,
                       const Crossings& crossings, Decisions& scratch, PointResults& found) {
  const bool from_inside = cube.winding_at_centre > 0;
  for (std::size_t i = first; i < last; ++i) {
    // Nearer to the centre than any surface, floats may have lost the direction.
    const float x = points.x[i], y = points.y[i], z = points.z[i];
    const bool too_near = from_inside && x * x + y * y + z * z < cube.nearest_squared;
    scratch.sum[i] = {.winding = static_cast<std::int16_t>(cube.winding_at_centre),
                      .crossings = 0,
                      .end = 0,
                      .uncertain = too_near};
  }
  for (std::size_t i = Crossings::begin; i < crossings.end; ++i) {
    CrossingSum& sum = scratch.sum[crossings.point[i]];
    const float beyond = std::abs(crossings.s[i]) - 1;
    const int outwards = crossings.s[i] > 0 ? 1 : -1;
    sum.winding = static_cast<std::int16_t>(sum.winding - (beyond > 0 ? outwards : 0));
    sum.uncertain |= static_cast<std::uint8_t>(!(std::abs(beyond) > crossings.error[i]));
    ++sum.crossings;
    sum.end = static_cast<std::uint32_t>(i + 1);
  }
  std::size_t count = 0;
  for (std::size_t i = first; i < last; ++i) {
    CrossingSum& sum = scratch.sum[i];
    sum.uncertain |= static_cast<std::uint8_t>(sum.crossings > most_of_a_ray);
    scratch.kept[count] = static_cast<std::uint32_t>(i);
    count += static_cast<std::size_t>((sum.uncertain != 0) | (sum.winding > 0));
  }
  for (std::size_t k = 0; k < count; ++k) {
    const CrossingSum& sum = scratch.sum[scratch.kept[k]];
    NearestExit way{no_index, false};
    const bool uncertain = sum.uncertain || !nearest_exit(Ray(crossings, sum.end - sum.crossings, sum.end),
                                                          cube.winding_at_centre, way);
    found.point[found.count++] = {.point = points.point[scratch.kept[k]],
                                  .triangle = way.triangle,
                                  .winding = sum.winding,
                                  .away_from_centre = way.away_from_centre,
                                  .uncertain = uncertain};
  }
}

/// Result of the crossings of a ray, the last of which is at `last`, for its point, the centre outside.
struct PointCrossings {
  int winding;
  bool uncertain;
  bool has_exit;  ///< `way` is the nearest exit of a point that is inside
  NearestExit way;
};

HWY_INLINE PointCrossings classify_scalar(const Crossings& all, std::size_t last) {
  PointCrossings out{.winding = 0, .uncertain = false, .has_exit = false, .way = {no_index, false}};
  std::size_t begin = last + 1;
  for (; all.point[begin - 1] == all.point[last]; --begin) {
    const float beyond = std::abs(all.s[begin - 1]) - 1;
    if (beyond > 0) out.winding += all.s[begin - 1] > 0 ? -1 : 1;
    out.uncertain |= !(std::abs(beyond) > all.error[begin - 1]);
  }
  out.uncertain |= last + 1 - begin > most_of_a_ray;
  out.has_exit = !out.uncertain && out.winding > 0 && nearest_exit(Ray(all, begin, last + 1), 0, out.way);
  return out;
}

/// As classify_scalar(), for no more crossings than a vector of four has lanes: nearly all. Where the crossing
/// nearest before the point certainly is that and enters the solid, and the one nearest behind it certainly
/// is that and leaves it, these are the exits, if the winding number is 1. No branch asks which is the
/// shorter, nor whether the point is inside: it cannot be predicted.
HWY_INLINE PointCrossings classify_vector(const Crossings& all, std::size_t last) {
  namespace hn = hwy::HWY_NAMESPACE;
  constexpr hn::CappedTag<float, 4> d;
  constexpr hn::RebindToUnsigned<decltype(d)> du;
  const std::size_t begin = last + 1 - hn::MaxLanes(d);
  const auto valid =
      hn::RebindMask(d, hn::Eq(hn::LoadU(du, all.point.data() + begin), hn::Set(du, all.point[last])));
  const auto with_sign = hn::LoadU(d, all.s.data() + begin), error = hn::LoadU(d, all.error.data() + begin);
  const auto s = hn::Abs(with_sign), beyond = hn::Sub(s, hn::Set(d, 1.0f));
  const auto is_before = hn::And(valid, hn::Gt(beyond, hn::Zero(d))), is_after = hn::AndNot(is_before, valid);
  const auto leaving = hn::And(is_before, hn::Gt(with_sign, hn::Zero(d)));
  const auto uncertain = hn::AndNot(hn::Gt(hn::Abs(beyond), error), valid);
  const int winding =
      static_cast<int>(hn::CountTrue(d, is_before)) - 2 * static_cast<int>(hn::CountTrue(d, leaving));
  const auto before =
      hn::MinOfLanes(d, hn::IfThenElse(is_before, s, hn::Set(d, std::numeric_limits<float>::max())));
  const auto after = hn::MaxOfLanes(d, hn::IfThenElseZero(is_after, s));
  const auto at = [&](hn::Mask<decltype(d)> mask) {
    return begin + static_cast<std::size_t>(std::max<std::intptr_t>(hn::FindFirstTrue(d, mask), 0));
  };
  const std::size_t at_before = at(hn::And(is_before, hn::Eq(s, before)));
  const std::size_t at_after = at(hn::And(is_after, hn::Eq(s, after)));
  const bool has_after = !hn::AllFalse(d, is_after);
  const float b = hn::GetLane(before), a = hn::GetLane(after);
  const float error_before = all.error[at_before], error_after = has_after ? all.error[at_after] : 0;
  // Each is too near to itself, and no other may be.
  const auto near_before =
      hn::And(is_before, hn::Not(hn::Gt(hn::Sub(s, before), hn::Add(error, hn::Set(d, error_before)))));
  const auto near_after =
      hn::And(is_after, hn::Not(hn::Gt(hn::Sub(after, s), hn::Add(error, hn::Set(d, error_after)))));
  // Bits, for a branch on each could not be predicted.
  const auto bit = [](bool value) { return static_cast<unsigned>(value); };
  const unsigned in_order = bit(hn::CountTrue(d, near_before) == 1) & bit(hn::CountTrue(d, near_after) <= 1);
  const unsigned passes = bit(all.s[at_before] < 0) & (bit(!has_after) | bit(all.s[at_after] > 0));
  const float difference = a + b - 2 * a * b;
  const float error_sum = 1.01f * (error_before * (1 + 2 * a) + error_after * (1 + 2 * b));
  const bool away_from_centre = difference < 0;
  const unsigned is_clear = in_order & passes & bit(winding == 1) & bit(std::abs(difference) > error_sum);
  return {.winding = winding,
          .uncertain = !hn::AllFalse(d, uncertain),
          .has_exit = is_clear != 0,
          .way = {all.triangle[away_from_centre ? at_after : at_before], away_from_centre}};
}

/// Decides the near points that have crossings, the centre outside: the others are outside too. Most points
/// have one, and are inside exactly where that lies before them and enters the solid.
HWY_INLINE void decide_from_outside(const NearPoints& points, const Crossings& crossings, Decisions& scratch,
                                    PointResults& found) {
  namespace hn = hwy::HWY_NAMESPACE;
  constexpr hn::CappedTag<float, 16> d;
  constexpr hn::RebindToUnsigned<decltype(d)> du;
  const auto one = hn::Set(d, 1.0f);
  std::size_t count = 0;
  for (std::size_t i = Crossings::begin; i < crossings.end; i += hn::Lanes(d)) {
    const std::uint32_t* point = crossings.point.data() + i;
    const auto own = hn::LoadU(du, point);
    const auto is_last = hn::And(hn::Ne(own, hn::LoadU(du, point + 1)), hn::FirstN(du, crossings.end - i));
    const auto is_first = hn::Ne(own, hn::LoadU(du, point - 1));
    const auto s = hn::LoadU(d, crossings.s.data() + i);
    const auto certain = hn::Gt(hn::Abs(hn::Sub(hn::Abs(s), one)), hn::LoadU(d, crossings.error.data() + i));
    const auto outside = hn::RebindMask(du, hn::And(certain, hn::Gt(s, hn::Neg(one))));
    const auto kept = hn::AndNot(hn::And(is_first, outside), is_last);
    store_compacted(du, numbers_from(du, i), kept, scratch.kept.data() + count);
    count += hn::CountTrue(du, kept);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t last = scratch.kept[k];
    const std::uint32_t point = crossings.point[last];
    PointResult& at = found.point[found.count];
    if (crossings.point[last - 1] != point) {
      const bool certain = std::abs(std::abs(crossings.s[last]) - 1) > crossings.error[last];
      at = {.point = points.point[point],
            .triangle = crossings.triangle[last],
            .winding = 1,
            .away_from_centre = false,
            .uncertain = !certain};
      ++found.count;
      continue;
    }
    constexpr std::size_t few = hn::MaxLanes(hn::CappedTag<float, 4>());
    PointCrossings all = classify_vector(crossings, last);
    const bool are_few = crossings.point[last - few] != point;
    if (HWY_UNLIKELY(!are_few || (all.winding > 0 && !all.uncertain && !all.has_exit))) {
      all = classify_scalar(crossings, last);
    }
    at = {.point = points.point[point],
          .triangle = all.way.triangle,
          .winding = static_cast<std::int16_t>(all.winding),
          .away_from_centre = all.way.away_from_centre,
          .uncertain = all.uncertain || !all.has_exit};
    found.count += static_cast<std::size_t>(all.uncertain) | static_cast<std::size_t>(all.winding > 0);
  }
}

}  // namespace
}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
