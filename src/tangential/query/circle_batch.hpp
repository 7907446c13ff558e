#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "condyle/pose.hpp"
#include "condyle/tangential.hpp"
#include "core/uninitialised.hpp"
#include "tangential/build/rings.hpp"
#include "tangential/query/circle_cells.hpp"
#include "tangential/query/classify_crossings.hpp"
#include "tangential/query/gather_candidates.hpp"

namespace condyle::tangential {

/// Some points, their circles and where these cross the surface. Reused from batch to batch, so that points
/// allocate nothing.
class CircleBatch {
 public:
  /// Points taken together: enough that starting with the next ones costs next to nothing, few enough that
  /// everything about them stays in the processor's nearer caches.
  static constexpr std::size_t most = 1024;

  explicit CircleBatch(const Rings& rings) : rings_(rings) {}

  /// Finds all crossings of the circles of these points, at most `most`.
  void find_crossings(PointsView points);

  /// The circles within the grid. Points without one are outside, and no rotation changes that.
  const LocatedCircles& circles() const noexcept { return circles_; }

  /// The point of one circle, classified.
  struct Classified {
    PointState state;
    int winding;     ///< Just ahead of the point.
    Index triangle;  ///< One that holds the point.
    std::span<const CircleCrossing> crossings;
  };
  Classified classify(std::size_t circle);

  /// Crossings of one circle, in order.
  std::span<const CircleCrossing> crossings_of(std::size_t circle);

  /// At least as many as the circles have arcs: one for two crossings, or a whole turn.
  std::size_t most_arcs() const noexcept { return crossing_count_ / 2 + circles_.size(); }

  const TangentialWork& work() const noexcept { return work_; }

 private:
  void prefetch_lists();
  void evaluate_pairs();
  void collect_crossings();
  void decide_exactly(std::size_t circle, Index triangle);
  int winding_ahead_of(std::size_t circle, bool on_surface, std::span<const CircleCrossing> crossings);
  std::size_t begin_of(std::size_t circle) const noexcept { return circle == 0 ? 0 : end_[circle - 1]; }

  const Rings& rings_;
  LocatedCircles circles_;
  CandidatePairs pairs_;
  ClassifiedPairs classified_;
  /// Crossings of circle i are [end_[i - 1], end_[i]).
  core::UninitialisedVector<CircleCrossing> crossing_;
  std::size_t crossing_count_ = 0;
  std::array<std::size_t, most> end_;
  std::array<Index, most> holding_;  ///< The first triangle that holds the point.
  std::vector<CircleCrossing> exact_;
  TangentialWork work_;
};

}  // namespace condyle::tangential
