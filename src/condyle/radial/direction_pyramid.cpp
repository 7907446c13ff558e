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

/// `in` with borders wider by one piece, within each face.
void widen_faces(const RadiusWord* in, int n, RadiusWord* out) {
  std::vector<RadiusWord> widened(square(n));
  const auto row = [&](int j) { return static_cast<std::size_t>(j) * static_cast<std::size_t>(n); };
  for (int face = 0; face < 6; ++face) {
    const std::size_t start = static_cast<std::size_t>(face) * square(n);
    for (int j = 0; j < n; ++j) widen_row(in + start + row(j), n, widened.data() + row(j));
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

/// The rows of pieces that lie along an edge of the cube, seen from one of its faces.
class BeyondEdge {
 public:
  /// Edge 2 a + b of a face with axis x: a = 0 across x + 1, a = 1 across x + 2; b = 0 on its negative side.
  BeyondEdge(std::span<const RadiusWord> pieces, int n, int face, int edge, int depth) : n_(n) {
    const CubeMap map(n);
    const int axis = face % 3, across = (axis + 1 + edge / 2) % 3, along = (axis + 2 - edge / 2) % 3;
    within_.resize(static_cast<std::size_t>(depth * n));
    for (int k = 0; k < n; ++k) {
      RadiusWord so_far = no_radii;
      for (int m = 0; m < depth; ++m) {
        Vec3 direction;
        direction[across] = edge % 2 == 0 ? -1 : 1;
        direction[axis] = (face < 3 ? 1 : -1) * middle(n - 1 - m);
        direction[along] = middle(k);
        so_far = union_of(so_far, pieces[map.cell_of(direction)]);
        within_[static_cast<std::size_t>(m * n + k)] = so_far;
      }
    }
  }

  /// Of the first `depth` pieces beyond the edge, from `first` to `last` along it.
  RadiusWord radii(int depth, int first, int last) const {
    RadiusWord word = no_radii;
    for (int k = std::max(first, 0); k <= std::min(last, n_ - 1); ++k) {
      word = union_of(word, within_[static_cast<std::size_t>((depth - 1) * n_ + k)]);
    }
    return word;
  }

 private:
  double middle(int k) const { return (2 * k + 1.0) / n_ - 1; }

  int n_;
  std::vector<RadiusWord> within_;
};

/// Borders across the edges of the cube. A direction of a piece that q others part from an edge may be
/// displaced beyond it by d = border - q pieces. There a coordinate 1 + e is 1 / (1 + e), at least 1 - e: it
/// enters the neighbouring face by no more than d pieces. The other coordinate is divided by 1 + e too, which
/// brings it nearer to the middle by at most d pieces more than it is displaced by.
void widen_across_edges(std::span<const RadiusWord> pieces, int n, int border, RadiusWord* out) {
  for (int face = 0; face < 6; ++face) {
    for (int edge = 0; edge < 4; ++edge) {
      const BeyondEdge beyond(pieces, n, face, edge, std::min(border, n));
      for (int q = 0; q < std::min(border, n); ++q) {
        for (int k = 0; k < n; ++k) {
          // Columns run along axis + 1, rows along axis + 2.
          const int at_edge = edge % 2 == 0 ? q : n - 1 - q;
          const int column = edge / 2 == 0 ? at_edge : k, row = edge / 2 == 0 ? k : at_edge;
          RadiusWord& entry = out[static_cast<std::size_t>((face * n + row) * n + column)];
          const int depth = border - q, reach = border + depth;
          entry = union_of(entry, beyond.radii(std::min(depth, n), k - reach, k + reach));
        }
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

int DirectionPyramid::step_count(int cells_per_side) noexcept {
  int levels = 1;
  for (int n = cells_per_side; n % 2 == 0 && n / 2 >= 4; n /= 2) ++levels;
  return 1 + 2 * levels;
}

std::size_t DirectionPyramid::start_of(int step, int cells_per_side) noexcept {
  if (step == 0) return 0;
  // Two steps of each level are 12 n^2 entries; those before level k, with the first step, a geometric
  // series.
  const std::size_t finest = square(cells_per_side), own = square(cells_per_side >> level_of(step));
  return 6 * finest + 16 * (finest - own) + (border_of(step) == 3 ? 6 * own : 0);
}

std::size_t DirectionPyramid::entry_count(int cells_per_side) noexcept {
  const int last = step_count(cells_per_side) - 1;
  return start_of(last, cells_per_side) + 6 * square(cells_per_side >> level_of(last));
}

void DirectionPyramid::fill(int cells_per_side, std::span<const RadiusWord> cells) {
  assert(cells.size() == 6 * square(cells_per_side));
  entry_.resize(entry_count(cells_per_side));
  piece_.assign(cells.begin(), cells.end());
  const int steps = step_count(cells_per_side);
  const auto entries = [&](int step) { return entry_.data() + start_of(step, cells_per_side); };
  std::vector<RadiusWord> border_of_one;
  for (int step = 1; step < steps; step += 2) {
    const int n = cells_per_side >> level_of(step);
    RadiusWord* one = entries(0);
    if (step > 1) {
      border_of_one.resize(6 * square(n));
      one = border_of_one.data();
    }
    // Within the faces all of them first: what is beyond an edge is not to be widened again.
    widen_faces(piece_.data(), n, one);
    widen_faces(one, n, entries(step));
    widen_faces(entries(step), n, entries(step + 1));
    if (step == 1) widen_across_edges(piece_, n, 1, one);
    widen_across_edges(piece_, n, 2, entries(step));
    widen_across_edges(piece_, n, 3, entries(step + 1));
    if (step + 2 >= steps) break;
    halve(piece_, n, coarser_);
    std::swap(piece_, coarser_);
  }
}

}  // namespace condyle
