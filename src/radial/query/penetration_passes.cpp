#include "radial/query/penetration_passes.hpp"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "radial/query/penetration_passes.cpp"
#include <hwy/foreach_target.h>
#include "simd/cube_projection-inl.hpp"
#include "simd/packed_intervals-inl.hpp"
#include "simd/prelude-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {
namespace {

using simd::HWY_NAMESPACE::interval_codes;
using simd::HWY_NAMESPACE::numbers_from;
using simd::HWY_NAMESPACE::store_compacted;

namespace hn = hwy::HWY_NAMESPACE;

/// Sixteen lanes at most: a block. Narrower vectors take several steps for one.
using D = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<D>;
using DU = hn::RebindToUnsigned<D>;
using Floats = hn::Vec<D>;
using Ints = hn::Vec<DI>;
using Words = hn::Vec<DU>;
constexpr D d;
constexpr DI di;
constexpr DU du;

using Projection = simd::HWY_NAMESPACE::CubeProjection<D>;

/// Column or row of `count` equal ones over [-1, 1], count up to 2^22. Added to 2^23, a float is rounded to a
/// whole number, which its last bits then are; half a column less, it is rounded down. Where it is on a
/// edge, either side may come out.
HWY_INLINE Ints column(Floats u, int count) {
  constexpr float shift = 0x1p23f;
  const float half = 0.5f * static_cast<float>(count);
  const auto half_less = hn::MulAdd(u, hn::Set(d, half), hn::Set(d, half - 0.5f));
  const auto whole = hn::Sub(hn::BitCast(di, hn::Add(half_less, hn::Set(d, shift))),
                             hn::Set(di, std::bit_cast<std::int32_t>(shift)));
  return hn::Min(hn::Max(whole, hn::Zero(di)), hn::Set(di, count - 1));
}

/// packed_interval(greatest, least): what an interval of radii must not exceed in either half to meet [least,
/// greatest].
HWY_INLINE Words reach(Ints least, Ints greatest) {
  return hn::BitCast(du, simd::HWY_NAMESPACE::packed_intervals(di, greatest, least));
}

/// Whether no half of the entry exceeds the reach's: the two intervals meet.
HWY_INLINE hn::Mask<DU> radii_meet(Words entry, Words reached) {
#if HWY_TARGET == HWY_SCALAR
  const std::uint32_t e = hn::GetLane(entry), w = hn::GetLane(reached);
  return hn::MaskFromVec(hn::Set(du, (e & 0xffff) <= (w & 0xffff) && e >> 16 <= w >> 16 ? ~0u : 0u));
#else
  constexpr hn::Repartition<std::uint16_t, DU> halves;
  const auto excess = hn::SaturatedSub(hn::BitCast(halves, entry), hn::BitCast(halves, reached));
  return hn::Eq(hn::BitCast(du, excess), hn::Zero(du));
#endif
}

HWY_INLINE Floats dot(Floats x, Floats y, Floats z, float a, float b, float c) {
  return hn::MulAdd(hn::Set(d, a), x, hn::MulAdd(hn::Set(d, b), y, hn::Mul(hn::Set(d, c), z)));
}

/// Level of the pyramid with slack for a displacement on the face, given in cells: see DirectionPyramid. With k
/// half the octaves above one cell that are begun, counting the second half from 3/2 on: 0 if there are
/// none, 1 up to two cells, then k itself.
HWY_INLINE Ints level_for(Floats cells) {
  const auto one = std::bit_cast<std::int32_t>(1.0f);
  const auto k = hn::ShiftRight<22>(hn::Sub(hn::BitCast(di, cells), hn::Set(di, one + 1)));
  return hn::IfThenZeroElse(hn::Lt(k, hn::Zero(di)), hn::Max(k, hn::Set(di, 1)));
}

/// Index into the pyramid, see DirectionPyramid::start_of.
HWY_INLINE Ints pyramid_index(const CubeView& cube, const Projection& place, Ints level) {
  const int finest = cube.cells_per_side;
  const auto pair = hn::Max(hn::Sub(level, hn::Set(di, 1)), hn::Zero(di));
  const auto shift = hn::BitCast(du, hn::ShiftRight<1>(pair));
  const auto at_level = [&](Ints value) { return hn::BitCast(di, hn::Shr(hn::BitCast(du, value), shift)); };
  const auto n = at_level(hn::Set(di, finest));
  const auto row = at_level(column(place.w, finest)), col = at_level(column(place.u, finest));
  const auto squares = hn::Set(di, finest * finest), own = hn::Mul(n, n);
  const auto before = hn::Add(hn::Set(di, 6 * finest * finest), hn::ShiftLeft<4>(hn::Sub(squares, own)));
  const auto start = hn::IfThenZeroElse(hn::Eq(level, hn::Zero(di)), before);
  // With two levels of tiles of one size the second is as the first, six faces further on.
  const auto face = hn::Add(place.face, hn::Mul(hn::And(pair, hn::Set(di, 1)), hn::Set(di, 6)));
  return hn::Add(start, hn::Add(hn::Mul(hn::Add(hn::Mul(face, n), row), n), col));
}

/// Squared radii, all within the least and the greatest, of what is up to `by` nearer or further away.
HWY_INLINE void widen(float by, Floats& least, Floats& greatest) {
  const auto zero = hn::Zero(d);
  const auto nearest = hn::Max(hn::Sub(hn::Sqrt(hn::Max(least, zero)), hn::Set(d, by)), zero);
  const auto furthest = hn::Add(hn::Sqrt(hn::Max(greatest, zero)), hn::Set(d, by));
  least = hn::Mul(nearest, nearest), greatest = hn::Mul(furthest, furthest);
}

/// A block's cap about R axis + t / |p| holds the directions of R p + t, and its radii grow as this says.
///
///     | R p + t - (|p| / m) (m R axis + t) | <= |p| chord + |t| | |p| / m - 1 |,   1 / m the mean inverse
///     | R p + t |^2 = |p|^2 + |t|^2 + 2 (R p) . t,   (R p) . t within |p| (R axis . t -+ chord |t|)
///
/// Margins: 2^-15 of squared radii and 2^-10 of the cap with a hundredth of a cell cover the floats here,
/// those of the points later, and a rotation that is one to 1e-6.
///
/// A surface that has drifted by d meets a radius r in a direction only where, as it was, it came to r - d or further out and
/// to r + d or further in, in directions that d is seen away.
///
/// Blocks from `block` on, one to a lane.
template <bool translated, bool drifted>
HWY_INLINE hn::Mask<DU> are_near(const CubeView& cube, const BlockColumns& blocks, const FloatPose& pose,
                                 std::size_t block) {
  const auto& r = pose.rotation;
  const auto one = hn::Set(d, 1.0f), distance = hn::Set(d, pose.distance);
  const float finest_cells = 0.5f * static_cast<float>(cube.cells_per_side);
  const auto x = hn::LoadU(d, blocks.axis_x + block), y = hn::LoadU(d, blocks.axis_y + block);
  const auto z = hn::LoadU(d, blocks.axis_z + block), chord = hn::LoadU(d, blocks.chord + block);
  auto ax = dot(x, y, z, r[0], r[1], r[2]), ay = dot(x, y, z, r[3], r[4], r[5]);
  auto az = dot(x, y, z, r[6], r[7], r[8]);
  const auto nearest = hn::LoadU(d, blocks.nearest + block), furthest = hn::LoadU(d, blocks.furthest + block);
  auto least = hn::Mul(nearest, nearest), greatest = hn::Mul(furthest, furthest);
  auto sine = chord;
  auto certain = hn::Gt(nearest, hn::Zero(d));
  if constexpr (translated) {
    const auto inverse = hn::LoadU(d, blocks.mean_inverse + block);
    const auto spread = hn::LoadU(d, blocks.spread + block);
    const auto along = dot(ax, ay, az, pose.translation[0], pose.translation[1], pose.translation[2]);
    ax = hn::MulAdd(hn::Set(d, pose.translation[0]), inverse, ax);
    ay = hn::MulAdd(hn::Set(d, pose.translation[1]), inverse, ay);
    az = hn::MulAdd(hn::Set(d, pose.translation[2]), inverse, az);
    const auto shift = hn::Mul(distance, hn::Add(inverse, spread));
    certain = hn::And(certain, hn::Lt(shift, hn::Set(d, 0.25f)));
    sine = hn::Div(hn::MulAdd(distance, spread, chord), hn::Sub(one, shift));
    const auto slack = hn::Mul(distance, chord), squared = hn::Mul(distance, distance);
    const auto two = hn::Set(d, 2.0f);
    least = hn::Add(squared, hn::MulAdd(hn::Mul(two, nearest), hn::Sub(along, slack), least));
    greatest = hn::Add(squared, hn::MulAdd(hn::Mul(two, furthest), hn::Add(along, slack), greatest));
  }
  if constexpr (drifted) {
    sine = hn::Add(sine, hn::Set(d, cube.drift.sine));
    widen(cube.drift.mm, least, greatest);
  }
  const Projection place(d, ax, ay, az);
  // With L the length of (1, u, w) and M that of (1, max(|u|, |w|)), a cap with that sine moves a coordinate of
  // the face by at most sine L M / (1 - sine L).
  const auto uu = hn::Mul(place.u, place.u), ww = hn::Mul(place.w, place.w);
  const auto length = hn::Sqrt(hn::Add(one, hn::Add(uu, ww)));
  const auto opening = hn::Mul(sine, length);
  const auto moved =
      hn::Div(hn::Mul(opening, hn::Sqrt(hn::Add(one, hn::Max(uu, ww)))), hn::Sub(one, opening));
  const auto cells = hn::Mul(moved, hn::Set(d, finest_cells * (1 + 0x1p-10f)));
  const auto level = level_for(hn::Add(cells, hn::Set(d, 0.01f)));
  const auto has_cells = hn::And(certain, hn::Lt(opening, hn::Set(d, 0.75f)));
  const auto in_pyramid = hn::And(hn::RebindMask(di, has_cells), hn::Lt(level, hn::Set(di, cube.levels)));
  const auto index =
      hn::IfThenElseZero(in_pyramid, pyramid_index(cube, place, hn::IfThenElseZero(in_pyramid, level)));
  const auto entry = hn::GatherIndex(du, cube.pyramid, index);
  const auto reached = reach(interval_codes(d, cube.scale, hn::Mul(least, hn::Set(d, 1 - 0x1p-15f))),
                             interval_codes(d, cube.scale, hn::Mul(greatest, hn::Set(d, 1 + 0x1p-15f))));
  // An interval too wide for the pyramid may be near.
  return hn::Or(radii_meet(entry, reached), hn::Not(hn::RebindMask(du, in_pyramid)));
}

template <bool translated, bool drifted>
std::size_t near_blocks(const CubeView& cube, const BlockColumns& blocks, const FloatPose& pose,
                        const std::uint32_t* parents, std::size_t parent_count, std::uint32_t* found) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < parent_count * 16; i += hn::Lanes(d)) {
    const std::size_t block = std::size_t{16} * parents[i / 16] + i % 16;
    const auto near = hn::And(are_near<translated, drifted>(cube, blocks, pose, block),
                              hn::FirstN(du, blocks.count - std::min(block, blocks.count)));
    const auto number = numbers_from(du, block);
    store_compacted(du, number, near, found + count);
    count += hn::CountTrue(du, near);
  }
  return count;
}

