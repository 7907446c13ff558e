#include <algorithm>
#include <cstring>
#include <limits>

#include "radial/build/cube_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "radial/build/small_binning_pass.cpp"
#include <hwy/foreach_target.h>
#include "radial/build/dops-inl.hpp"
#include "simd/prelude-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {
namespace {

using simd::HWY_NAMESPACE::numbers_from;

namespace hn = hwy::HWY_NAMESPACE;

/// How long before its turn a triangle's corners are fetched: they lie anywhere.
constexpr std::size_t triangles_ahead = 24;

/// Triangles one after the other: least and greatest part of each that it takes of its face, and that face,
/// or -1 where it is on several.
struct TriangleBatch {
  alignas(64) std::int32_t least[lanes][4];
  alignas(64) std::int32_t greatest[lanes][4];
  alignas(64) std::int32_t face[lanes];
};

#if HWY_TARGET != HWY_SCALAR
constexpr hn::CappedTag<float, 4> four;

/// SlackRectangle::lowest() and highest().
HWY_INLINE hn::Vec<decltype(four)> end_of_slack(hn::Vec<decltype(four)> slack, const std::int32_t* first,
                                                const std::int32_t* second) {
  constexpr hn::RebindToSigned<decltype(four)> words;
  alignas(16) constexpr std::int32_t is_added[4] = {0, 0, -1, -1};
  alignas(16) constexpr std::int32_t is_negative[4] = {0, 0, 0, std::numeric_limits<std::int32_t>::min()};
  const auto a = hn::TableLookupLanes(slack, hn::SetTableIndices(four, first));
  const auto b = hn::And(hn::TableLookupLanes(slack, hn::SetTableIndices(four, second)),
                         hn::BitCast(four, hn::Load(words, is_added)));
  return hn::Add(a, hn::Xor(b, hn::BitCast(four, hn::Load(words, is_negative))));
}
#endif

/// Coordinates of a vertex's place from the given one on, as many as fit the tag: the least ones, or the
/// greatest.
template <bool has_slack, bool is_least, class Tag>
HWY_INLINE hn::Vec<Tag> end_of_place(Tag tag, const PlacedVertices& vertices, std::uint32_t vertex,
                                     std::size_t coordinate) {
  if constexpr (!has_slack) {
    return hn::Load(tag, vertices.place[vertex].at + coordinate);
  } else {
#if HWY_TARGET == HWY_SCALAR
    const SlackRectangle& slack = vertices.slack[vertex];
    return hn::Set(tag, (is_least ? slack.lowest() : slack.highest()).at[coordinate]);
#else
    alignas(16) static constexpr std::int32_t first[2][4] = {{2, 3, 2, 2}, {0, 1, 0, 0}};
    alignas(16) static constexpr std::int32_t second[2][4] = {{3, 3, 3, 1}, {1, 1, 1, 3}};
    const auto slack = hn::LoadU(tag, &vertices.slack[vertex].low_u);
    return end_of_slack(slack, first[is_least], second[is_least]);
#endif
  }
}

/// Triangles from the given one on; the last one again where there are not as many.
template <bool has_slack>
HWY_INLINE void read_triangles(const MeshView& mesh, const PlacedVertices& vertices, std::size_t first,
                               std::size_t count, int cells_per_side, TriangleBatch& batch) {
  constexpr hn::CappedTag<float, 4> d4;
  constexpr hn::RebindToSigned<decltype(d4)> di4;
  const auto scale = hn::Set(d4, 0.5f * static_cast<float>(cells_per_side * parts_per_cell));
  alignas(16) constexpr float low_shift[4] = {1 - list_margin, 1 - list_margin, 2 - 2 * list_margin,
                                              2 - 2 * list_margin};
  alignas(16) constexpr float high_shift[4] = {1 + list_margin, 1 + list_margin, 2 + 2 * list_margin,
                                               2 + 2 * list_margin};
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::size_t t = first + std::min(lane, count - 1);
    const std::uint32_t* corner = mesh.corner + 3 * t;
    const std::uint32_t* later = mesh.corner + 3 * std::min(t + triangles_ahead, mesh.triangles - 1);
    for (int i = 0; i < 3; ++i) {
      if constexpr (has_slack) {
        hwy::Prefetch(vertices.slack + later[i]);
      } else {
        hwy::Prefetch(vertices.place + later[i]);
      }
    }
    for (std::size_t k = 0; k < 4; k += hn::MaxLanes(d4)) {
      const auto least = [&](int i) { return end_of_place<has_slack, true>(d4, vertices, corner[i], k); };
      const auto greatest = [&](int i) { return end_of_place<has_slack, false>(d4, vertices, corner[i], k); };
      const auto first_of_all = hn::Min(least(0), hn::Min(least(1), least(2)));
      const auto last_of_all = hn::Max(greatest(0), hn::Max(greatest(1), greatest(2)));
      const auto low = hn::Mul(hn::Add(first_of_all, hn::Load(d4, low_shift + k)), scale);
      const auto high = hn::Mul(hn::Add(last_of_all, hn::Load(d4, high_shift + k)), scale);
      hn::Store(hn::ConvertTo(di4, low), di4, batch.least[lane] + k);
      hn::Store(hn::ConvertTo(di4, high), di4, batch.greatest[lane] + k);
    }
    const int face = vertices.face[corner[0]];
    const bool is_on_one = face == vertices.face[corner[1]] && face == vertices.face[corner[2]];
    batch.face[lane] = is_on_one ? face : -1;
  }
}

