#include <algorithm>

#include "mesh/disjoint_sets.hpp"
#include "mesh/label_surface/voxel_pieces.hpp"

namespace condyle::mesh {
namespace {

/// Voxels [begin, end) of a row that have one value.
struct ValueRun {
  std::int64_t begin, end;
  std::uint16_t value;
};

/// The runs of one slice, row by row, which cover it. Runs of row j are [first[j], first[j + 1]).
struct Slice {
  std::vector<std::size_t> first;
  std::vector<ValueRun> runs;
  /// The first run of this slice that is in the same piece, as far as slices up to this one show.
  std::vector<Index> piece;
};

void read_rows(std::span<const std::uint16_t> voxels, std::int64_t width, Slice& slice) {
  slice.first.assign(1, 0);
  slice.runs.clear();
  for (; !voxels.empty(); voxels = voxels.subspan(static_cast<std::size_t>(width))) {
    for (std::int64_t begin = 0; begin < width;) {
      const std::uint16_t value = voxels[static_cast<std::size_t>(begin)];
      std::int64_t end = begin + 1;
      while (end < width && voxels[static_cast<std::size_t>(end)] == value) ++end;
      slice.runs.push_back({begin, end, value});
      begin = end;
    }
    slice.first.push_back(slice.runs.size());
  }
}

/// Calls meet(a, b) for the runs of one value, a of a row and b of another one, that meet over faces, edges or corners.
template <class Meet>
void for_each_meeting(const Slice& slice, std::size_t row, const Slice& other, std::size_t other_row,
                      const Meet& meet) {
  std::size_t from = other.first[other_row];
  const std::size_t last = other.first[other_row + 1];
  for (std::size_t a = slice.first[row]; a < slice.first[row + 1]; ++a) {
    const ValueRun& run = slice.runs[a];
    while (from < last && other.runs[from].end < run.begin) ++from;
    // A run that ends where this one begins meets it at a corner, and so may the next run of the row.
    for (std::size_t b = from; b < last && other.runs[b].begin <= run.end; ++b)
      if (other.runs[b].value == run.value) meet(static_cast<Index>(a), static_cast<Index>(b));
  }
}

}  // namespace

std::vector<std::size_t> count_pieces(std::span<const std::uint16_t> voxels,
                                      const std::array<std::int64_t, 3>& size, std::size_t values) {
  std::vector<std::size_t> pieces(values, 0);
  const auto rows = static_cast<std::size_t>(size[1]);
  const auto area = static_cast<std::size_t>(size[0] * size[1]);
  Slice below, slice;
  for (std::int64_t k = 0; k < size[2]; ++k) {
    read_rows(voxels.subspan(static_cast<std::size_t>(k) * area, area), size[0], slice);
    // Runs of the slice below come behind those of this one, which then represent what goes on upwards.
    const auto own = static_cast<Index>(slice.runs.size());
    DisjointSets sets(slice.runs.size() + below.runs.size());
    for (std::size_t b = 0; b < below.runs.size(); ++b)
      sets.join(own + static_cast<Index>(b), own + below.piece[b]);
    for (const ValueRun& run : slice.runs) ++pieces[run.value];
    // Each join of two pieces leaves one fewer.
    const auto join = [&](Index a, Index b) { pieces[slice.runs[a].value] -= sets.join(a, b); };
    for (std::size_t j = 0; j < rows; ++j) {
      if (j > 0) for_each_meeting(slice, j, slice, j - 1, join);
      if (k == 0) continue;
      for (std::size_t other = j > 0 ? j - 1 : 0; other <= std::min(j + 1, rows - 1); ++other)
        for_each_meeting(slice, j, below, other, [&](Index a, Index b) { join(a, own + b); });
    }
    slice.piece.resize(slice.runs.size());
    for (std::size_t r = 0; r < slice.runs.size(); ++r) slice.piece[r] = sets.find(static_cast<Index>(r));
    std::swap(below, slice);
  }
  return pieces;
}

}  // namespace condyle::mesh
