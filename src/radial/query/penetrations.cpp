#include "radial/query/penetrations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.hpp"
#include "radial/exact/triangle_plane.hpp"
#include "radial/query/penetration_search.hpp"
#include "radial/radial_table.hpp"

namespace condyle {
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

radial::FloatPose radial::float_pose(const Pose& X, const Vec3& centre) {
  radial::FloatPose pose{};
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

radial::BlockColumns radial::blocks_of(const SortedPoints& points, std::size_t level) {
  const auto column = [&](SortedPoints::Column c) { return points.block(level, c); };
  using P = SortedPoints;
  return {column(P::axis_x),       column(P::axis_y),  column(P::axis_z),
          column(P::chord),        column(P::nearest), column(P::furthest),
          column(P::mean_inverse), column(P::spread),  points.block_count(level)};
}

radial::PointColumns points_of(const SortedPoints& points) {
  return {points.coordinate(0), points.coordinate(1), points.coordinate(2), points.size()};
}

void Penetrations::clear() {
  resize(0);
  ray_to_normal.clear();
}

void Penetrations::resize(std::size_t count) {
  point.resize(count), state.resize(count), winding.resize(count);
  triangle.resize(count), depth.resize(count), direction.resize(count);
}

bool RadialTable::begin(const SortedPoints& points, const Pose& X_FM,
                        radial::PenetrationSearch& search) const {
  const auto* map = std::get_if<radial::CubeMap>(&map_);
  if (!map || mesh_.triangles.empty() || !is_rotation(X_FM)) return false;
  search.pose = radial::float_pose(X_FM, points.centre());
  search.cube = view_of(*map);
  const double nearest = std::sqrt(lists_.least_squared), furthest = std::sqrt(lists_.greatest_squared);
  const bool in_range =
      nearest > least_length && furthest < greatest_length && points.reach() < greatest_length;
  if (!in_range || !(search.pose.distance <= radial::largest_translation * nearest)) return false;
  if (std::abs(*winding_at_centre_) > largest_winding) return false;
  search.columns = points_of(points);
  const double translation = search.pose.distance / nearest;
  search.form_bound = static_cast<float>(
      (radial::form_error + radial::form_error_of_translation * translation) * (1 + 0x1p-20));
  return true;
}

void RadialTable::penetrations(const SortedPoints& points, const Pose& X_FM, Penetrations& out,
                               PenetrationWork* work) const {
  require_closed();
  out.clear();
  radial::PenetrationSearch search;
  if (!begin(points, X_FM, search)) return penetrations_one_by_one(points, X_FM, out);

  const radial::BlockColumns blocks = radial::blocks_of(points, 0), groups = radial::blocks_of(points, 1);
  radial::RayScan scan(mesh_, *winding_at_centre_);
  constexpr std::size_t fan = SortedPoints::fan, groups_per_batch = radial::blocks_per_batch / fan;
  constexpr std::size_t sets_per_batch = 16, few_groups = 4;
  std::array<std::uint32_t, sets_per_batch> set;
  std::array<std::uint32_t, sets_per_batch * fan + radial::vector_room> near_group;
  std::array<std::uint32_t, radial::blocks_per_batch + radial::vector_room> near_block;
  const std::size_t set_count = (groups.count + fan - 1) / fan;
  for (std::size_t first_set = 0; first_set < set_count; first_set += sets_per_batch) {
    const std::size_t sets = std::min(sets_per_batch, set_count - first_set);
    for (std::size_t i = 0; i < sets; ++i) set[i] = static_cast<std::uint32_t>(first_set + i);
    // Of few groups hardly one is off the surface: asking them is not worth its time.
    std::size_t group_count = groups.count;
    if (groups.count <= few_groups) {
      std::iota(near_group.begin(), near_group.begin() + few_groups, 0u);
    } else {
      group_count =
          radial::near_blocks(search.cube, groups, search.pose, set.data(), sets, near_group.data());
    }
    for (std::size_t first = 0; first < group_count; first += groups_per_batch) {
      const std::size_t group_last = std::min(first + groups_per_batch, group_count);
      const std::size_t count = radial::near_blocks(
          search.cube, blocks, search.pose, near_group.data() + first, group_last - first, near_block.data());
      if (work) work->near_blocks += count;
      if (count == 0) continue;
      radial::near_points(search.cube, search.columns, search.pose, near_block.data(), count, search.near);
      decide(points, X_FM, search, scan, out, work);
    }
  }
  if (work) work->blocks += blocks.count;
}

/// What becomes of the near points found.
void RadialTable::decide(const SortedPoints& points, const Pose& X_FM, radial::PenetrationSearch& search,
                         radial::RayScan& scan, Penetrations& out, PenetrationWork* work) const {
  if (search.near.count == 0) return;
  const std::size_t tried = radial::inside_points(search.cube, search.near, search.form_bound, search.found);
  finish(points, X_FM, search.found, scan, out);
  if (!work) return;
  work->near_points += search.near.count;
  work->triangles += tried;
  for (std::size_t i = 0; i < search.found.count; ++i) work->doubtful += search.found.point[i].doubtful;
}

void RadialTable::penetrations(const SortedPoints& points, std::span<const Pose> X_FM,
                               std::span<Penetrations> out) const {
  assert(out.size() == X_FM.size());
  require_closed();
  // A pose may take no more than a microsecond: some together are worth a task.
  constexpr std::size_t poses_per_task = 8;
  core::parallel_chunks(X_FM.size(), poses_per_task, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) penetrations(points, X_FM[i], out[i]);
  });
}

