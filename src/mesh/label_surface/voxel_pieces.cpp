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

/// How far apart faces are that belong together: growth plates are 2 to 4.5 mm wide; and the bone in which they are, mm.
constexpr double widest_gap = 5, usual_bone = 150;
/// Faces that belong together are a part of the smaller piece's border: of a hip bone's three parts 5 % and more.
constexpr double least_facing = 0.02;
/// Bones of two sides are as large as each other, to this factor, and share no more than this part of their breadth.
constexpr std::int64_t sides_differ = 5;
constexpr double shared_breadth = 0.25;

struct BonePiece {
  std::int64_t voxels = 0;
  Vec3 sum = Vec3::Zero();  ///< of the voxels' centres, in the world
  double left = std::numeric_limits<double>::infinity(), right = -left;  ///< ends along x

  void add(const Run& run, std::int64_t j, std::int64_t k, const Eigen::Affine3d& X_WB) {
    const auto at = [&](double i) { return X_WB * Vec3(i, static_cast<double>(j), static_cast<double>(k)); };
    const Vec3 first = at(static_cast<double>(run.begin)), last = at(static_cast<double>(run.end - 1));
    const auto count = static_cast<double>(run.end - run.begin);
    add({run.end - run.begin, count / 2 * (first + last), std::min(first.x(), last.x()),
         std::max(first.x(), last.x())});
  }
  void add(const BonePiece& other) {
    voxels += other.voxels, sum += other.sum;
    left = std::min(left, other.left), right = std::max(right, other.right);
  }
  Vec3 centroid() const { return sum / static_cast<double>(voxels); }
};

/// As the halves of a pelvis lie, and both femora.
bool are_side_by_side(const BonePiece& a, const BonePiece& b) noexcept {
  const double shared = std::min(a.right, b.right) - std::max(a.left, b.left);
  return a.voxels <= sides_differ * b.voxels && b.voxels <= sides_differ * a.voxels &&
         shared <= shared_breadth * std::min(a.right - a.left, b.right - b.left);
}

