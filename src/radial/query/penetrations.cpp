#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.hpp"
#include "radial/direction_table.hpp"
#include "radial/exact/triangle_plane.hpp"
#include "radial/query/penetration_search.hpp"

namespace condyle::radial {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Lengths that floats square and multiply without overflow or loss, mm.
constexpr double least_length = 0x1p-40, greatest_length = 0x1p40;

/// Winding numbers that FoundPoint holds, with those of the most crossings that a Ray holds beside.
constexpr int largest_winding = 1000;

/// How far a rotation's columns may be from orthonormal, for blocks to keep their radii and caps.
constexpr double rotation_error = 1e-6;

bool is_rotation(const Pose& X) {
  const Eigen::Matrix3d R = X.linear();
  return ((R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().array() <= rotation_error).all();
}

}  // namespace

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
  return {column(P::axis_x),       column(P::axis_y),  column(P::axis_z),
          column(P::chord),        column(P::nearest), column(P::furthest),
          column(P::mean_inverse), column(P::spread),  points.block_count(level)};
}

PointColumns points_of(const PointBlocks& points) {
  return {points.coordinate(0), points.coordinate(1), points.coordinate(2), points.size()};
}

bool DirectionTable::begin(const PointBlocks& points, const Pose& X_FM, PenetrationSearch& search) const {
  const auto* map = std::get_if<CubeMap>(&map_);
  if (!map || mesh_.triangles.empty() || !is_rotation(X_FM)) return false;
  search.pose = float_pose(X_FM, points.centre());
  search.cube = view_of(*map);
  const double nearest = std::sqrt(lists_.least_squared), furthest = std::sqrt(lists_.greatest_squared);
  const bool in_range =
      nearest > least_length && furthest < greatest_length && points.reach() < greatest_length;
  if (!in_range || !(search.pose.distance <= largest_translation * nearest)) return false;
  if (std::abs(*winding_at_centre_) > largest_winding) return false;
  search.columns = points_of(points);
  const double translation = search.pose.distance / nearest;
  search.form_bound =
      static_cast<float>((form_error + form_error_of_translation * translation) * (1 + 0x1p-20));
  return true;
}

void DirectionTable::penetrations(const PointBlocks& points, const Pose& X_FM, Penetrations& out,
                                  PenetrationWork* work) const {
  require_closed();
  out.clear();
  PenetrationSearch search;
  if (!begin(points, X_FM, search)) return penetrations_one_by_one(points, X_FM, out);

  const BlockColumns blocks = blocks_of(points, 0), groups = blocks_of(points, 1);
  RayScan scan(mesh_, *winding_at_centre_);
  constexpr std::size_t fan = PointBlocks::fan, groups_per_batch = blocks_per_batch / fan;
  constexpr std::size_t sets_per_batch = 16, few_groups = 4;
  std::array<std::uint32_t, sets_per_batch> set;
  std::array<std::uint32_t, sets_per_batch * fan + vector_room> near_group;
  std::array<std::uint32_t, blocks_per_batch + vector_room> near_block;
  const std::size_t set_count = (groups.count + fan - 1) / fan;
  for (std::size_t first_set = 0; first_set < set_count; first_set += sets_per_batch) {
    const std::size_t sets = std::min(sets_per_batch, set_count - first_set);
    for (std::size_t i = 0; i < sets; ++i) set[i] = static_cast<std::uint32_t>(first_set + i);
    // Of few groups hardly one is off the surface: asking them is not worth its time.
    std::size_t group_count = groups.count;
    if (groups.count <= few_groups) {
      std::iota(near_group.begin(), near_group.begin() + few_groups, 0u);
    } else {
      group_count = near_blocks(search.cube, groups, search.pose, set.data(), sets, near_group.data());
    }
    for (std::size_t first = 0; first < group_count; first += groups_per_batch) {
      const std::size_t group_last = std::min(first + groups_per_batch, group_count);
      const std::size_t count = near_blocks(search.cube, blocks, search.pose, near_group.data() + first,
                                            group_last - first, near_block.data());
      if (work) work->near_blocks += count;
      if (count == 0) continue;
      near_points(search.cube, search.columns, search.pose, near_block.data(), count, search.near);
      decide(points, X_FM, search, scan, out, work);
    }
  }
  if (work) work->blocks += blocks.count;
}

/// What becomes of the near points found.
void DirectionTable::decide(const PointBlocks& points, const Pose& X_FM, PenetrationSearch& search,
                            RayScan& scan, Penetrations& out, PenetrationWork* work) const {
  if (search.near.count == 0) return;
  const std::size_t tried = inside_points(search.cube, search.near, search.form_bound, search.found);
  finish(points, X_FM, search.found, scan, out);
  if (!work) return;
  work->near_points += search.near.count;
  work->triangles += tried;
  for (std::size_t i = 0; i < search.found.count; ++i) work->uncertain += search.found.point[i].doubtful;
}

