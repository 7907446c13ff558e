#include "condyle/radial/cube_passes.hpp"

#include <algorithm>
#include <limits>

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

/// Whether a normal, the cross product of p and q, is known well enough: its components err by 6u |p| |q| each
/// (3u of each product with the rounding of differences in p and q), u = 2^-53, so that the three together stay
/// below 2^-23 of the normal's sum of magnitudes.
HWY_INLINE hn::Mask<DD> well_known(const Vectors& normal, const Vectors& p, const Vectors& q) {
  const auto floor = hn::Mul(hn::Set(dd, 0x1p-25), hn::Mul(largest_magnitude(p), largest_magnitude(q)));
  return hn::Ge(sum_of_magnitudes(normal), floor);
}

/// Coefficients that neither overflow nor vanish as floats, with room for products with points.
HWY_INLINE hn::Mask<DD> fits_floats(Doubles largest, Doubles smallest) {
  return hn::And(hn::Lt(largest, hn::Set(dd, 0x1p60)), hn::Gt(smallest, hn::Set(dd, 0x1p-60)));
}

HWY_INLINE void store_interleaved(Doubles ab, Doubles bc, Doubles ca, Doubles plane, float* out) {
  hn::StoreInterleaved4(hn::DemoteTo(df, ab), hn::DemoteTo(df, bc), hn::DemoteTo(df, ca), hn::DemoteTo(df, plane),
                        df, out);
}

void measure_triangles_any(const MeshView& mesh, std::size_t first, std::size_t last, ConeForms* forms,
                           TriangleRadii* radii) {
  const auto nan = hn::Set(dd, std::numeric_limits<double>::quiet_NaN());
  alignas(64) std::int64_t corner[3][lanes];
  alignas(64) float packed[3][4 * lanes];
  alignas(64) float packed_radii[4 * lanes];
  for (std::size_t t = first; t < last; t += lanes) {
    const std::size_t count = std::min(lanes, last - t);
    for (std::size_t k = 0; k < lanes; ++k) {
      const std::uint32_t* corners = mesh.corner + 3 * (t + std::min(k, count - 1));
      for (std::size_t i = 0; i < 3; ++i) corner[i][k] = corners[i];
    }
    const auto gathered = [&](std::size_t i) {
      const auto at = hn::Load(dl, corner[i]);
      return Vectors{hn::GatherIndex(dd, mesh.x, at), hn::GatherIndex(dd, mesh.y, at),
                     hn::GatherIndex(dd, mesh.z, at)};
    };
    const Vectors a = gathered(0), b = gathered(1), c = gathered(2);
    const Vectors n_ab = cross(a, b), n_bc = cross(b, c), n_ca = cross(c, a);
    const Vectors ab = b - a, ac = c - a, bc = c - b;
    const Vectors n = cross(ab, ac);
    // D errs by 8u of the sum of its terms' magnitudes, which is at most 2 |a| |b| |c| with |a| a sum.
    const auto volume = dot(a, n_bc);
    const auto volume_floor = hn::Mul(hn::Set(dd, 0x1p-25), hn::Mul(sum_of_magnitudes(a), hn::Mul(largest_magnitude(b), largest_magnitude(c))));
    const auto inverse = hn::Div(hn::Set(dd, 1.0), volume), size = hn::Abs(inverse);
    const auto s_ab = sum_of_magnitudes(n_ab), s_bc = sum_of_magnitudes(n_bc), s_ca = sum_of_magnitudes(n_ca);
    const auto s_n = sum_of_magnitudes(n);
    const auto largest = hn::Mul(size, hn::Max(hn::Max(s_ab, s_bc), hn::Max(s_ca, s_n)));
    const auto smallest = hn::Mul(size, hn::Min(hn::Min(s_ab, s_bc), hn::Min(s_ca, s_n)));
    auto known = hn::And(hn::Gt(hn::Abs(volume), volume_floor), fits_floats(largest, smallest));
    known = hn::And(known, hn::And(well_known(n_ab, a, b), well_known(n_bc, b, c)));
    known = hn::And(known, hn::And(well_known(n_ca, c, a), well_known(n, ab, ac)));
    const auto scale = hn::IfThenElse(known, inverse, nan), plane = hn::Abs(scale);
    const auto store = [&](Doubles p, Doubles q, Doubles r, Doubles s, float* out) {
      store_interleaved(hn::Mul(p, scale), hn::Mul(q, scale), hn::Mul(r, scale), hn::Mul(s, plane), out);
    };
    store(n_ab.x, n_bc.x, n_ca.x, n.x, packed[0]);
    store(n_ab.y, n_bc.y, n_ca.y, n.y, packed[1]);
    store(n_ab.z, n_bc.z, n_ca.z, n.z, packed[2]);
    const auto aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
    const auto edge = hn::Max(dot(ab, ab), hn::Max(dot(ac, ac), dot(bc, bc)));
    const auto dip = hn::Mul(edge, hn::Set(dd, 1.0 / 3));
    const auto least = hn::Max(hn::Zero(dd), hn::Sub(hn::Min(aa, hn::Min(bb, cc)), dip));
    const auto greatest = hn::Max(aa, hn::Max(bb, cc));
    store_interleaved(hn::Mul(least, hn::Set(dd, 1 - 0x1p-16)), hn::Mul(greatest, hn::Set(dd, 1 + 0x1p-16)), edge,
                      edge, packed_radii);
    for (std::size_t k = 0; k < count; ++k) {
      ConeForms& out = forms[t + k];
      std::copy_n(packed[0] + 4 * k, 4, out.x);
      std::copy_n(packed[1] + 4 * k, 4, out.y);
      std::copy_n(packed[2] + 4 * k, 4, out.z);
      radii[t - first + k] = {packed_radii[4 * k], packed_radii[4 * k + 1], packed_radii[4 * k + 2]};
    }
  }
}