/// Steps to voxels within a distance, mm.
std::vector<std::array<std::int64_t, 3>> steps_within(const Eigen::Matrix3d& edges, double distance) {
  // No more than so many rows of the lattice lie within the distance along each index.
  const Eigen::Matrix3d inverse = edges.inverse();
  std::array<std::int64_t, 3> reach;
  for (int i = 0; i < 3; ++i)
    reach[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(distance * inverse.row(i).norm());
  std::vector<std::array<std::int64_t, 3>> steps;
  for (std::int64_t k = -reach[2]; k <= reach[2]; ++k)
    for (std::int64_t j = -reach[1]; j <= reach[1]; ++j)
      for (std::int64_t i = -reach[0]; i <= reach[0]; ++i)
        if ((edges * Vec3(double(i), double(j), double(k))).norm() <= distance) steps.push_back({i, j, k});
  return steps;
}

/// Pairs of pieces of which the smaller has a part of its border near the other.
std::vector<std::pair<Index, Index>> facing_pairs(const std::vector<std::uint8_t>& owner,
                                                  const std::array<std::int64_t, 3>& size,
                                                  const Eigen::Matrix3d& edges,
                                                  const std::vector<BonePiece>& pieces) {
  const std::size_t count = pieces.size();
  const auto at = [&](std::int64_t i, std::int64_t j, std::int64_t k) -> std::uint8_t {
    const bool inside = i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
    return inside ? owner[static_cast<std::size_t>(i + size[0] * (j + size[1] * k))] : std::uint8_t{0};
  };
  const Vec3 diagonal = edges.cwiseAbs() * Vec3(double(size[0]), double(size[1]), double(size[2]));
  const double gap = widest_gap * std::min(1.0, diagonal.norm() / usual_bone);
  const auto steps = steps_within(edges, gap + edges.colwise().norm().maxCoeff());
  std::vector<double> border(count), facing(count * count);
  // Every voxel of a border would take seconds at half a millimetre: as many as there are in one of 1.5 mm do.
  const std::size_t stride = std::max<std::size_t>(1, steps.size() / 500);
  std::size_t number = 0;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const std::uint8_t own = at(i, j, k);
        if (own == 0 || own > count) continue;
        if (at(i - 1, j, k) == own && at(i + 1, j, k) == own && at(i, j - 1, k) == own &&
            at(i, j + 1, k) == own && at(i, j, k - 1) == own && at(i, j, k + 1) == own)
          continue;
        if (number++ % stride != 0) continue;
        ++border[own - 1U];
        std::array<bool, 256> is_near{};
        for (const auto& [di, dj, dk] : steps) is_near[at(i + di, j + dj, k + dk)] = true;
        for (std::size_t other = 0; other < count; ++other)
          facing[(own - 1U) * count + other] += is_near[other + 1];
      }
  std::vector<std::pair<Index, Index>> pairs;
  for (Index a = 0; a < count; ++a)
    for (Index b = a + 1; b < count; ++b) {
      const Index smaller = pieces[a].voxels < pieces[b].voxels ? a : b, other = a + b - smaller;
      if (facing[smaller * count + other] >= least_facing * border[smaller]) pairs.emplace_back(a, b);
    }
  return pairs;
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

KeptBone keep_bone(VoxelBox& box, const Eigen::Affine3d& X_WB, const std::optional<Vec3>& point_W) {
  const Runs runs(box, 1);
  DisjointSets sets = runs.connected(true);
  std::vector<BonePiece> of_run(runs.count());
  runs.for_each([&](std::size_t r, const Run& run, std::int64_t j, std::int64_t k) {
    of_run[sets.find(static_cast<Index>(r))].add(run, j, k, X_WB);
  });
  const auto fewer = [](const BonePiece& a, const BonePiece& b) { return a.voxels < b.voxels; };
  const std::int64_t most =
      of_run.empty() ? 0 : std::max_element(of_run.begin(), of_run.end(), fewer)->voxels;
  // Owners of voxels: 0 none, from 1 the pieces that are no specks, the last number all specks.
  constexpr std::uint8_t speck = 255;
  std::vector<BonePiece> pieces;
  std::vector<std::uint8_t> number(of_run.size(), speck);
  KeptBone kept;
  for (std::size_t r = 0; r < of_run.size(); ++r) {
    if (of_run[r].voxels == 0) continue;
    if (speck_share * of_run[r].voxels >= most && pieces.size() + 1 < speck)
      pieces.push_back(of_run[r]), number[r] = static_cast<std::uint8_t>(pieces.size());
    else
      kept.left_out.push_back({of_run[r].voxels, false});
  }
  if (pieces.size() < 2) return {};
  std::vector<std::uint8_t> owner(box.inside.size(), 0);
  runs.for_each([&](std::size_t r, const Run& run, std::int64_t j, std::int64_t k) {
    const std::int64_t row = (j + k * box.size[1]) * box.size[0];
    std::fill(owner.begin() + row + run.begin, owner.begin() + row + run.end,
              number[sets.find(static_cast<Index>(r))]);
  });
  DisjointSets together(pieces.size());
  for (const auto& [a, b] : facing_pairs(owner, box.size, X_WB.linear(), pieces))
    if (!are_side_by_side(pieces[a], pieces[b])) together.join(a, b);
  std::vector<BonePiece> bones(pieces.size());
  for (Index p = 0; p < pieces.size(); ++p) bones[together.find(p)].add(pieces[p]);
  const std::int64_t largest = std::max_element(bones.begin(), bones.end(), fewer)->voxels;
  std::size_t chosen = bones.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < bones.size(); ++b) {
    if (!is_large_piece(bones[b].voxels, largest)) continue;
    const double distance = point_W ? (bones[b].centroid() - *point_W).norm() : -double(bones[b].voxels);
    if (distance < least) least = distance, chosen = b;
  }
  kept.pieces = 0;
  std::vector<std::uint8_t> stays(256, 0);
  for (Index p = 0; p < pieces.size(); ++p) {
    const std::size_t bone = together.find(p);
    stays[p + 1] = bone == chosen;
    if (bone == chosen)
      ++kept.pieces;
    else
      kept.left_out.push_back({pieces[p].voxels, are_side_by_side(bones[bone], bones[chosen])});
  }
  std::transform(owner.begin(), owner.end(), box.inside.begin(), [&](std::uint8_t o) { return stays[o]; });
  return kept;
}

double share_in_shells(std::span<const std::uint16_t> image, std::uint16_t nothing, const VoxelMask& mask) {
  const std::array<std::int64_t, 3>& size = mask.image.size;
  std::size_t border = 0, in_shell = 0;
  for (std::int64_t m = 0; m < std::ssize(mask.inside); ++m) {
    if (!mask.inside[static_cast<std::size_t>(m)]) continue;
    const std::array<std::int64_t, 3> at{m % mask.size[0], m / mask.size[0] % mask.size[1],
                                         m / mask.size[0] / mask.size[1]};
    const std::int64_t voxel =
        mask.first[0] + at[0] + size[0] * (mask.first[1] + at[1] + size[1] * (mask.first[2] + at[2]));
    std::int64_t step = 1, step_in_mask = 1;
    for (std::size_t axis = 0; axis < 3; step *= size[axis], step_in_mask *= mask.size[axis], ++axis)
      for (const std::int64_t way : {-1, 1}) {
        const std::int64_t next = at[axis] + way, beyond = mask.first[axis] + next + way;
        if (next >= 0 && next < mask.size[axis] &&
            mask.inside[static_cast<std::size_t>(m + way * step_in_mask)])
          continue;
        ++border;
        if (beyond < 0 || beyond >= size[axis]) continue;
        const std::uint16_t value = image[static_cast<std::size_t>(voxel + way * step)];
        in_shell += value != nothing && image[static_cast<std::size_t>(voxel + 2 * way * step)] != value;
      }
  }
  return border == 0 ? 0 : static_cast<double>(in_shell) / static_cast<double>(border);
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
