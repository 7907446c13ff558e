#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "radial/query/penetration_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "radial/query/crossing_pass.cpp"
#include <hwy/foreach_target.h>
#include "radial/query/crossing_decision-inl.hpp"
#include "simd/packed_ranges-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {
namespace {

using simd::HWY_NAMESPACE::range_excess;
using simd::HWY_NAMESPACE::store_compacted;

namespace hn = hwy::HWY_NAMESPACE;

using DU = hn::CappedTag<std::uint32_t, 16>;
using Words = hn::Vec<DU>;
constexpr DU du;

/// Zero in the lanes of those 8-DOPs from `first` on that hold the point.
HWY_INLINE Words excess_of_dops(const EntryView& entries, std::size_t first, Words box, Words diagonal) {
  const auto axis = hn::LoadU(du, entries.axis + first),
             of_diagonal = hn::LoadU(du, entries.diagonal + first);
  return hn::Or(range_excess(du, axis, box), range_excess(du, of_diagonal, diagonal));
}

/// Which of the 8-DOPs from `first` on hold the point.
HWY_INLINE hn::Mask<DU> dops_holding(const EntryView& entries, std::size_t first, std::size_t last, Words box,
                                     Words diagonal) {
  const auto excess = excess_of_dops(entries, first, box, diagonal);
  return hn::And(hn::Eq(excess, hn::Zero(du)), hn::FirstN(du, last - first));
}

void find_candidates_any(const EntryView& entries, std::span<const CellPlace> places, std::uint32_t* end,
                         std::uint32_t* found) {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const CellRow row = entries.row[places[i].cell];
    const Words axis = hn::Set(du, places[i].axis), diagonal = hn::Set(du, diagonal_of_point(places[i].axis));
    for (std::size_t first = row.first; first < row.last; first += hn::Lanes(du)) {
#if HWY_TARGET == HWY_EMU128
      // Emulated vectors are compacted lane by lane anyway.
      std::uint32_t excess[hn::MaxLanes(du)];
      hn::StoreU(excess_of_dops(entries, first, axis, diagonal), du, excess);
      const std::size_t lanes = std::min(hn::Lanes(du), row.last - first);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        found[count] = entries.triangle[first + lane];
        count += excess[lane] == 0;
      }
#else
      const auto holding = dops_holding(entries, first, row.last, axis, diagonal);
      // Sixteen lanes are compacted by one instruction, fewer by several: then it pays to see first.
      if (hn::MaxLanes(du) < 16 && hn::AllFalse(du, holding)) continue;
      store_compacted(du, hn::LoadU(du, entries.triangle + first), holding, found + count);
      count += static_cast<std::uint32_t>(hn::CountTrue(du, holding));
#endif
    }
    end[i] = count;
  }
}

/// Fills in QueryConstants.
HWY_INLINE void fill_constants(const NearPoints& points, float form_bound, QueryConstants& out) {
  constexpr hn::RebindToFloat<DU> d;
  const auto byte = hn::Set(du, 255);
  for (std::size_t i = 0; i < points.count; i += hn::Lanes(du)) {
    // As diagonal_of_point().
    const Words box = hn::Load(du, points.box.data() + i);
    const Words u = hn::And(box, byte), w = hn::And(hn::ShiftRight<16>(box), byte);
    const Words sum = hn::ShiftRight<1>(hn::Add(u, w));
    const Words difference = hn::ShiftRight<1>(hn::Add(hn::Sub(u, w), byte));
    const Words of_sum = hn::Or(sum, hn::ShiftLeft<8>(hn::Sub(byte, sum)));
    const Words of_difference = hn::Or(difference, hn::ShiftLeft<8>(hn::Sub(byte, difference)));
    hn::Store(hn::Or(of_sum, hn::ShiftLeft<16>(of_difference)), du, out.diagonal.data() + i);
    const auto magnitude = [&](const auto& of) { return hn::Abs(hn::Load(d, of.data() + i)); };
    const auto largest = hn::Max(hn::Max(magnitude(points.x), magnitude(points.y)), magnitude(points.z));
    hn::Store(hn::Mul(hn::Set(d, form_bound), largest), d, out.bound.data() + i);
  }
}

