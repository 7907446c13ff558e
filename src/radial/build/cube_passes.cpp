#include "radial/build/cube_passes.hpp"
#include "radial/exact/triangle_plane.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "radial/build/cube_passes.cpp"
#include <hwy/foreach_target.h>
#include "radial/exact/double_vectors-inl.hpp"
#include "simd/cube_projection-inl.hpp"
#include "simd/packed_intervals-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::Rebind<float, DD>;
using Singles = hn::Vec<DF>;
constexpr DD dd;
constexpr DF df;
constexpr std::size_t lanes = hn::MaxLanes(dd);

/// How long before its turn a triangle's corners are fetched: they lie anywhere.
constexpr std::size_t triangles_ahead = 24;

/// Coordinates of vertices from the given one on, as floats; beyond the last one zeros.
HWY_INLINE Singles load_coordinates(const double* from, std::size_t first, std::size_t count) {
  if (first + lanes <= count) return hn::DemoteTo(df, hn::LoadU(dd, from + first));
  alignas(64) double last[lanes] = {};
  for (std::size_t k = 0; first + k < count; ++k) last[k] = from[first + k];
  return hn::DemoteTo(df, hn::Load(dd, last));
}

void place_vertices_any(const MeshView& mesh, std::uint8_t* face, FacePoint* out) {
  constexpr hn::RebindToSigned<DF> di;
  alignas(64) float packed[4 * lanes];
  alignas(64) std::int32_t faces[lanes];
  for (std::size_t i = 0; i < mesh.vertices; i += lanes) {
    const auto x = load_coordinates(mesh.x, i, mesh.vertices), y = load_coordinates(mesh.y, i, mesh.vertices),
               z = load_coordinates(mesh.z, i, mesh.vertices);
    const simd::HWY_NAMESPACE::CubeProjection<DF> at(df, x, y, z);
    hn::Store(at.face, di, faces);
    hn::StoreInterleaved4(at.u, at.w, hn::Add(at.u, at.w), hn::Sub(at.u, at.w), df, packed);
    const std::size_t count = std::min(lanes, mesh.vertices - i);
    for (std::size_t k = 0; k < count; ++k) {
      face[i + k] = static_cast<std::uint8_t>(faces[k]);
      std::copy_n(packed + 4 * k, 4, out[i + k].at);
    }
  }
}

std::size_t find_left_slack_any(const MeshView& mesh, const std::uint8_t* faces, const SlackRectangle* slack,
                                std::uint32_t* out) {
  constexpr hn::RebindToSigned<DF> di;
  const auto one = hn::Set(df, 1.0f);
  alignas(64) std::int32_t axes[lanes];
  alignas(64) float signs[lanes];
  std::size_t left = 0;
  for (std::size_t i = 0; i < mesh.vertices; i += lanes) {
    const std::size_t count = std::min(lanes, mesh.vertices - i);
    for (std::size_t k = 0; k < lanes; ++k) {
      const std::uint8_t face = faces[i + std::min(k, count - 1)];
      axes[k] = face < 3 ? face : face - 3, signs[k] = face < 3 ? 1.0f : -1.0f;
    }
    const auto x = load_coordinates(mesh.x, i, mesh.vertices), y = load_coordinates(mesh.y, i, mesh.vertices),
               z = load_coordinates(mesh.z, i, mesh.vertices);
    const auto axis = hn::Load(di, axes);
    const simd::HWY_NAMESPACE::OnFaceAxes<DF> at(
        {hn::RebindMask(df, hn::Eq(axis, hn::Zero(di))), hn::RebindMask(df, hn::Eq(axis, hn::Set(di, 1)))}, x,
        y, z);
    const auto depth = hn::Mul(at.depth, hn::Load(df, signs));
    const auto inverse = hn::Div(one, depth);
    const auto u = hn::Mul(at.u, inverse), w = hn::Mul(at.w, inverse);
    Singles low_u, low_w, high_u, high_w;
    if (count == lanes) {
      hn::LoadInterleaved4(df, &slack[i].low_u, low_u, low_w, high_u, high_w);
    } else {
      alignas(64) SlackRectangle last[lanes] = {};
      std::copy_n(slack + i, count, last);
      hn::LoadInterleaved4(df, &last[0].low_u, low_u, low_w, high_u, high_w);
    }
    auto within = hn::And(hn::Gt(depth, hn::Zero(df)), hn::And(hn::Ge(u, low_u), hn::Le(u, high_u)));
    within = hn::And(within, hn::And(hn::Ge(w, low_w), hn::Le(w, high_w)));
    if (hn::AllTrue(df, within)) continue;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(df, within, bits);
    for (std::size_t k = 0; k < count; ++k) {
      if ((bits[0] >> k & 1) == 0) out[left++] = static_cast<std::uint32_t>(i + k);
    }
  }
  return left;
}