std::size_t near_blocks_any(const CubeView& cube, const BlockColumns& blocks, const FloatPose& pose,
                            const std::uint32_t* parents, std::size_t parent_count, std::uint32_t* found) {
  const auto find = [&](const auto& near) { return near(cube, blocks, pose, parents, parent_count, found); };
  if (cube.drift.mm > 0)
    return pose.distance > 0 ? find(near_blocks<true, true>) : find(near_blocks<false, true>);
  return pose.distance > 0 ? find(near_blocks<true, false>) : find(near_blocks<false, false>);
}

/// The least squared radius of an interval; one below the scale is taken for 0.
HWY_INLINE Floats least_of(const CubeView& cube, Words entry) {
  const auto code = hn::BitCast(di, hn::And(entry, hn::Set(du, 0xffff)));
  const auto bits = hn::Add(hn::Set(di, cube.scale.base), hn::ShiftLeftSame(code, cube.scale.shift));
  return hn::IfThenZeroElse(hn::RebindMask(d, hn::Eq(code, hn::Zero(di))), hn::BitCast(d, bits));
}

/// Squared radius beyond which no exit is the nearer one, as a code. A point at radius r that is inside
/// has crossed surface at l or beyond, l the least radius in its cell, if the centre is outside: the way back
/// there is at most r - l, and the ways to surface beyond 2 r - l are longer. With a = r^2 and b = l^2
///
///     (2 r - l)^2 = 4 a + b - 4 r l <= 4 a + b - 8 a b / (a + b),
///
/// as r l is the geometric mean of a and b, and at least their harmonic one. 2^-12 is far above the errors of
/// points and codes.
HWY_INLINE Words relevant_code(const CubeView& cube, Floats squared, Words entry) {
  if (cube.winding_at_centre > 0) return hn::Set(du, greatest_radius_code);
  const auto least = least_of(cube, entry);
  const auto harmonic = hn::Div(hn::Mul(squared, least), hn::Add(squared, least));
  const auto limit =
      hn::Add(hn::Mul(hn::Set(d, 4.0f), squared), hn::Sub(least, hn::Mul(hn::Set(d, 8.0f), harmonic)));
  return hn::BitCast(du, interval_codes(d, cube.scale, hn::Mul(limit, hn::Set(d, 1 + 0x1p-12f))));
}

