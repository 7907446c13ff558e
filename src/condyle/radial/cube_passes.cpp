#include "condyle/radial/cube_passes.hpp"
#include "condyle/radial/triangle_plane.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include <hwy/cache_control.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "condyle/radial/cube_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace condyle::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using DD = hn::CappedTag<double, 8>;
using DF = hn::Rebind<float, DD>;
using DL = hn::RebindToSigned<DD>;
using Doubles = hn::Vec<DD>;
using Singles = hn::Vec<DF>;
constexpr DD dd;
constexpr DF df;
constexpr DL dl;
constexpr std::size_t lanes = hn::MaxLanes(dd);

/// How long before its turn a triangle's corners are fetched: they lie anywhere.
constexpr std::size_t triangles_ahead = 24;

void place_vertices_any(const MeshView& mesh, std::uint8_t* face, FacePoint* out) {
  constexpr hn::RebindToSigned<DF> di;
  const auto load = [&](const double* from, std::size_t i) {
    if (i + lanes <= mesh.vertices) return hn::DemoteTo(df, hn::LoadU(dd, from + i));
    alignas(64) double last[lanes] = {};
    for (std::size_t k = 0; i + k < mesh.vertices; ++k) last[k] = from[i + k];
    return hn::DemoteTo(df, hn::Load(dd, last));
  };
  alignas(64) float packed[4 * lanes];
  alignas(64) std::int32_t faces[lanes];
  for (std::size_t i = 0; i < mesh.vertices; i += lanes) {
    const auto x = load(mesh.x, i), y = load(mesh.y, i), z = load(mesh.z, i);
    const auto ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
    const auto on_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az));
    const auto on_y = hn::AndNot(on_x, hn::Ge(ay, az));
    const auto largest = hn::IfThenElse(on_x, x, hn::IfThenElse(on_y, y, z));
    const auto u = hn::IfThenElse(on_x, y, hn::IfThenElse(on_y, z, x));
    const auto w = hn::IfThenElse(on_x, z, hn::IfThenElse(on_y, x, y));
    const auto inverse = hn::Div(hn::Set(df, 1.0f), hn::Abs(largest));
    const auto zero = hn::Zero(di), one = hn::Set(di, 1);
    const auto axis = hn::IfThenElse(hn::RebindMask(di, on_x), zero,
                                     hn::IfThenElse(hn::RebindMask(di, on_y), one, hn::Set(di, 2)));
    const auto negative = hn::And(hn::ShiftRight<31>(hn::BitCast(di, largest)), hn::Set(di, 3));
    hn::Store(hn::Add(axis, negative), di, faces);
    const auto on_u = hn::Mul(u, inverse), on_w = hn::Mul(w, inverse);
    hn::StoreInterleaved4(on_u, on_w, hn::Add(on_u, on_w), hn::Sub(on_u, on_w), df, packed);
    const std::size_t count = std::min(lanes, mesh.vertices - i);
    for (std::size_t k = 0; k < count; ++k) {
      face[i + k] = static_cast<std::uint8_t>(faces[k]);
      std::copy_n(packed + 4 * k, 4, out[i + k].at);
    }
  }
}

struct Vectors {
  Doubles x, y, z;
};