void bin_small_triangles_any(const MeshView& mesh, const PlacedVertices& vertices, std::size_t first,
                             std::size_t last, Binning& binning) {
  constexpr Lanes di;
  constexpr Words du;
  const int n = binning.cells_per_side;
  const auto last_part = hn::Set(di, n * parts_per_cell - 1), one = hn::Set(di, 1), zero = hn::Zero(di);
  TriangleBatch batch;
  // Up to four cells of each, always worked out: which of them there are cannot be predicted.
  alignas(64) std::uint32_t entry[4][4 * lanes], cell[4][lanes], met[4][lanes];
  CellEntry* next = binning.entry + binning.count;
  for (std::size_t t = first; t < last; t += lanes) {
    const std::size_t count = std::min(lanes, last - t);
    if (vertices.slack != nullptr) {
      read_triangles<true>(mesh, vertices, t, count, n, batch);
    } else {
      read_triangles<false>(mesh, vertices, t, count, n, batch);
    }
    PartsInLanes<Lanes> parts;
    hn::LoadInterleaved4(di, batch.least[0], parts.least[0], parts.least[1], parts.least[2], parts.least[3]);
    hn::LoadInterleaved4(di, batch.greatest[0], parts.greatest[0], parts.greatest[1], parts.greatest[2],
                         parts.greatest[3]);
    const auto face = hn::Load(di, batch.face);
    const auto i0 = hn::ShiftRight<8>(parts.least[0]), j0 = hn::ShiftRight<8>(parts.least[1]);
    const auto i1 = hn::ShiftRight<8>(parts.greatest[0]), j1 = hn::ShiftRight<8>(parts.greatest[1]);
    // At the face's edge the widened triangle reaches the next face.
    const auto is_off_edges =
        hn::And(hn::And(hn::Gt(parts.least[0], zero), hn::Gt(parts.least[1], zero)),
                hn::And(hn::Lt(parts.greatest[0], last_part), hn::Lt(parts.greatest[1], last_part)));
    const auto is_larger = hn::Or(hn::Gt(hn::Sub(i1, i0), one), hn::Gt(hn::Sub(j1, j0), one));
    const auto is_small = hn::And(hn::And(is_off_edges, hn::Not(hn::Lt(face, zero))), hn::Not(is_larger));
    if (!hn::AllTrue(di, is_small)) {
      alignas(64) std::int32_t is_here[lanes];
      hn::Store(hn::VecFromMask(di, is_small), di, is_here);
      for (std::size_t k = 0; k < count; ++k) {
        binning.elsewhere[binning.elsewhere_count] = static_cast<std::uint32_t>(t + k);
        binning.elsewhere_count += is_here[k] == 0 ? 1 : 0;
      }
    }
    const auto triangle = numbers_from(du, t);
    for (int q = 0; q < 4; ++q) {
      const auto i = hn::Add(i0, hn::Set(di, q & 1)), j = hn::Add(j0, hn::Set(di, q >> 1));
      const DopsInCells<Lanes> dops(parts, n, i, j);
      const auto beyond = hn::Or(hn::Gt(i, i1), hn::Gt(j, j1));
      const auto meets = hn::And(hn::And(is_small, dops.meet), hn::Not(beyond));
      const auto row = hn::Add(hn::Mul(face, hn::Set(di, n)), j);
      const auto own = hn::Add(hn::Mul(row, hn::Set(di, n)), i);
      const auto cells = hn::BitCast(du, hn::IfThenElse(meets, own, hn::Set(di, 6 * n * n + q)));
      hn::Store(cells, du, cell[q]);
      hn::Store(hn::And(hn::BitCast(du, hn::VecFromMask(di, meets)), hn::Set(du, 1)), du, met[q]);
      hn::StoreInterleaved4(cells, triangle, hn::BitCast(du, dops.axis), hn::BitCast(du, dops.diagonal), du,
                            entry[q]);
    }
    for (std::size_t k = 0; k < count; ++k) {
      for (int q = 0; q < 4; ++q) {
        std::memcpy(next, entry[q] + 4 * k, sizeof *next);
        next += met[q][k];
        binning.length[cell[q][k]] += met[q][k];
      }
    }
  }
  binning.count = static_cast<std::size_t>(next - binning.entry);
}

}  // namespace
}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace condyle::radial {

HWY_EXPORT(bin_small_triangles_any);

void bin_small_triangles(const MeshView& mesh, const PlacedVertices& vertices, std::size_t first,
                         std::size_t last, Binning& binning) {
  HWY_DYNAMIC_DISPATCH(bin_small_triangles_any)(mesh, vertices, first, last, binning);
}

}  // namespace condyle::radial
#endif
