#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "condyle/radial/penetration_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "condyle/radial/crossing_pass.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "condyle/radial/compaction-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using DU = hn::CappedTag<std::uint32_t, 16>;
using Words = hn::Vec<DU>;
constexpr DU du;

/// Triangles whose octagons hold a point, with the number of the point among the near ones.
struct Pairs {
  static constexpr std::size_t most = 4096;
  std::array<std::uint32_t, most + vector_room> triangle, point;
  std::size_t count;
};

/// Which of the octagons from `first` on hold the point.
HWY_INLINE hn::Mask<DU> octagons_holding(const CubeView& cube, std::size_t first, std::size_t last, Words box,
                                         Words slant) {
#if HWY_TARGET == HWY_SCALAR
  static_cast<void>(last);
  const bool held = holds(cube.box[first], hn::GetLane(box)) && holds(cube.slant[first], hn::GetLane(slant));
  return hn::MaskFromVec(hn::Set(du, held ? ~0u : 0u));
#else
  constexpr hn::Repartition<std::uint8_t, DU> bytes;
  const auto excess = [&](const std::uint32_t* from, Words point) {
    return hn::SaturatedSub(hn::BitCast(bytes, hn::LoadU(du, from + first)), hn::BitCast(bytes, point));
  };
  const auto either = hn::Or(excess(cube.box, box), excess(cube.slant, slant));
  return hn::And(hn::Eq(hn::BitCast(du, either), hn::Zero(du)), hn::FirstN(du, last - first));
#endif
}

std::size_t triangles_holding_any(const CubeView& cube, std::uint32_t cell, std::uint32_t box,
                                  std::uint32_t* found) {
  const CellRow row = cube.row[cell];
  const Words of_box = hn::Set(du, box), of_slant = hn::Set(du, slant_of_point(box));
  std::size_t count = 0;
  for (std::size_t first = row.first; first < row.last; first += hn::Lanes(du)) {
    const auto holding = octagons_holding(cube, first, row.last, of_box, of_slant);
    store_compacted(du, hn::LoadU(du, cube.triangle + first), holding, found + count);
    count += hn::CountTrue(du, holding);
  }
  return count;
}

/// Pairs of one near point with triangles that may say something of it, added to the others; false where
/// there are too many.
HWY_INLINE bool pair(const CubeView& cube, const NearPoints& points, std::size_t i, Pairs& pairs) {
  const CellRow row = cube.row[points.cell[i]];
  const Words box = hn::Set(du, points.box[i]), slant = hn::Set(du, slant_of_point(points.box[i]));
  const Words number = hn::Set(du, static_cast<std::uint32_t>(i));
  const Words relevant = hn::Set(du, points.relevant[i]);
  for (std::size_t first = row.first; first < row.last; first += hn::Lanes(du)) {
    const Words nearest = hn::PromoteTo(du, hn::LoadU(hn::Rebind<std::uint16_t, DU>(), cube.nearest + first));
    const auto holding =
        hn::And(octagons_holding(cube, first, row.last, box, slant), hn::Not(hn::Gt(nearest, relevant)));
    // Sixteen lanes are compacted by one instruction, fewer by several: then it pays to see first.
    if (hn::MaxLanes(du) < 16 && hn::AllFalse(du, holding)) continue;
    store_compacted(du, hn::LoadU(du, cube.triangle + first), holding, pairs.triangle.data() + pairs.count);
    hn::StoreU(number, du, pairs.point.data() + pairs.count);
    pairs.count += hn::CountTrue(du, holding);
    if (pairs.count > Pairs::most - vector_room) return false;
  }
  return true;
}

/// A crossing of a near point's ray: s is |v| over its radius, NaN where floats do not say whether there is
/// one.
struct Crossing {
  float s, error;
  std::uint32_t triangle, point;
  std::int32_t outwards;  // 1 where the ray leaves the solid, -1 where it enters
};
struct Crossings {
  std::array<Crossing, Pairs::most + 1> crossing;
  std::size_t count;
};

