#include "radial/query/penetrations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "radial/exact/ray_scan.hpp"

namespace condyle::radial {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Winding numbers that PointResult holds, with those of the most crossings that a Ray holds beside.
constexpr int largest_winding = 1000;

/// How far a rotation's columns may be from orthonormal, for blocks to keep their radii and caps.
constexpr double rotation_error = 1e-6;

bool is_rotation(const Pose& X) {
  const Eigen::Matrix3d R = X.linear();
  return ((R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().array() <= rotation_error).all();
}

FloatPose float_pose(const Pose& X, const Vec3& centre) {
  FloatPose pose{};
  const Vec3 t = X * centre;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      pose.rotation[static_cast<std::size_t>(3 * i + k)] = static_cast<float>(X.linear()(i, k));
    pose.translation[static_cast<std::size_t>(i)] = static_cast<float>(t[i]);
  }
  const double distance = t.norm();
  pose.distance = distance > 0 ? std::nextafter(static_cast<float>(distance), infinity) : 0.0f;
  return pose;
}

BlockColumns blocks_of(const PointBlocks& points, std::size_t level) {
  const auto column = [&](PointBlocks::Column c) { return points.block(level, c); };
  using P = PointBlocks;
  return {.axis_x = column(P::axis_x),
          .axis_y = column(P::axis_y),
          .axis_z = column(P::axis_z),
          .chord = column(P::chord),
          .nearest = column(P::nearest),
          .furthest = column(P::furthest),
          .mean_inverse = column(P::mean_inverse),
          .spread = column(P::spread),
          .count = points.block_count(level)};
}

PointColumns points_of(const PointBlocks& points) {
  return {points.coordinate(0), points.coordinate(1), points.coordinate(2), points.size()};
}

/// One query on its way through the passes.
struct Search {
  CubeView cube;
  PointColumns columns;
  FloatPose pose;
  float form_bound;  ///< for inside_points
};

/// Empty where floats are not to be trusted with these points and this pose.
std::optional<Search> search_in(const ExactView& table, const std::optional<CubeView>& cube,
                                const PointBlocks& points, const Pose& X_FM) {
  if (!cube || table.mesh.triangles.empty() || !is_rotation(X_FM)) return {};
  const double nearest = std::sqrt(cube->nearest_squared), furthest = std::sqrt(cube->furthest_squared);
  const bool in_range =
      nearest > least_length && furthest < greatest_length && points.reach() < greatest_length;
  const FloatPose pose = float_pose(X_FM, points.centre());
  if (!in_range || !(pose.distance <= largest_translation * nearest)) return {};
  if (std::abs(table.winding_at_centre) > largest_winding) return {};
  const double translation = pose.distance / nearest;
  const double bound = (form_error + form_error_of_translation * translation) * (1 + 0x1p-20);
  return Search{*cube, points_of(points), pose, static_cast<float>(bound)};
}

/// Forms of the triangles of points found from `first` on; no form of those that are uncertain is read.
const EdgeFunctions* forms_of(const CubeView& cube, const PointResults& found, std::size_t first,
                              std::size_t count, FormsOnDemand& on_demand) {
  std::array<std::uint32_t, GapColumns::size> triangle;
  for (std::size_t i = 0; i < count; ++i)
    triangle[i] = found.point[first + i].uncertain ? 0 : found.point[first + i].triangle;
  return on_demand.measure(cube, {triangle.data(), count});
}

/// For `count` points found from `first` on: gaps to the planes of their triangles. `of_points` are their forms where the table
/// has none.
void find_gaps(const PointBlocks& points, const EdgeFunctions* all_functions, const EdgeFunctions* of_points,
               const Pose& X_FM, const PointResults& found, std::size_t first, std::size_t count,
               GapColumns& out) {
  constexpr std::size_t ahead = 16;
  constexpr EdgeFunctions none{};  // what becomes of one that is uncertain is not read
  const Vec3* const all_points = &points[0];
  for (std::size_t i = 0; i < count; ++i) {
    const PointResult& at = found.point[first + i];
    __builtin_prefetch(all_points + found.point[std::min(first + i + ahead, found.count - 1)].point);
    const Vec3& p = all_points[at.point];
    const EdgeFunctions& functions = at.uncertain ? none
                                     : of_points  ? of_points[i]
                                                  : all_functions[at.triangle];
    out.point[0][i] = p.x(), out.point[1][i] = p.y(), out.point[2][i] = p.z();
    const Vec3 normal = functions.scaled_normal();
    for (int k = 0; k < 3; ++k) out.normal[k][i] = normal[k];
  }
  out.count = count;
  gaps_to_planes(X_FM, out);
}

/// Writes what is found to the answers: points that are inside, and points to decide exactly.
class Answers {
 public:
  Answers(const ExactView& table, const PointBlocks& points, const Pose& X_FM, Penetrations& out)
      : table_(table),
        points_(points),
        X_FM_(X_FM),
        out_(out),
        scan_(table.mesh, table.winding_at_centre),
        candidates_(table.map, table.entries) {}