/// Pairs of one near point with triangles that may say something of it, written behind the `count` of the
/// others. Returns how many there are then; more than fit, where there are too many.
HWY_INLINE std::size_t gather_candidates(const CubeView& cube, const NearPoints& points,
                                         const QueryConstants& constants, std::size_t i, std::size_t count,
                                         Pairs& pairs) {
  const CellRow row = cube.entries.row[points.cell[i]].half_at(points.box[i]);
  const Words box = hn::Set(du, points.box[i]), diagonal = hn::Set(du, constants.diagonal[i]);
  const Words number = hn::Set(du, static_cast<std::uint32_t>(i));
  const Words relevant = hn::Set(du, points.relevant[i] >> 8);
  for (std::size_t first = row.first; first < row.last && count <= Pairs::most; first += hn::Lanes(du)) {
    const Words nearest = hn::PromoteTo(du, hn::LoadU(hn::Rebind<std::uint8_t, DU>(), cube.nearest + first));
    const auto holding = hn::And(dops_holding(cube.entries, first, row.last, box, diagonal),
                                 hn::Not(hn::Gt(nearest, relevant)));
    // As in find_candidates_any().
    if (hn::MaxLanes(du) < 16 && hn::AllFalse(du, holding)) continue;
    store_compacted(du, hn::LoadU(du, cube.entries.triangle + first), holding, pairs.triangle.data() + count);
    hn::StoreU(number, du, pairs.point.data() + count);
    count += hn::CountTrue(du, holding);
  }
  return count;
}

/// Lane k of four vectors as vector k.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void transpose(D, [[maybe_unused]] std::array<V, 4>& v) {
#if HWY_TARGET != HWY_SCALAR
  const V even_low = hn::InterleaveLower(v[0], v[2]), odd_low = hn::InterleaveLower(v[1], v[3]);
  const V even_high = hn::InterleaveUpper(D(), v[0], v[2]), odd_high = hn::InterleaveUpper(D(), v[1], v[3]);
  v = {hn::InterleaveLower(even_low, odd_low), hn::InterleaveUpper(D(), even_low, odd_low),
       hn::InterleaveLower(even_high, odd_high), hn::InterleaveUpper(D(), even_high, odd_high)};
#endif
}

/// Evaluates the forms of each pair, and keeps those that are not certainly misses, in order. `of_pairs` are they where the
/// table has none.
HWY_INLINE void evaluate_edges(const CubeView& cube, const NearPoints& points,
                               const QueryConstants& constants, const EdgeFunctions* of_pairs, Pairs& pairs,
                               Crossings& out) {
  // Four pairs side by side; without vectors one, of which each form is a "vector".
  constexpr hn::CappedTag<float, 4> d4;
  constexpr hn::RebindToUnsigned<decltype(d4)> du4;
  using V = hn::Vec<decltype(d4)>;
  constexpr std::size_t side_by_side = hn::MaxLanes(d4), ahead = 32;
  const std::size_t last = std::max(pairs.count, std::size_t{1}) - 1;
  for (std::size_t k = 0; pairs.count > 0 && k < ahead + side_by_side; ++k) {
    pairs.triangle[pairs.count + k] = pairs.triangle[last], pairs.point[pairs.count + k] = pairs.point[last];
  }
  const auto fetch = [&](std::size_t i) {
    if (!of_pairs) hwy::Prefetch(cube.edge_functions + pairs.triangle[i]);
  };
  for (std::size_t i = 0; i < std::min(ahead, pairs.count); ++i) fetch(i);
  std::size_t end = Crossings::begin;
  for (std::size_t i = 0; i < pairs.count; i += side_by_side) {
    std::array<V, 4> value, error;
    for (std::size_t k = 0; k < side_by_side; ++k) fetch(i + ahead + k);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t pair = side_by_side == 4 ? i + k : i, lane = side_by_side == 4 ? 0 : k;
      const EdgeFunctions& forms = of_pairs ? of_pairs[pair] : cube.edge_functions[pairs.triangle[pair]];
      const std::uint32_t point = pairs.point[pair];
      const auto x = hn::LoadU(d4, forms.x + lane), y = hn::LoadU(d4, forms.y + lane),
                 z = hn::LoadU(d4, forms.z + lane);
      value[k] =
          hn::MulAdd(hn::Set(d4, points.x[point]), x,
                     hn::MulAdd(hn::Set(d4, points.y[point]), y, hn::Mul(hn::Set(d4, points.z[point]), z)));
      error[k] =
          hn::Mul(hn::Set(d4, constants.bound[point]), hn::Add(hn::Abs(x), hn::Add(hn::Abs(y), hn::Abs(z))));
    }
    transpose(d4, value), transpose(d4, error);
    const auto below =
        hn::Or(hn::Lt(value[0], hn::Neg(error[0])),
               hn::Or(hn::Lt(value[1], hn::Neg(error[1])), hn::Lt(value[2], hn::Neg(error[2]))));
    const auto above =
        hn::And(hn::Gt(value[0], error[0]), hn::And(hn::Gt(value[1], error[1]), hn::Gt(value[2], error[2])));
    const auto s = hn::IfThenElse(above, value[3], hn::Set(d4, std::numeric_limits<float>::quiet_NaN()));
    const auto kept = hn::AndNot(below, hn::FirstN(d4, pairs.count - i));
    const auto kept_words = hn::RebindMask(du4, kept);
    store_compacted(d4, s, kept, out.s.data() + end);
    store_compacted(d4, error[3], kept, out.error.data() + end);
    store_compacted(du4, hn::LoadU(du4, pairs.triangle.data() + i), kept_words, out.triangle.data() + end);
    store_compacted(du4, hn::LoadU(du4, pairs.point.data() + i), kept_words, out.point.data() + end);
    end += hn::CountTrue(d4, kept);
  }
  out.close(end);
}