/// Evaluates the forms of each pair, and keeps those that are not certainly misses, in order.
HWY_INLINE void cross(const CubeView& cube, const NearPoints& points, const Pairs& pairs, float form_bound,
                      Crossings& out) {
  constexpr hn::CappedTag<float, 4> d4;
  constexpr std::size_t ahead = 32;
  // Forms may lie across two lines of the cache.
  const auto fetch = [&](std::size_t i) {
    const ConeForms& forms = cube.forms[pairs.triangle[std::min(i, pairs.count - 1)]];
    hwy::Prefetch(forms.x), hwy::Prefetch(forms.z + 3);
  };
  for (std::size_t i = 0; i < std::min(ahead, pairs.count); ++i) fetch(i);
  std::size_t count = 0;
  for (std::size_t i = 0; i < pairs.count; ++i) {
    fetch(i + ahead);
    const std::uint32_t triangle = pairs.triangle[i], point = pairs.point[i];
    const ConeForms& forms = cube.forms[triangle];
    const float px = points.x[point], py = points.y[point], pz = points.z[point];
    const float bound = form_bound * std::max(std::max(std::abs(px), std::abs(py)), std::abs(pz));
    alignas(16) float values[4], errors[4];
    unsigned below = 0, above = 0;
    for (std::size_t k = 0; k < 4; k += hn::Lanes(d4)) {
      const auto x = hn::Load(d4, forms.x + k), y = hn::Load(d4, forms.y + k), z = hn::Load(d4, forms.z + k);
      const auto value =
          hn::MulAdd(hn::Set(d4, px), x, hn::MulAdd(hn::Set(d4, py), y, hn::Mul(hn::Set(d4, pz), z)));
      const auto error = hn::Mul(hn::Set(d4, bound), hn::Add(hn::Abs(x), hn::Add(hn::Abs(y), hn::Abs(z))));
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d4, hn::Lt(value, hn::Neg(error)), bits);
      below |= static_cast<unsigned>(bits[0]) << k;
      hn::StoreMaskBits(d4, hn::Gt(value, error), bits);
      above |= static_cast<unsigned>(bits[0]) << k;
      hn::Store(value, d4, values + k);
      hn::Store(error, d4, errors + k);
    }
    // Without branches, which nothing could foretell: all bits of a magnitude set are a NaN.
    const std::uint32_t bits_of_value = std::bit_cast<std::uint32_t>(values[3]);
    const std::uint32_t doubt = 0u - static_cast<std::uint32_t>((above & 7) != 7);
    out.crossing[count] = {std::bit_cast<float>((bits_of_value | doubt) & 0x7fffffffu), errors[3], triangle,
                           point, 1 - 2 * static_cast<std::int32_t>(bits_of_value >> 31)};
    count += static_cast<std::size_t>((below & 7) == 0);
  }
  out.count = count;
}

/// What the crossings of one ray say of its point. They stay where they are: copied whole, right after they
/// were written in parts, each would hold the processor up.
struct Ray {
  static constexpr std::size_t most = 24;
  std::span<Crossing> crossings;
  int winding;  // of the point
  bool doubtful;

  Ray(std::span<Crossing> its, int winding_at_centre)
      : crossings(its), winding(winding_at_centre), doubtful(its.size() > most) {
    for (const Crossing& crossing : crossings) {
      const float beyond = crossing.s - 1;
      doubtful |= !(std::abs(beyond) > crossing.error);
      winding -= beyond > 0 ? crossing.outwards : 0;
    }
  }

  /// From the centre outwards.
  void sort() {
    for (std::size_t i = 1; i < crossings.size(); ++i) {
      for (std::size_t k = i; k > 0 && crossings[k - 1].s < crossings[k].s; --k) {
        std::swap(crossings[k - 1], crossings[k]);
      }
    }
  }
};