void DirectionTable::penetrations(const PointBlocks& points, std::span<const Pose> X_FM,
                                  std::span<Penetrations> out) const {
  assert(out.size() == X_FM.size());
  require_closed();
  // A pose may take no more than a microsecond: some together are worth a task.
  constexpr std::size_t poses_per_task = 8;
  core::parallel_chunks(X_FM.size(), poses_per_task, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) penetrations(points, X_FM[i], out[i], nullptr);
  });
}

/// Ways to the planes of their triangles, of `count` points found from `first` on.
void DirectionTable::find_gaps(const PointBlocks& points, const Pose& X_FM, const FoundPoints& found,
                               std::size_t first, std::size_t count, GapColumns& out) const {
  constexpr std::size_t ahead = 16;
  constexpr ConeForms none{};  // what becomes of one in doubt is not asked for
  const Vec3* const all_points = &points[0];
  const ConeForms* const all_forms = lists_.forms.data();
  const auto sum = [](float high, float low) { return static_cast<double>(high) + static_cast<double>(low); };
  for (std::size_t i = 0; i < count; ++i) {
    const FoundPoint& at = found.point[first + i];
    __builtin_prefetch(all_points + found.point[std::min(first + i + ahead, found.count - 1)].point);
    const Vec3& p = all_points[at.point];
    const ConeForms& forms = at.doubtful ? none : all_forms[at.triangle];
    out.point[0][i] = p.x(), out.point[1][i] = p.y(), out.point[2][i] = p.z();
    out.normal[0][i] = sum(forms.x[3], forms.rest[0]);
    out.normal[1][i] = sum(forms.y[3], forms.rest[1]);
    out.normal[2][i] = sum(forms.z[3], forms.rest[2]);
  }
  out.count = count;
  gaps_to_planes(X_FM, out);
}

/// Depths in double; points in doubt from the start.
void DirectionTable::finish(const PointBlocks& points, const Pose& X_FM, const FoundPoints& found,
                            RayScan& scan, Penetrations& out) const {
  std::size_t count = out.size();
  out.resize(count + found.count);
  std::vector<Index> room;
  GapColumns gaps;
  for (std::size_t i = 0; i < found.count; ++i) {
    const std::size_t in_turn = i % GapColumns::size;
    if (in_turn == 0) find_gaps(points, X_FM, found, i, std::min(GapColumns::size, found.count - i), gaps);
    const FoundPoint& at = found.point[i];
    out.point[count] = points.index()[at.point];
    if (at.doubtful) {
      const Vec3 v = posed(X_FM, points[at.point]);
      const RayAnswer answer = scan.answer(v, candidates(v, room));
      if (answer.state == PointState::outside) continue;
      out.state[count] = answer.state;
      out.winding[count] = answer.winding;
      out.triangle[count] = answer.triangle;
      out.depth_mm[count] = std::abs(answer.gap);
      out.direction[count] = answer.direction;
    } else {
      double gap = gaps.gap[in_turn];
      if (std::isnan(gap))
        gap = distance_along_ray(posed(X_FM, points[at.point]), cone_of(mesh_, at.triangle));
      out.state[count] = PointState::inside;
      out.winding[count] = at.winding;
      out.triangle[count] = at.triangle;
      out.depth_mm[count] = std::abs(gap);
      out.direction[count] =
          at.away_from_centre ? RayDirection::away_from_centre : RayDirection::towards_centre;
    }
    ++count;
  }
  out.resize(count);
}

void DirectionTable::penetrations_one_by_one(const PointBlocks& points, const Pose& X_FM,
                                             Penetrations& out) const {
  RayScan scan(mesh_, *winding_at_centre_);
  FoundPoints all;
  for (std::size_t first = 0; first < points.size(); first += points_per_batch) {
    all.count = std::min(points_per_batch, points.size() - first);
    for (std::size_t i = 0; i < all.count; ++i) {
      all.point[i] = {static_cast<std::uint32_t>(first + i), no_index, 0, false, true};
    }
    finish(points, X_FM, all, scan, out);
  }
}

void DirectionTable::add_ray_to_normal(PointsView points, const Pose& X_FM, Penetrations& out) const {
  out.ray_to_normal.resize(out.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Index t = out.triangle[i];
    out.ray_to_normal[i] =
        t == no_index ? Angle() : angle_to_normal(posed(X_FM, points[out.point[i]]), cone_of(mesh_, t));
  }
}

}  // namespace condyle::radial
