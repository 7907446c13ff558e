#include "accuracy.hpp"

#include <algorithm>
#include <cmath>

namespace bench {

InsideAccuracy& InsideAccuracy::operator+=(const InsideAccuracy& more) {
  inside += more.inside;
  false_inside += more.false_inside, false_outside += more.false_outside;
  depths += more.depths, depths_off += more.depths_off;
  depth_error_sum_mm += more.depth_error_sum_mm;
  depth_error_max_mm = std::max(depth_error_max_mm, more.depth_error_max_mm);
  return *this;
}

TouchAccuracy& TouchAccuracy::operator+=(const TouchAccuracy& more) {
  poses += more.poses, touching += more.touching;
  missed += more.missed, invented += more.invented;
  return *this;
}

PairAccuracy& PairAccuracy::operator+=(const PairAccuracy& more) {
  pairs += more.pairs;
  missed += more.missed, invented += more.invented;
  return *this;
}

void compare(std::vector<InsideVertex>& answer, Reference& reference, std::size_t pose, DepthKind kind,
             InsideAccuracy& accuracy) {
  std::sort(answer.begin(), answer.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
  const auto& truth = reference.inside(pose);
  const auto& depths = reference.depths(pose, kind);
  auto reported = answer.begin();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (; reported != answer.end() && reported->vertex < truth[i].vertex; ++reported)
      ++accuracy.false_inside;
    const bool is_reported = reported != answer.end() && reported->vertex == truth[i].vertex;
    if (!truth[i].is_on_surface) {
      ++accuracy.inside;
      if (!is_reported) ++accuracy.false_outside;
    }
    if (!is_reported) continue;
    if (kind != DepthKind::none && !std::isnan(reported->depth_mm)) {
      // An endless depth (a circle that is solid all round) is right where the true one is endless too.
      const double error = reported->depth_mm == depths[i] ? 0 : std::abs(reported->depth_mm - depths[i]);
      ++accuracy.depths;
      if (error > wrong_depth_mm) ++accuracy.depths_off;
      accuracy.depth_error_sum_mm += error;
      accuracy.depth_error_max_mm = std::max(accuracy.depth_error_max_mm, error);
    }
    ++reported;
  }
  accuracy.false_inside += answer.end() - reported;
}

void compare(std::vector<condyle::contact::TrianglePair>& answer, Reference& reference, std::size_t pose,
             PairAccuracy& accuracy) {
  std::sort(answer.begin(), answer.end());
  answer.erase(std::unique(answer.begin(), answer.end()), answer.end());
  const auto& truth = reference.pairs(pose);
  std::vector<condyle::contact::TrianglePair> both;
  std::set_intersection(answer.begin(), answer.end(), truth.begin(), truth.end(), std::back_inserter(both));
  accuracy.pairs += static_cast<std::int64_t>(truth.size());
  accuracy.missed += static_cast<std::int64_t>(truth.size() - both.size());
  accuracy.invented += static_cast<std::int64_t>(answer.size() - both.size());
}

void compare(bool touches, Reference& reference, std::size_t pose, TouchAccuracy& accuracy) {
  const bool truth = !reference.pairs(pose).empty();
  ++accuracy.poses;
  if (truth) ++accuracy.touching;
  if (truth && !touches) ++accuracy.missed;
  if (!truth && touches) ++accuracy.invented;
}

}  // namespace bench