/// The triangle through which a point inside leaves, by the nearer way; false where floats cannot tell.
///
/// Crossings in order from the centre have falling s. The gaps 1 - 1/s before and 1/s' - 1 behind compare as
/// 2 s s' does with s + s'.
HWY_INLINE bool leave(Ray& ray, int winding_at_centre, FoundPoint& found) {
  ray.sort();
  for (std::size_t i = 1; i < ray.crossings.size(); ++i) {
    const Crossing &nearer = ray.crossings[i - 1], &further = ray.crossings[i];
    if (!(nearer.s - further.s > nearer.error + further.error)) return false;
  }
  const Crossing *before = nullptr, *after = nullptr;
  int winding = winding_at_centre;
  for (const Crossing& crossing : ray.crossings) {
    const bool was_inside = winding > 0;
    winding -= crossing.outwards;
    if (was_inside == (winding > 0)) continue;
    if (crossing.s > 1) {
      before = &crossing;
    } else if (!after) {
      after = &crossing;
    }
  }
  // Surface that is too far behind to matter was not looked at, unless the centre is inside.
  if (!after && (!before || winding_at_centre > 0)) return false;
  found.away_from_centre = !before;
  if (before && after) {
    const float b = before->s, a = after->s;
    const float difference = a + b - 2 * a * b;
    const float error = 1.01f * (before->error * (1 + 2 * a) + after->error * (1 + 2 * b));
    if (!(std::abs(difference) > error)) return false;
    found.away_from_centre = difference < 0;
  }
  found.triangle = (found.away_from_centre ? after : before)->triangle;
  return true;
}

/// Decides near points [first, last), whose crossings these are.
HWY_INLINE void decide(const CubeView& cube, const NearPoints& points, std::size_t first, std::size_t last,
                       Crossings& crossings, FoundPoints& found) {
  Crossing *next = crossings.crossing.data(), *const end = next + crossings.count;
  for (std::size_t i = first; i < last; ++i) {
    Crossing* const begin = next;
    while (next != end && next->point == i) ++next;
    Ray ray({begin, next}, cube.winding_at_centre);
    if (cube.winding_at_centre > 0) {
      // Nearer to the centre than any surface, floats may have lost the direction.
      const float x = points.x[i], y = points.y[i], z = points.z[i];
      ray.doubtful |= x * x + y * y + z * z < cube.nearest_squared;
    }
    if (!ray.doubtful && ray.winding <= 0) continue;
    FoundPoint& at = found.point[found.count++];
    at.point = points.point[i];
    at.triangle = no_index;
    at.winding = static_cast<std::int16_t>(ray.winding);
    at.doubtful = ray.doubtful || !leave(ray, cube.winding_at_centre, at);
  }
}

std::size_t inside_points_any(const CubeView& cube, const NearPoints& points, float form_bound,
                              FoundPoints& found) {
  Pairs pairs;
  Crossings crossings;
  std::size_t tried = 0;
  found.count = 0;
  for (std::size_t first = 0; first < points.count;) {
    std::size_t last = first;
    pairs.count = 0;
    bool fits = true;
    while (last < points.count && fits) {
      const std::size_t before = pairs.count;
      hwy::Prefetch(cube.row + points.cell[std::min(last + 8, points.count - 1)]);
      const std::uint32_t row_ahead = cube.row[points.cell[std::min(last + 4, points.count - 1)]].first;
      hwy::Prefetch(cube.box + row_ahead), hwy::Prefetch(cube.slant + row_ahead);
      hwy::Prefetch(cube.triangle + row_ahead);
      fits = pair(cube, points, last, pairs);
      if (fits) {
        ++last;
      } else {
        pairs.count = before;
      }
    }
    cross(cube, points, pairs, form_bound, crossings);
    decide(cube, points, first, last, crossings, found);
    tried += pairs.count;
    if (last == first) {
      // More triangles at one point than there is room for.
      found.point[found.count++] = {points.point[last++], no_index, 0, false, true};
    }
    first = last;
  }
  return tried;
}

}  // namespace
}  // namespace condyle::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle {

HWY_EXPORT(triangles_holding_any);
HWY_EXPORT(inside_points_any);

std::size_t triangles_holding(const CubeView& cube, std::uint32_t cell, std::uint32_t box,
                              std::uint32_t* found) {
  return HWY_DYNAMIC_DISPATCH(triangles_holding_any)(cube, cell, box, found);
}

std::size_t inside_points(const CubeView& cube, const NearPoints& points, float form_bound,
                          FoundPoints& found) {
  return HWY_DYNAMIC_DISPATCH(inside_points_any)(cube, points, form_bound, found);
}

}  // namespace condyle
#endif
