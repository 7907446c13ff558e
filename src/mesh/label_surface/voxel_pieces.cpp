#include "mesh/label_surface/voxel_pieces.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "mesh/disjoint_sets.hpp"

namespace condyle::mesh {
namespace {

/// Voxels [begin, end) of a row of the box that have one value.
struct Run {
  std::int64_t begin, end;
};

/// All runs of one value, row by row.
///
///   first_     0     2  2        5  ...      one entry per row, plus one
///   run_      | a b |  | c d e |    ...      row j + k size_j owns [first_[row], first_[row + 1])
class Runs {
 public:
  Runs(const VoxelBox& box, std::uint8_t value) : size_(box.size) {
    first_.reserve(static_cast<std::size_t>(rows()) + 1);
    first_.push_back(0);
    const auto width = static_cast<std::ptrdiff_t>(size_[0]);
    auto row = box.inside.begin();
    for (std::int64_t r = 0; r < rows(); ++r, row += width) {
      const auto end = row + width;
      for (auto at = row; (at = std::find(at, end, value)) != end;) {
        const auto last = std::find(at, end, static_cast<std::uint8_t>(1 - value));
        run_.push_back({at - row, last - row});
        at = last;
      }
      first_.push_back(run_.size());
    }
  }

  std::size_t count() const noexcept { return run_.size(); }

  /// visit(run's number, run, j, k)
  template <class Visit>
  void for_each(const Visit& visit) const {
    std::int64_t row = 0;
    for (std::int64_t k = 0; k < size_[2]; ++k) {
      for (std::int64_t j = 0; j < size_[1]; ++j, ++row) {
        for (std::size_t r = first_[static_cast<std::size_t>(row)];
             r < first_[static_cast<std::size_t>(row) + 1]; ++r)
          visit(r, run_[r], j, k);
      }
    }
  }

  /// Runs joined that meet over faces only, or over edges and corners too.
  DisjointSets connected(bool over_corners) const {
    DisjointSets sets(run_.size());
    for (std::int64_t k = 0; k < size_[2]; ++k) {
      for (std::int64_t j = 0; j < size_[1]; ++j) {
        join_rows(sets, j, k, j - 1, k, over_corners);
        join_rows(sets, j, k, j, k - 1, over_corners);
        if (!over_corners) continue;
        join_rows(sets, j, k, j - 1, k - 1, over_corners);
        join_rows(sets, j, k, j + 1, k - 1, over_corners);
      }
    }
    return sets;
  }

 private:
  std::int64_t rows() const noexcept { return size_[1] * size_[2]; }

  /// Joins the runs of two neighbouring rows, of which the second may be outside the box.
  void join_rows(DisjointSets& sets, std::int64_t j, std::int64_t k, std::int64_t other_j,
                 std::int64_t other_k, bool over_corners) const {
    if (other_j < 0 || other_k < 0 || other_j >= size_[1]) return;
    const auto row = static_cast<std::size_t>(j + k * size_[1]),
               other = static_cast<std::size_t>(other_j + other_k * size_[1]);
    const std::int64_t reach = over_corners ? 1 : 0;
    std::size_t a = first_[row], b = first_[other];
    while (a < first_[row + 1] && b < first_[other + 1]) {
      if (run_[a].begin < run_[b].end + reach && run_[b].begin < run_[a].end + reach)
        sets.join(static_cast<Index>(a), static_cast<Index>(b));
      run_[a].end < run_[b].end ? ++a : ++b;
    }
  }