std::size_t inside_points_any(const CubeView& cube, const NearPoints& points, float form_bound,
                              CrossingScratch& scratch, PointResults& found) {
  Pairs& pairs = scratch.pairs;
  Crossings& crossings = scratch.crossings;
  QueryConstants& constants = scratch.constants;
  fill_constants(points, form_bound, constants);
  std::size_t tried = 0;
  found.count = 0;
  for (std::size_t first = 0; first < points.count;) {
    std::size_t last = first;
    pairs.count = 0;
    for (; last < points.count; ++last) {
      hwy::Prefetch(cube.entries.row + points.cell[std::min(last + 8, points.count - 1)]);
      const std::uint32_t row_ahead =
          cube.entries.row[points.cell[std::min(last + 4, points.count - 1)]].first;
      hwy::Prefetch(cube.entries.axis + row_ahead), hwy::Prefetch(cube.entries.diagonal + row_ahead);
      hwy::Prefetch(cube.entries.triangle + row_ahead), hwy::Prefetch(cube.nearest + row_ahead);
      const std::size_t count = gather_candidates(cube, points, constants, last, pairs.count, pairs);
      if (count > Pairs::most) break;
      pairs.count = count;
    }
    const EdgeFunctions* of_pairs = nullptr;
    if (!cube.edge_functions) of_pairs = scratch.forms.measure(cube, {pairs.triangle.data(), pairs.count});
    evaluate_edges(cube, points, constants, of_pairs, pairs, crossings);
    if (cube.winding_at_centre == 0) {
      decide_from_outside(points, crossings, scratch.decisions, found);
    } else {
      decide(cube, points, first, last, crossings, scratch.decisions, found);
    }
    tried += pairs.count;
    if (last == first) {
      // More triangles at one point than there is capacity for.
      found.point[found.count++] = PointResult::left_open(points.point[last++]);
    }
    first = last;
  }
  return tried;
}

}  // namespace
}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::radial {

HWY_EXPORT(find_candidates_any);
HWY_EXPORT(inside_points_any);

const EdgeFunctions* FormsOnDemand::measure(const CubeView& cube, std::span<const std::uint32_t> triangles) {
  corners_.resize(std::max(corners_.size(), triangles.size()));
  forms_.resize(std::max(forms_.size(), triangles.size() + vector_padding));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    std::copy_n(cube.mesh.corner + 3 * std::size_t{triangles[i]}, 3, corners_[i].data());
  MeshView view = cube.mesh;
  view.corner = corners_.empty() ? nullptr : corners_[0].data(), view.triangles = triangles.size();
  uncertain_.clear();
  count_ += triangles.size();
  measure_triangles(view, 0, triangles.size(), cube.scale, forms_.data(), uncertain_);
  return forms_.data();
}

void find_candidates(const EntryView& entries, std::span<const CellPlace> places, std::uint32_t* end,
                     std::uint32_t* found) {
  HWY_DYNAMIC_DISPATCH(find_candidates_any)(entries, places, end, found);
}

std::size_t inside_points(const CubeView& cube, const NearPoints& points, float form_bound,
                          CrossingScratch& scratch, PointResults& found) {
  return HWY_DYNAMIC_DISPATCH(inside_points_any)(cube, points, form_bound, scratch, found);
}

}  // namespace condyle::radial
#endif