HWY_INLINE Vectors operator-(const Vectors& a, const Vectors& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vectors cross(const Vectors& a, const Vectors& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

HWY_INLINE Doubles dot(const Vectors& a, const Vectors& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Doubles sum_of_magnitudes(const Vectors& a) {
  return hn::Add(hn::Add(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z));
}

HWY_INLINE Doubles largest_magnitude(const Vectors& a) {
  return hn::Max(hn::Max(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z));
}

/// Whether a normal, the cross product of p and q, is known well enough: its components err by 6u |p| |q|
/// each (3u of each product with the rounding of differences in p and q), u = 2^-53, so that the three
/// together stay below 2^-23 of the normal's sum of magnitudes.
HWY_INLINE hn::Mask<DD> well_known(const Vectors& normal, const Vectors& p, const Vectors& q) {
  const auto floor = hn::Mul(hn::Set(dd, 0x1p-25), hn::Mul(largest_magnitude(p), largest_magnitude(q)));
  return hn::Ge(sum_of_magnitudes(normal), floor);
}

/// Coefficients that neither overflow nor vanish as floats, with room for products with points.
HWY_INLINE hn::Mask<DD> fits_floats(Doubles largest, Doubles smallest) {
  return hn::And(hn::Lt(largest, hn::Set(dd, 0x1p60)), hn::Gt(smallest, hn::Set(dd, 0x1p-60)));
}

HWY_INLINE void store_interleaved(Doubles ab, Doubles bc, Doubles ca, Doubles plane, float* out) {
  hn::StoreInterleaved4(hn::DemoteTo(df, ab), hn::DemoteTo(df, bc), hn::DemoteTo(df, ca),
                        hn::DemoteTo(df, plane), df, out);
}

void measure_triangles_any(const MeshView& mesh, std::size_t first, std::size_t last, ConeForms* forms,
                           TriangleRadii* radii) {
  const auto nan = hn::Set(dd, std::numeric_limits<double>::quiet_NaN());
  alignas(64) std::int64_t corner[3][lanes];
  alignas(64) float packed[4][4 * lanes];
  alignas(64) float packed_radii[4 * lanes];
  for (std::size_t t = first; t < last; t += lanes) {
    const std::size_t count = std::min(lanes, last - t);
    for (std::size_t k = 0; k < lanes; ++k) {
      const std::uint32_t* corners = mesh.corner + 3 * (t + std::min(k, count - 1));
      const std::uint32_t* later = mesh.corner + 3 * std::min(t + k + triangles_ahead, mesh.triangles - 1);
      for (std::size_t i = 0; i < 3; ++i) {
        corner[i][k] = 3 * static_cast<std::int64_t>(corners[i]);
        hwy::Prefetch(mesh.xyz + 3 * std::size_t{later[i]});
      }
    }
    const auto gathered = [&](std::size_t i) {
      const auto at = hn::Load(dl, corner[i]);
      return Vectors{hn::GatherIndex(dd, mesh.xyz, at), hn::GatherIndex(dd, mesh.xyz + 1, at),
                     hn::GatherIndex(dd, mesh.xyz + 2, at)};
    };
    const Vectors a = gathered(0), b = gathered(1), c = gathered(2);
    const Vectors n_ab = cross(a, b), n_bc = cross(b, c), n_ca = cross(c, a);
    const Vectors ab = b - a, ac = c - a, bc = c - b;
    const Vectors n = cross(ab, ac);
    // D errs by 8u of the sum of its terms' magnitudes, which is at most 2 |a| |b| |c| with |a| a sum.
    const auto volume = dot(a, n_bc);
    const auto volume_floor =
        hn::Mul(hn::Set(dd, 0x1p-25),
                hn::Mul(sum_of_magnitudes(a), hn::Mul(largest_magnitude(b), largest_magnitude(c))));
    const auto inverse = hn::Div(hn::Set(dd, 1.0), volume), size = hn::Abs(inverse);
    const auto s_ab = sum_of_magnitudes(n_ab), s_bc = sum_of_magnitudes(n_bc), s_ca = sum_of_magnitudes(n_ca);
    const auto s_n = sum_of_magnitudes(n);
    const auto largest = hn::Mul(size, hn::Max(hn::Max(s_ab, s_bc), hn::Max(s_ca, s_n)));
    const auto smallest = hn::Mul(size, hn::Min(hn::Min(s_ab, s_bc), hn::Min(s_ca, s_n)));
    auto known = hn::And(hn::Gt(hn::Abs(volume), volume_floor), fits_floats(largest, smallest));
    known = hn::And(known, hn::And(well_known(n_ab, a, b), well_known(n_bc, b, c)));
    known = hn::And(known, hn::And(well_known(n_ca, c, a), well_known(n, ab, ac)));
    const auto aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
    const auto ab_ab = dot(ab, ab), ac_ac = dot(ac, ac);
    const auto furthest = hn::Max(aa, hn::Max(bb, cc));
    // As scaled_normal() has it, to the bit.
    const auto nn = dot(n, n), offset = dot(a, n);
    const auto set = [](double value) { return hn::Set(dd, value); };
    auto plane_known = hn::And(known, hn::And(hn::Gt(nn, set(triangle_plane::least_square)),
                                              hn::Lt(nn, set(triangle_plane::greatest_square))));
    plane_known =
        hn::And(plane_known, hn::Le(hn::Mul(ab_ab, ac_ac), hn::Mul(set(triangle_plane::most_sliver), nn)));
    plane_known = hn::And(
        plane_known,
        hn::Ge(hn::Mul(set(triangle_plane::most_oblique), hn::Mul(offset, offset)), hn::Mul(furthest, nn)));
    const auto scale = hn::IfThenElse(known, inverse, nan);
    const auto plane =
        hn::IfThenElse(plane_known, hn::Abs(hn::Div(hn::Set(dd, 1.0), offset)), hn::Abs(scale));
    const auto store = [&](Doubles p, Doubles q, Doubles r, Doubles s, float* out) {
      store_interleaved(hn::Mul(p, scale), hn::Mul(q, scale), hn::Mul(r, scale), hn::Mul(s, plane), out);
    };
    store(n_ab.x, n_bc.x, n_ca.x, n.x, packed[0]);
    store(n_ab.y, n_bc.y, n_ca.y, n.y, packed[1]);
    store(n_ab.z, n_bc.z, n_ca.z, n.z, packed[2]);
    const auto rest = [&](Doubles component) {
      const auto value = hn::Mul(component, plane);
      const auto left = hn::Sub(value, hn::PromoteTo(dd, hn::DemoteTo(df, value)));
      return hn::IfThenElse(plane_known, left, nan);
    };
    store_interleaved(rest(n.x), rest(n.y), rest(n.z), hn::Zero(dd), packed[3]);
    const auto edge = hn::Max(ab_ab, hn::Max(ac_ac, dot(bc, bc)));
    const auto dip = hn::Mul(edge, hn::Set(dd, 1.0 / 3));
    const auto least = hn::Max(hn::Zero(dd), hn::Sub(hn::Min(aa, hn::Min(bb, cc)), dip));
    store_interleaved(hn::Mul(least, hn::Set(dd, 1 - 0x1p-16)), hn::Mul(furthest, hn::Set(dd, 1 + 0x1p-16)),
                      edge, edge, packed_radii);
    for (std::size_t k = 0; k < count; ++k) {
      ConeForms& out = forms[t + k];
      std::copy_n(packed[0] + 4 * k, 4, out.x);
      std::copy_n(packed[1] + 4 * k, 4, out.y);
      std::copy_n(packed[2] + 4 * k, 4, out.z);
      std::copy_n(packed[3] + 4 * k, 3, out.rest);
      radii[t - first + k] = {packed_radii[4 * k], packed_radii[4 * k + 1], packed_radii[4 * k + 2]};
    }
  }
}

/// octagon_in_cell() of a triangle in several cells.
template <class DI>
struct OctagonsInCells {
  using Ints = hn::Vec<DI>;
  hn::Mask<DI> meet;
  Ints box, slant;

  HWY_INLINE OctagonsInCells(const FaceParts& parts, int n, Ints column, Ints row) {
    constexpr DI di;
    const auto set = [](int value) { return hn::Set(DI(), value); };
    const auto within = [&](Ints value, int most) {
      return hn::Min(hn::Max(value, hn::Zero(di)), set(most));
    };
    const auto from = [&](int value, Ints start) { return hn::Sub(set(value), start); };
    const auto word = [&](Ints least_a, Ints greatest_a, Ints least_b, Ints greatest_b) {
      const auto a = hn::Or(least_a, hn::ShiftLeft<8>(hn::Sub(set(255), greatest_a)));
      const auto b = hn::Or(least_b, hn::ShiftLeft<8>(hn::Sub(set(255), greatest_b)));
      return hn::Or(a, hn::ShiftLeft<16>(b));
    };
    const auto u = hn::ShiftLeft<8>(column), w = hn::ShiftLeft<8>(row);
    const auto sum = hn::Add(u, w), difference = hn::Add(hn::Sub(u, w), set(parts_per_cell * n - 255));
    const auto least_sum = from(parts.least[2] - 2, sum), greatest_sum = from(parts.greatest[2] + 1, sum);
    const auto least_difference = from(parts.least[3] - 1, difference);
    const auto greatest_difference = from(parts.greatest[3] + 2, difference);
    const auto most = set(510);
    const auto before = hn::Or(hn::Lt(greatest_sum, hn::Zero(di)), hn::Lt(greatest_difference, hn::Zero(di)));
    meet = hn::Not(hn::Or(before, hn::Or(hn::Gt(least_sum, most), hn::Gt(least_difference, most))));
    box = word(within(from(parts.least[0], u), 255), within(from(parts.greatest[0], u), 255),
               within(from(parts.least[1], w), 255), within(from(parts.greatest[1], w), 255));
    const auto half = [&](Ints value) { return hn::ShiftRight<1>(within(value, 510)); };
    slant = word(half(least_sum), half(greatest_sum), half(least_difference), half(greatest_difference));
  }
};

void list_small_triangles_any(const MeshView& mesh, const std::uint8_t* faces, const FacePoint* vertices,
                              std::size_t first, std::size_t last, const TriangleRadii* radii,
                              Listing& listing) {
  constexpr hn::CappedTag<float, 4> d4;
  constexpr hn::RebindToSigned<decltype(d4)> di4;
  constexpr hn::RebindToUnsigned<decltype(d4)> du4;
  alignas(16) constexpr std::int32_t column_step[4] = {0, 1, 0, 1}, row_step[4] = {0, 0, 1, 1};
  const int n = listing.cells_per_side;
  const int last_part = n * parts_per_cell - 1;
  const auto scale = hn::Set(d4, 0.5f * static_cast<float>(n * parts_per_cell));
  alignas(16) constexpr float low_shift[4] = {1 - list_margin, 1 - list_margin, 2 - 2 * list_margin,
                                              2 - 2 * list_margin};
  alignas(16) constexpr float high_shift[4] = {1 + list_margin, 1 + list_margin, 2 + 2 * list_margin,
                                               2 + 2 * list_margin};
  ListedTriangle* next = listing.entry + listing.count;
  for (std::size_t t = first; t < last; ++t) {
    const std::uint32_t* corner = mesh.corner + 3 * t;
    const std::uint32_t* later = mesh.corner + 3 * std::min(t + triangles_ahead, mesh.triangles - 1);
    for (int i = 0; i < 3; ++i) hwy::Prefetch(vertices + later[i]);
    alignas(16) FaceParts parts;
    for (std::size_t k = 0; k < 4; k += hn::Lanes(d4)) {
      const auto load = [&](int i) { return hn::Load(d4, vertices[corner[i]].at + k); };
      const auto a = load(0), b = load(1), c = load(2);
      const auto low = hn::Mul(hn::Add(hn::Min(a, hn::Min(b, c)), hn::Load(d4, low_shift + k)), scale);
      const auto high = hn::Mul(hn::Add(hn::Max(a, hn::Max(b, c)), hn::Load(d4, high_shift + k)), scale);
      hn::StoreU(hn::Max(hn::ConvertTo(di4, low), hn::Zero(di4)), di4, parts.least.data() + k);
      hn::StoreU(hn::ConvertTo(di4, high), di4, parts.greatest.data() + k);
    }
    const int face = faces[corner[0]];
    const int i0 = parts.least[0] >> 8, j0 = parts.least[1] >> 8;
    const int i1 = parts.greatest[0] >> 8, j1 = parts.greatest[1] >> 8;
    // At the face's edge the widened triangle reaches the next face.
    const bool at_edge = parts.least[0] == 0 || parts.least[1] == 0 || parts.greatest[0] >= last_part ||
                         parts.greatest[1] >= last_part;
    if (face != faces[corner[1]] || face != faces[corner[2]] || at_edge || i1 - i0 > 1 || j1 - j0 > 1) {
      listing.elsewhere[listing.elsewhere_count++] = static_cast<std::uint32_t>(t);
      continue;
    }
    // Up to four cells, always worked out: which of them there are is not to be foretold.
    alignas(16) std::uint32_t cell[4], met[4], entry[16];
    for (std::size_t k = 0; k < 4; k += hn::Lanes(d4)) {
      const auto i = hn::Add(hn::Set(di4, i0), hn::Load(di4, column_step + k));
      const auto j = hn::Add(hn::Set(di4, j0), hn::Load(di4, row_step + k));
      const auto spare = hn::Iota(di4, 6 * n * n + static_cast<std::int32_t>(k));
      const OctagonsInCells<decltype(di4)> octagons(parts, n, i, j);
      const auto in_box = hn::Not(hn::Or(hn::Gt(i, hn::Set(di4, i1)), hn::Gt(j, hn::Set(di4, j1))));
      const auto meets = hn::And(in_box, octagons.meet);
      const auto own = hn::Add(hn::Mul(hn::Add(hn::Set(di4, face * n), j), hn::Set(di4, n)), i);
      const auto cells = hn::BitCast(du4, hn::IfThenElse(meets, own, spare));
      hn::Store(cells, du4, cell + k);
      hn::Store(hn::And(hn::BitCast(du4, hn::VecFromMask(di4, meets)), hn::Set(du4, 1)), du4, met + k);
      hn::StoreInterleaved4(cells, hn::Set(du4, static_cast<std::uint32_t>(t)),
                            hn::BitCast(du4, octagons.box), hn::BitCast(du4, octagons.slant), du4,
                            entry + 4 * k);
    }
    const TriangleRadii& bounds = radii[t - first];
    for (std::size_t k = 0; k < 4; ++k) {
      std::memcpy(next, entry + 4 * k, sizeof *next);
      next += met[k];
      listing.length[cell[k]] += met[k];
      listing.least[cell[k]] = std::min(listing.least[cell[k]], bounds.least);
      listing.greatest[cell[k]] = std::max(listing.greatest[cell[k]], bounds.greatest);
    }
  }
  listing.count = static_cast<std::size_t>(next - listing.entry);
}

}  // namespace
}  // namespace condyle::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle {

HWY_EXPORT(place_vertices_any);
HWY_EXPORT(measure_triangles_any);
HWY_EXPORT(list_small_triangles_any);

void place_vertices(const MeshView& mesh, std::uint8_t* face, FacePoint* out) {
  HWY_DYNAMIC_DISPATCH(place_vertices_any)(mesh, face, out);
}

void measure_triangles(const MeshView& mesh, std::size_t first, std::size_t last, ConeForms* forms,
                       TriangleRadii* radii) {
  HWY_DYNAMIC_DISPATCH(measure_triangles_any)(mesh, first, last, forms, radii);
}

void list_small_triangles(const MeshView& mesh, const std::uint8_t* face, const FacePoint* vertices,
                          std::size_t first, std::size_t last, const TriangleRadii* radii, Listing& listing) {
  HWY_DYNAMIC_DISPATCH(list_small_triangles_any)(mesh, face, vertices, first, last, radii, listing);
}

}  // namespace condyle
#endif