  /// Depths in double. `cube` is null if all are uncertain.
  void add(const PointResults& found, const CubeView* cube, FormsOnDemand& on_demand) {
    std::size_t count = out_.size();
    out_.resize(count + found.count);
    gathered_ = 0, next_ = 0;
    GapColumns gaps;
    for (std::size_t i = 0; i < found.count; ++i) {
      const std::size_t in_turn = i % GapColumns::size;
      if (in_turn == 0) {
        const std::size_t part = std::min(GapColumns::size, found.count - i);
        const EdgeFunctions* const all = cube ? cube->edge_functions : nullptr;
        const EdgeFunctions* const some = cube && !all ? forms_of(*cube, found, i, part, on_demand) : nullptr;
        find_gaps(points_, all, some, X_FM_, found, i, part, gaps);
      }
      const PointResult& at = found.point[i];
      out_.point[count] = points_.index()[at.point];
      if (at.uncertain) {
        count += decide(found, i, count);
      } else {
        set(at, gaps.gap[in_turn], count++);
      }
    }
    out_.resize(count);
  }

 private:
  void set(const PointResult& at, double gap, std::size_t to) {
    if (std::isnan(gap))
      gap = distance_along_ray(posed(X_FM_, points_[at.point]), cone_of(table_.mesh, at.triangle));
    out_.state[to] = PointState::inside;
    out_.winding[to] = at.winding;
    out_.triangle[to] = at.triangle;
    out_.depth_mm[to] = std::abs(gap);
    out_.direction[to] = at.away_from_centre ? RayDirection::away_from_centre : RayDirection::towards_centre;
  }

  /// The uncertain point i; 0 if it is outside, else 1.
  std::size_t decide(const PointResults& found, std::size_t i, std::size_t to) {
    if (next_ == gathered_) gather(found, i);
    const Vec3& v = position_[next_];
    const RayAnswer answer = scan_.answer(v, candidates_.of(next_++));
    if (answer.state == PointState::outside) return 0;
    out_.state[to] = answer.state;
    out_.winding[to] = answer.winding;
    out_.triangle[to] = answer.triangle;
    out_.depth_mm[to] = std::abs(answer.gap);
    out_.direction[to] = answer.direction;
    return 1;
  }

  /// The next uncertain points, from i on.
  void gather(const PointResults& found, std::size_t i) {
    gathered_ = 0, next_ = 0;
    for (; i < found.count && gathered_ < position_.size(); ++i) {
      if (found.point[i].uncertain) position_[gathered_++] = posed(X_FM_, points_[found.point[i].point]);
    }
    candidates_.gather({position_.data(), gathered_});
  }

  const ExactView& table_;
  const PointBlocks& points_;
  const Pose& X_FM_;
  Penetrations& out_;
  RayScan scan_;
  Candidates candidates_;
  std::array<Vec3, points_per_gathering> position_;
  std::size_t gathered_ = 0, next_ = 0;
};

void decide_one_by_one(const PointBlocks& points, PenetrationScratch& scratch, Answers& answers) {
  PointResults& all = scratch.found;
  for (std::size_t first = 0; first < points.size(); first += points_per_batch) {
    all.count = std::min(points_per_batch, points.size() - first);
    for (std::size_t i = 0; i < all.count; ++i)
      all.point[i] = PointResult::left_open(static_cast<std::uint32_t>(first + i));
    answers.add(all, nullptr, scratch.crossing.forms);
  }
}

/// Decides the near points that were found.
void decide(const Search& search, PenetrationScratch& scratch, Answers& answers, PenetrationWork* work) {
  const NearPoints& near = scratch.near;
  if (near.count == 0) return;
  PointResults& found = scratch.found;
  const std::size_t tried = inside_points(search.cube, near, search.form_bound, scratch.crossing, found);
  answers.add(found, &search.cube, scratch.crossing.forms);
  if (!work) return;
  work->near_points += near.count;
  work->triangles += tried;
  for (std::size_t i = 0; i < found.count; ++i) work->uncertain += found.point[i].uncertain;
}

}  // namespace

void penetrations(const ExactView& table, const std::optional<CubeView>& cube, const PointBlocks& points,
                  const Pose& X_FM, PenetrationScratch& scratch, Penetrations& out, PenetrationWork* work) {
  out.clear();
  Answers answers(table, points, X_FM, out);
  const std::optional<Search> search = search_in(table, cube, points, X_FM);
  if (!search) return decide_one_by_one(points, scratch, answers);

  const BlockColumns blocks = blocks_of(points, 0), groups = blocks_of(points, 1);
  constexpr std::size_t fan = PointBlocks::fan, groups_per_batch = blocks_per_batch / fan;
  constexpr std::size_t sets_per_batch = 16;
  std::array<std::uint32_t, sets_per_batch> set;
  std::array<std::uint32_t, sets_per_batch * fan + vector_padding> near_group;
  std::array<std::uint32_t, blocks_per_batch + vector_padding> near_block;
  const std::size_t set_count = (groups.count + fan - 1) / fan;
  for (std::size_t first_set = 0; first_set < set_count; first_set += sets_per_batch) {
    const std::size_t sets = std::min(sets_per_batch, set_count - first_set);
    for (std::size_t i = 0; i < sets; ++i) set[i] = static_cast<std::uint32_t>(first_set + i);
    const std::size_t group_count =
        near_blocks(search->cube, groups, search->pose, set.data(), sets, near_group.data());
    for (std::size_t first = 0; first < group_count; first += groups_per_batch) {
      const std::size_t group_last = std::min(first + groups_per_batch, group_count);
      const std::size_t count = near_blocks(search->cube, blocks, search->pose, near_group.data() + first,
                                            group_last - first, near_block.data());
      if (work) work->near_blocks += count;
      if (count == 0) continue;
      near_points(search->cube, search->columns, search->pose, near_block.data(), count, scratch.near);
      decide(*search, scratch, answers, work);
    }
  }
  if (work) work->blocks += blocks.count;
}

}  // namespace condyle::radial