void list_small_triangles_any(const MeshView& mesh, const std::uint8_t* faces, const FacePoint* vertices,
                              std::size_t first, std::size_t last, const TriangleRadii* radii, Listing& listing) {
  constexpr hn::CappedTag<float, 4> d4;
  constexpr hn::RebindToSigned<decltype(d4)> di4;
  const int n = listing.cells_per_side;
  const int last_part = n * parts_per_cell - 1;
  const auto scale = hn::Set(d4, 0.5f * static_cast<float>(n * parts_per_cell));
  alignas(16) constexpr float low_shift[4] = {1 - list_margin, 1 - list_margin, 2 - 2 * list_margin, 2 - 2 * list_margin};
  alignas(16) constexpr float high_shift[4] = {1 + list_margin, 1 + list_margin, 2 + 2 * list_margin, 2 + 2 * list_margin};
  ListedTriangle* next = listing.entry + listing.count;
  for (std::size_t t = first; t < last; ++t) {
    const std::uint32_t* corner = mesh.corner + 3 * t;
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
    const bool at_edge = parts.least[0] == 0 || parts.least[1] == 0 || parts.greatest[0] >= last_part || parts.greatest[1] >= last_part;
    if (face != faces[corner[1]] || face != faces[corner[2]] || at_edge || i1 - i0 > 1 || j1 - j0 > 1) {
      listing.elsewhere[listing.elsewhere_count++] = static_cast<std::uint32_t>(t);
      continue;
    }
    const TriangleRadii& bounds = radii[t - first];
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) {
        const auto octagon = octagon_in_cell(parts, n, i, j);
        if (!octagon) continue;
        const auto cell = static_cast<std::uint32_t>((face * n + j) * n + i);
        *next++ = {cell, static_cast<std::uint32_t>(t), *octagon};
        ++listing.length[cell];
        listing.least[cell] = std::min(listing.least[cell], bounds.least);
        listing.greatest[cell] = std::max(listing.greatest[cell], bounds.greatest);
      }
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