/// Ways to the planes of their triangles, of `count` points found from `first` on.
void RadialTable::find_gaps(const SortedPoints& points, const Pose& X_FM, const radial::FoundPoints& found,
                            std::size_t first, std::size_t count, radial::GapColumns& out) const {
  constexpr std::size_t ahead = 16;
  constexpr radial::ConeForms none{};  // what becomes of one in doubt is not asked for
  const Vec3* const all_points = &points[0];
  const radial::ConeForms* const all_forms = lists_.forms.data();
  const auto sum = [](float high, float low) { return static_cast<double>(high) + static_cast<double>(low); };
  for (std::size_t i = 0; i < count; ++i) {
    const radial::FoundPoint& at = found.point[first + i];
    __builtin_prefetch(all_points + found.point[std::min(first + i + ahead, found.count - 1)].point);
    const Vec3& p = all_points[at.point];
    const radial::ConeForms& forms = at.doubtful ? none : all_forms[at.triangle];
    out.point[0][i] = p.x(), out.point[1][i] = p.y(), out.point[2][i] = p.z();
    out.normal[0][i] = sum(forms.x[3], forms.rest[0]);
    out.normal[1][i] = sum(forms.y[3], forms.rest[1]);
    out.normal[2][i] = sum(forms.z[3], forms.rest[2]);
  }
  out.count = count;
  radial::gaps_to_planes(X_FM, out);
}

/// Depths in double; points in doubt from the start.
void RadialTable::finish(const SortedPoints& points, const Pose& X_FM, const radial::FoundPoints& found,
                         radial::RayScan& scan, Penetrations& out) const {
  std::size_t count = out.size();
  out.resize(count + found.count);
  std::vector<Index> room;
  radial::GapColumns gaps;
  for (std::size_t i = 0; i < found.count; ++i) {
    const std::size_t in_turn = i % radial::GapColumns::size;
    if (in_turn == 0)
      find_gaps(points, X_FM, found, i, std::min(radial::GapColumns::size, found.count - i), gaps);
    const radial::FoundPoint& at = found.point[i];
    out.point[count] = points.index()[at.point];
    if (at.doubtful) {
      const Vec3 v = posed(X_FM, points[at.point]);
      const radial::RayAnswer answer = scan.answer(v, candidates(v, room));
      if (answer.state == PointState::outside) continue;
      out.state[count] = answer.state;
      out.winding[count] = answer.winding;
      out.triangle[count] = answer.triangle;
      out.depth[count] = std::abs(answer.gap);
      out.direction[count] = answer.direction;
    } else {
      double gap = gaps.gap[in_turn];
      if (std::isnan(gap))
        gap = radial::distance_along_ray(posed(X_FM, points[at.point]), radial::cone_of(mesh_, at.triangle));
      out.state[count] = PointState::inside;
      out.winding[count] = at.winding;
      out.triangle[count] = at.triangle;
      out.depth[count] = std::abs(gap);
      out.direction[count] =
          at.away_from_centre ? radial::RayDirection::away_from_centre : radial::RayDirection::towards_centre;
    }
    ++count;
  }
  out.resize(count);
}

void RadialTable::penetrations_one_by_one(const SortedPoints& points, const Pose& X_FM,
                                          Penetrations& out) const {
  radial::RayScan scan(mesh_, *winding_at_centre_);
  radial::FoundPoints all;
  for (std::size_t first = 0; first < points.size(); first += radial::points_per_batch) {
    all.count = std::min(radial::points_per_batch, points.size() - first);
    for (std::size_t i = 0; i < all.count; ++i) {
      all.point[i] = {static_cast<std::uint32_t>(first + i), no_index, 0, false, true};
    }
    finish(points, X_FM, all, scan, out);
  }
}

void RadialTable::add_ray_to_normal(PointsView points, const Pose& X_FM, Penetrations& out) const {
  out.ray_to_normal.resize(out.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Index t = out.triangle[i];
    out.ray_to_normal[i] =
        t == no_index ? 0
                      : radial::angle_to_normal(posed(X_FM, points[out.point[i]]), radial::cone_of(mesh_, t));
  }
}

}  // namespace condyle