HWY_INLINE Vectors operator-(const Vectors& a, const Vectors& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vectors cross(const Vectors& a, const Vectors& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
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

/// Coefficients that neither overflow nor vanish as floats, with slack for products with points.
HWY_INLINE hn::Mask<DD> fits_floats(Doubles largest, Doubles smallest) {
  return hn::And(hn::Lt(largest, hn::Set(dd, 0x1p60)), hn::Gt(smallest, hn::Set(dd, 0x1p-60)));
}

#if HWY_TARGET != HWY_SCALAR
/// Two coordinates of every other vertex, one behind the other.
template <class Tag>
HWY_INLINE hn::Vec<Tag> load_pairs(Tag tag, const double* xyz, const std::size_t* at) {
  constexpr std::size_t half_lanes = hn::MaxLanes(tag) / 2;
  if constexpr (half_lanes == 1) {
    return hn::LoadU(tag, xyz + at[0]);
  } else {
    constexpr hn::Half<Tag> half;
    return hn::Combine(tag, load_pairs(half, xyz, at + half_lanes), load_pairs(half, xyz, at));
  }
}
#endif

/// Vertices side by side in memory, turned: gathering each coordinate takes several times as long.
HWY_INLINE Vectors load_vertices(const double* xyz, const std::size_t* at) {
#if HWY_TARGET == HWY_SCALAR
  return {hn::Set(dd, xyz[at[0]]), hn::Set(dd, xyz[at[0] + 1]), hn::Set(dd, xyz[at[0] + 2])};
#else
  // Blocks of two lanes: vertices 0, 2, ... and 1, 3, ...
  const auto even_xy = load_pairs(dd, xyz, at), odd_xy = load_pairs(dd, xyz, at + 1);
  const auto even_yz = load_pairs(dd, xyz + 1, at), odd_yz = load_pairs(dd, xyz + 1, at + 1);
  return {hn::InterleaveLower(dd, even_xy, odd_xy), hn::InterleaveUpper(dd, even_xy, odd_xy),
          hn::InterleaveUpper(dd, even_yz, odd_yz)};
#endif
}

void measure_triangles_any(const MeshView& mesh, std::size_t first, std::size_t last,
                           const IntervalScale& radius_scale, EdgeFunctions* forms,
                           std::vector<std::uint32_t>& uncertain) {
  const auto nan = hn::Set(dd, std::numeric_limits<double>::quiet_NaN());
  std::size_t corner[3][lanes];
  alignas(64) float packed[4][4 * lanes];
  constexpr hn::RebindToSigned<DF> di;
  for (std::size_t t = first; t < last; t += lanes) {
    const std::size_t count = std::min(lanes, last - t);
    for (std::size_t k = 0; k < lanes; ++k) {
      const std::uint32_t* corners = mesh.corner + 3 * (t + std::min(k, count - 1));
      const std::uint32_t* later = mesh.corner + 3 * std::min(t + k + triangles_ahead, mesh.triangles - 1);
      for (std::size_t i = 0; i < 3; ++i) {
        corner[i][k] = 3 * std::size_t{corners[i]};
        hwy::Prefetch(mesh.xyz + 3 * std::size_t{later[i]});
      }
    }
    const Vectors a = load_vertices(mesh.xyz, corner[0]), b = load_vertices(mesh.xyz, corner[1]),
                  c = load_vertices(mesh.xyz, corner[2]);
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
    const auto times = [](Doubles value, Doubles factor) { return hn::DemoteTo(df, hn::Mul(value, factor)); };
    const auto n_x = times(n.x, plane), n_y = times(n.y, plane), n_z = times(n.z, plane);
    const auto store = [&](Doubles p, Doubles q, Doubles r, Singles s, float* out) {
      hn::StoreInterleaved4(times(p, scale), times(q, scale), times(r, scale), s, df, out);
    };
    store(n_ab.x, n_bc.x, n_ca.x, n_x, packed[0]);
    store(n_ab.y, n_bc.y, n_ca.y, n_y, packed[1]);
    store(n_ab.z, n_bc.z, n_ca.z, n_z, packed[2]);
    const auto low = [&](Doubles component) {
      const auto value = hn::Mul(component, plane);
      const auto left = hn::Sub(value, hn::PromoteTo(dd, hn::DemoteTo(df, value)));
      return hn::DemoteTo(df, hn::IfThenElse(plane_known, left, nan));
    };
    const auto edge = hn::Max(ab_ab, hn::Max(ac_ac, dot(bc, bc)));
    const auto dip = hn::Mul(edge, hn::Set(dd, 1.0 / 3));
    const auto least = hn::Max(hn::Zero(dd), hn::Sub(hn::Min(aa, hn::Min(bb, cc)), dip));
    const auto widened = [&](Doubles squared, double by) {
      return simd::HWY_NAMESPACE::interval_codes(df, radius_scale,
                                                 hn::DemoteTo(df, hn::Mul(squared, hn::Set(dd, by))));
    };
    const auto radii = hn::BitCast(df, simd::HWY_NAMESPACE::packed_intervals(di, widened(least, 1 - 0x1p-16),
                                                                             widened(furthest, 1 + 0x1p-16)));
    hn::StoreInterleaved4(low(n.x), low(n.y), low(n.z), radii, df, packed[3]);
    static_assert(offsetof(EdgeFunctions, radii) == offsetof(EdgeFunctions, low) + sizeof EdgeFunctions::low);
    for (std::size_t k = 0; k < count; ++k) {
      EdgeFunctions& out = forms[t + k];
      std::memcpy(out.x, packed[0] + 4 * k, sizeof out.x);
      std::memcpy(out.y, packed[1] + 4 * k, sizeof out.y);
      std::memcpy(out.z, packed[2] + 4 * k, sizeof out.z);
      std::memcpy(reinterpret_cast<char*>(&out) + offsetof(EdgeFunctions, low), packed[3] + 4 * k,
                  sizeof out.low + sizeof out.radii);
    }
    if (hn::AllTrue(dd, known)) continue;
    for (std::size_t k = 0; k < count; ++k) {
      if (std::isnan(packed[0][4 * k])) uncertain.push_back(static_cast<std::uint32_t>(t + k));
    }
  }
}

}  // namespace
}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::radial {

HWY_EXPORT(place_vertices_any);
HWY_EXPORT(find_left_slack_any);
HWY_EXPORT(measure_triangles_any);

void place_vertices(const MeshView& mesh, std::uint8_t* face, FacePoint* out) {
  HWY_DYNAMIC_DISPATCH(place_vertices_any)(mesh, face, out);
}

std::size_t find_left_slack(const MeshView& mesh, const std::uint8_t* face, const SlackRectangle* slack,
                            std::uint32_t* out) {
  return HWY_DYNAMIC_DISPATCH(find_left_slack_any)(mesh, face, slack, out);
}

void measure_triangles(const MeshView& mesh, std::size_t first, std::size_t last, const IntervalScale& scale,
                       EdgeFunctions* forms, std::vector<std::uint32_t>& uncertain) {
  HWY_DYNAMIC_DISPATCH(measure_triangles_any)(mesh, first, last, scale, forms, uncertain);
}

}  // namespace condyle::radial
#endif