/// The same of a surface that has drifted by d, from its triangles' least radii as they were: 2 r - (l - d) + d.
HWY_INLINE Words relevant_code_drifted(const CubeView& cube, Floats squared, Words entry) {
  if (cube.winding_at_centre > 0) return hn::Set(du, greatest_radius_code);
  const auto least = least_of(cube, entry);
  const auto limit = hn::Add(hn::Sub(hn::Mul(hn::Set(d, 2.0f), hn::Sqrt(squared)), hn::Sqrt(least)),
                             hn::Set(d, 2 * cube.drift.mm));
  const auto widened = hn::Mul(hn::Mul(limit, limit), hn::Set(d, 1 + 0x1p-12f));
  return hn::BitCast(du, interval_codes(d, cube.scale, widened));
}

template <bool drifted>
void near_points(const CubeView& cube, const PointColumns& points, const FloatPose& pose,
                 const std::uint32_t* blocks, std::size_t block_count, NearPoints& found) {
  const auto& r = pose.rotation;
  const auto& t = pose.translation;
  const int finest = cube.cells_per_side;
  const auto part_mask = hn::Set(di, parts_per_cell - 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < block_count; ++i) {
    const std::size_t first = std::size_t{16} * blocks[i];
    if (i + 4 < block_count) {
      const std::size_t ahead = std::size_t{16} * blocks[i + 4];
      hwy::Prefetch(points.x + ahead), hwy::Prefetch(points.y + ahead), hwy::Prefetch(points.z + ahead);
    }
    for (std::size_t at = first; at < first + 16; at += hn::Lanes(d)) {
      const auto px = hn::LoadU(d, points.x + at), py = hn::LoadU(d, points.y + at),
                 pz = hn::LoadU(d, points.z + at);
      const auto x = hn::Add(dot(px, py, pz, r[0], r[1], r[2]), hn::Set(d, t[0]));
      const auto y = hn::Add(dot(px, py, pz, r[3], r[4], r[5]), hn::Set(d, t[1]));
      const auto z = hn::Add(dot(px, py, pz, r[6], r[7], r[8]), hn::Set(d, t[2]));
      const auto squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
      auto least = squared, greatest = squared;
      if constexpr (drifted) widen(cube.drift.mm, least, greatest);
      const auto lowest = interval_codes(d, cube.scale, least);
      const auto highest = drifted ? interval_codes(d, cube.scale, greatest) : lowest;
      const Projection place(d, x, y, z);
      const auto u = column(place.u, finest * parts_per_cell), w = column(place.w, finest * parts_per_cell);
      const auto n = hn::Set(di, finest);
      const auto cell =
          hn::Add(hn::Mul(hn::Add(hn::Mul(place.face, n), hn::ShiftRight<8>(w)), n), hn::ShiftRight<8>(u));
      const auto entry = drifted ? hn::GatherIndex(du, cube.pyramid,
                                                   pyramid_index(cube, place, hn::Set(di, cube.drift.level)))
                                 : hn::GatherIndex(du, cube.radii, cell);
      auto near = radii_meet(entry, reach(lowest, highest));
      if (HWY_UNLIKELY(first + 16 > points.size)) {
        near = hn::And(near, hn::FirstN(du, points.size - std::min(at, points.size)));
      }
      if (hn::AllFalse(du, near)) continue;
      const auto u_part = hn::And(u, part_mask), w_part = hn::And(w, part_mask);
      const auto box =
          hn::Or(hn::Or(u_part, hn::ShiftLeft<8>(hn::Sub(part_mask, u_part))),
                 hn::Or(hn::ShiftLeft<16>(w_part), hn::ShiftLeft<24>(hn::Sub(part_mask, w_part))));
      const auto near_float = hn::RebindMask(d, near);
      store_compacted(d, x, near_float, found.x.data() + count);
      store_compacted(d, y, near_float, found.y.data() + count);
      store_compacted(d, z, near_float, found.z.data() + count);
      store_compacted(du, hn::BitCast(du, cell), near, found.cell.data() + count);
      store_compacted(du, hn::BitCast(du, box), near, found.box.data() + count);
      const auto relevant =
          drifted ? relevant_code_drifted(cube, squared, entry) : relevant_code(cube, squared, entry);
      store_compacted(du, relevant, near, found.relevant.data() + count);
      store_compacted(du, numbers_from(du, at), near, found.point.data() + count);
      count += hn::CountTrue(du, near);
    }
  }
  found.count = count;
}

void near_points_any(const CubeView& cube, const PointColumns& points, const FloatPose& pose,
                     const std::uint32_t* blocks, std::size_t block_count, NearPoints& found) {
  if (cube.drift.mm > 0)
    near_points<true>(cube, points, pose, blocks, block_count, found);
  else
    near_points<false>(cube, points, pose, blocks, block_count, found);
}

}  // namespace
}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::radial {

HWY_EXPORT(near_blocks_any);
HWY_EXPORT(near_points_any);

std::size_t near_blocks(const CubeView& cube, const BlockColumns& blocks, const FloatPose& pose,
                        const std::uint32_t* parents, std::size_t parent_count, std::uint32_t* found) {
  return HWY_DYNAMIC_DISPATCH(near_blocks_any)(cube, blocks, pose, parents, parent_count, found);
}

void near_points(const CubeView& cube, const PointColumns& points, const FloatPose& pose,
                 const std::uint32_t* blocks, std::size_t block_count, NearPoints& found) {
  HWY_DYNAMIC_DISPATCH(near_points_any)(cube, points, pose, blocks, block_count, found);
}

}  // namespace condyle::radial
#endif
