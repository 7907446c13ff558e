#include "radial/query/penetration_track.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radial/query/penetration_search.hpp"

namespace condyle::radial {
namespace {

/// After that much turning all is asked anew: until then floats hold the way to 1e-6, less than is left to
/// reaches.
constexpr double furthest_turn = 8;

/// Chord for which blocks far from the surface are let go, six degrees: longer ones let fewer go, and with
/// shorter ones the motion comes back to them sooner.
constexpr float stride = 0.1f;

/// A centre that is off by so much of the nearest radius moves no point out of the margins of the radii.
constexpr double centred = 0x1p-20;

/// How far two rotations that are ones to 1e-6 may take a unit vector apart: for exact ones |R - S| is
/// sqrt(2) times the chord.
double chord_between(const Pose& R, const Pose& S) {
  return (R.linear() - S.linear()).norm() / std::numbers::sqrt2 + 4e-6;
}

/// Displacement w on a face, of a direction that moves by a chord c: at most c L sqrt(1 + m^2) / (1 - c L),
/// with L up to sqrt(3) and the larger coordinate m up to 1. Solved for c, and a bit less for rounding.
float reach_of_width(double width) {
  return static_cast<float>((1 - 0x1p-5) * width / (std::sqrt(6.0) + std::sqrt(3.0) * width));
}

}  // namespace

PenetrationTrack::PenetrationTrack(const RadialTable& table, const SortedPoints& points)
    : table_(table), points_(points), last_(Pose::Identity()) {
  table.require_closed();
  const int cells = table.cube_cells_per_side();
  for (int k = 0; cells > 0 && k < DirectionPyramid::step_count(cells); ++k) {
    const double piece = 2.0 / (cells >> DirectionPyramid::level_of(k));
    reach_.push_back(reach_of_width(DirectionPyramid::border_of(k) * piece));
  }
  const std::size_t blocks = points.block_count(0);
  free_until_.resize(blocks + vector_room);
  step_.resize(blocks);
  forget();
}

void PenetrationTrack::forget() {
  turned_ = 0;
  std::fill(free_until_.begin(), free_until_.end(), -1.0f);
}

void PenetrationTrack::turn_to(const Pose& X_FM) {
  turned_ += chord_between(X_FM, last_);
  last_ = X_FM;
  if (!(turned_ < furthest_turn)) forget();
}

void PenetrationTrack::penetrations(const Pose& X_FM, Penetrations& out, PenetrationWork* work) {
  PenetrationSearch search;
  const bool searching = table_.begin(points_, X_FM, search);
  const double distance = searching ? search.pose.distance : 0;
  if (!searching || distance > centred * std::sqrt(search.cube.nearest_squared)) {
    forget();
    return table_.penetrations(points_, X_FM, out, work);
  }
  turn_to(X_FM);
  out.clear();
  RayScan scan(table_.mesh(), *table_.winding_at_centre());
  const std::size_t blocks = points_.block_count(0);
  BlockMemory memory{static_cast<float>(turned_),
                     free_until_.data(),
                     step_.data(),
                     reach_.data(),
                     static_cast<int>(reach_.size()),
                     stride};
  const BlockColumns columns = blocks_of(points_, 0);
  std::array<std::uint32_t, blocks_per_batch + vector_room> asked;
  for (std::size_t first = 0; first < blocks; first += blocks_per_batch) {
    const std::size_t last = std::min(first + blocks_per_batch, blocks);
    const std::size_t count =
        blocks_to_ask(search.cube, columns, search.pose, memory, first, last, asked.data());
    if (count == 0) continue;
    near_points_remembered(search.cube, search.columns, search.pose, asked.data(), count, memory,
                           search.near);
    if (work) work->near_blocks += count;
    table_.decide(points_, X_FM, search, scan, out, work);
  }
  if (work) work->blocks += blocks;
}

}  // namespace condyle::radial