  std::array<std::int64_t, 3> size_;
  std::vector<std::size_t> first_;
  std::vector<Run> run_;
};

std::span<std::uint8_t> voxels_of(VoxelBox& box, const Run& run, std::int64_t j, std::int64_t k) {
  const std::int64_t row = (j + k * box.size[1]) * box.size[0];
  return std::span(box.inside)
      .subspan(static_cast<std::size_t>(row + run.begin), static_cast<std::size_t>(run.end - run.begin));
}

}  // namespace

std::vector<std::int64_t> keep_pieces(VoxelBox& box, bool all) {
  const Runs runs(box, 1);
  DisjointSets sets = runs.connected(true);
  std::vector<std::int64_t> voxels(runs.count(), 0);
  runs.for_each([&](std::size_t r, const Run& run, std::int64_t, std::int64_t) {
    voxels[sets.find(static_cast<Index>(r))] += run.end - run.begin;
  });
  // The first of equals.
  const auto most = static_cast<std::size_t>(std::max_element(voxels.begin(), voxels.end()) - voxels.begin());
  if (!all) {
    runs.for_each([&](std::size_t r, const Run& run, std::int64_t j, std::int64_t k) {
      if (sets.find(static_cast<Index>(r)) == most) return;
      const auto row = voxels_of(box, run, j, k);
      std::fill(row.begin(), row.end(), std::uint8_t{0});
    });
  }
  std::erase(voxels, 0);
  std::stable_sort(voxels.begin(), voxels.end(), std::greater<>());
  return voxels;
}

std::vector<std::int64_t> keep_large_piece_near(VoxelBox& box, const Eigen::Affine3d& X_WB,
                                                const Vec3& point_W) {
  struct Piece {
    std::int64_t voxels = 0;
    Vec3 sum = Vec3::Zero();  ///< of the voxels' indices
    bool is_taken_out = false;
  };
  const Runs runs(box, 1);
  DisjointSets sets = runs.connected(true);
  std::vector<Piece> pieces(runs.count());
  std::int64_t most = 0;
  runs.for_each([&](std::size_t r, const Run& run, std::int64_t j, std::int64_t k) {
    Piece& piece = pieces[sets.find(static_cast<Index>(r))];
    const std::int64_t voxels = run.end - run.begin;
    piece.voxels += voxels;
    piece.sum += static_cast<double>(voxels) * Vec3(static_cast<double>(run.begin + run.end - 1) / 2,
                                                    static_cast<double>(j), static_cast<double>(k));
    most = std::max(most, piece.voxels);
  });
  Piece* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (Piece& piece : pieces) {
    piece.is_taken_out = is_large_piece(piece.voxels, most);
    if (!piece.is_taken_out) continue;
    const Vec3 centroid_W = X_WB * (piece.sum / static_cast<double>(piece.voxels));
    if (const double distance = (centroid_W - point_W).norm(); distance < least)
      least = distance, nearest = &piece;
  }
  if (nearest) nearest->is_taken_out = false;
  runs.for_each([&](std::size_t r, const Run& run, std::int64_t j, std::int64_t k) {
    if (!pieces[sets.find(static_cast<Index>(r))].is_taken_out) return;
    const auto row = voxels_of(box, run, j, k);
    std::fill(row.begin(), row.end(), std::uint8_t{0});
  });
  std::vector<std::int64_t> taken_out;
  for (const Piece& piece : pieces)
    if (piece.is_taken_out) taken_out.push_back(piece.voxels);
  return taken_out;
}

Cavities find_cavities(VoxelBox& box, bool fill) {
  const Runs runs(box, 0);
  DisjointSets sets = runs.connected(false);
  std::vector<std::uint8_t> outside(runs.count(), 0);
  runs.for_each([&](std::size_t r, const Run& run, std::int64_t j, std::int64_t k) {
    if (run.begin == 0 || run.end == box.size[0] || j == 0 || j == box.size[1] - 1 || k == 0 ||
        k == box.size[2] - 1)
      outside[sets.find(static_cast<Index>(r))] = 1;
  });
  Cavities found;
  runs.for_each([&](std::size_t r, const Run& run, std::int64_t j, std::int64_t k) {
    const Index set = sets.find(static_cast<Index>(r));
    if (outside[set]) return;
    found.count += set == r;
    found.voxels += run.end - run.begin;
    if (!fill) return;
    const auto row = voxels_of(box, run, j, k);
    std::fill(row.begin(), row.end(), std::uint8_t{1});
  });
  return found;
}

}  // namespace condyle::mesh
