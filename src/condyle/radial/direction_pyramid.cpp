#include "condyle/radial/direction_pyramid.hpp"

#include <algorithm>
#include <cassert>

#include "condyle/radial/direction_map.hpp"

namespace condyle {
namespace {

std::size_t square(int n) noexcept {
  return static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
}

/// Each entry of a row with its neighbours to the left and right.
void widen_row(const RadiusWord* in, int n, RadiusWord* out) noexcept {
  for (int i = 0; i < n; ++i) out[i] = in[i];
  for (int i = 1; i < n; ++i) out[i] = union_of(out[i], in[i - 1]);
  for (int i = 0; i + 1 < n; ++i) out[i] = union_of(out[i], in[i + 1]);
}

/// Borders within each face.
void widen_faces(std::span<const RadiusWord> in, int n, RadiusWord* out) {
  std::vector<RadiusWord> widened(square(n));
  for (int face = 0; face < 6; ++face) {
    const std::size_t start = static_cast<std::size_t>(face) * square(n);
    const auto row = [&](int j) { return static_cast<std::size_t>(j) * static_cast<std::size_t>(n); };
    for (int j = 0; j < n; ++j) widen_row(in.data() + start + row(j), n, widened.data() + row(j));
    for (int j = 0; j < n; ++j) {
      const RadiusWord* above = widened.data() + row(std::max(j - 1, 0));
      const RadiusWord* middle = widened.data() + row(j);
      const RadiusWord* below = widened.data() + row(std::min(j + 1, n - 1));
      for (int i = 0; i < n; ++i) {
        out[start + row(j) + static_cast<std::size_t>(i)] = union_of(middle[i], union_of(above[i], below[i]));
      }
    }
  }
}

/// Borders across the edges of the cube. Beyond an edge the neighbouring face is entered by at most one
/// piece: a coordinate 1 + d is 1 / (1 + d) there, at least 1 - d. The other coordinate is divided by 1 + d
/// too, which brings it nearer to the middle by at most a piece more: two pieces to either side hold all of
/// it.
void widen_across_edges(std::span<const RadiusWord> in, int n, RadiusWord* out) {
  const CubeMap map(n);
  const double width = 2.0 / n;
  std::vector<RadiusWord> beyond(static_cast<std::size_t>(n));
  for (int face = 0; face < 6; ++face) {
    const int axis = face % 3;
    for (int edge = 0; edge < 4; ++edge) {
      const int across = (axis + 1 + edge / 2) % 3, along = (axis + 2 - edge / 2) % 3;
      for (int k = 0; k < n; ++k) {
        Vec3 direction;
        direction[axis] = face < 3 ? 1 : -1;
        direction[across] = (edge % 2 == 0 ? -1 : 1) * (1 + width / 4);
        direction[along] = (k + 0.5) * width - 1;
        beyond[static_cast<std::size_t>(k)] = in[map.cell_of(direction)];
      }
      for (int k = 0; k < n; ++k) {
        RadiusWord word = no_radii;
        for (int m = std::max(k - 2, 0); m <= std::min(k + 2, n - 1); ++m)
          word = union_of(word, beyond[static_cast<std::size_t>(m)]);
        // Columns run along axis + 1, rows along axis + 2.
        const int at_edge = edge % 2 == 0 ? 0 : n - 1;
        const int column = edge / 2 == 0 ? at_edge : k, row = edge / 2 == 0 ? k : at_edge;
        RadiusWord& entry = out[(static_cast<std::size_t>(face) * static_cast<std::size_t>(n) +
                                 static_cast<std::size_t>(row)) *
                                    static_cast<std::size_t>(n) +
                                static_cast<std::size_t>(column)];
        entry = union_of(entry, word);
      }
    }
  }
}

void halve(std::span<const RadiusWord> in, int n, std::vector<RadiusWord>& out) {
  const std::size_t half = static_cast<std::size_t>(n) / 2, side = static_cast<std::size_t>(n);
  out.resize(6 * half * half);
  for (std::size_t row = 0; row < 6 * half; ++row) {
    const RadiusWord *upper = in.data() + 2 * row * side, *lower = upper + side;
    for (std::size_t i = 0; i < half; ++i) {
      out[row * half + i] =
          union_of(union_of(upper[2 * i], upper[2 * i + 1]), union_of(lower[2 * i], lower[2 * i + 1]));
    }
  }
}

}  // namespace

int DirectionPyramid::level_count(int cells_per_side) noexcept {
  int levels = 1;
  for (int n = cells_per_side; n % 2 == 0 && n / 2 >= 4; n /= 2) ++levels;
  return levels;
}

std::size_t DirectionPyramid::entry_count(int cells_per_side) noexcept {
  std::size_t count = 0;
  for (int k = 0; k < level_count(cells_per_side); ++k)
    count = 8 * (square(cells_per_side) - square(cells_per_side >> k)) + 6 * square(cells_per_side >> k);
  return count;
}

void DirectionPyramid::fill(int cells_per_side, std::span<const RadiusWord> cells) {
  assert(cells.size() == 6 * square(cells_per_side));
  entry_.resize(entry_count(cells_per_side));
  std::span<const RadiusWord> pieces = cells;
  const int levels = level_count(cells_per_side);
  for (int k = 0; k < levels; ++k) {
    const int n = cells_per_side >> k;
    RadiusWord* out = entry_.data() + 8 * (square(cells_per_side) - square(n));
    widen_faces(pieces, n, out);
    widen_across_edges(pieces, n, out);
    if (k + 1 == levels) break;
    halve(pieces, n, coarser_);
    std::swap(piece_, coarser_);
    pieces = piece_;
  }
}

}  // namespace condyle
