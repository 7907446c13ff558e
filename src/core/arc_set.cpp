#include "core/arc_set.hpp"

#include <algorithm>

#include "core/wrapped_angle.hpp"

namespace condyle::core {

ArcSet::ArcSet(const std::vector<Arc>& arcs) {
  std::vector<Interval> intervals;
  for (const Arc& arc : arcs) append(arc, intervals);
  intervals_ = merged(std::move(intervals));
}

ArcSet ArcSet::full_turn() {
  return ArcSet({{Angle(), Angle::radians(two_pi)}});
}

void ArcSet::append(const Arc& arc, std::vector<Interval>& to) {
  const double width = arc.width.radians();
  if (width >= two_pi) {
    to.push_back({0, two_pi});
    return;
  }
  const double low = wrapped(arc.start.radians()), high = low + width;
  to.push_back({low, std::min(high, two_pi)});
  if (high >= two_pi) to.push_back({0, high - two_pi});
}

std::vector<ArcSet::Interval> ArcSet::merged(std::vector<Interval> intervals) {
  std::sort(intervals.begin(), intervals.end());
  std::vector<Interval> out;
  for (const Interval& s : intervals) {
    if (!out.empty() && s.low <= out.back().high) {
      out.back().high = std::max(out.back().high, s.high);
    } else {
      out.push_back(s);
    }
  }
  // 0 and 2 pi are one direction.
  if (!out.empty() && out.back().high == two_pi && out.front().low > 0) out.insert(out.begin(), {0, 0});
  if (!out.empty() && out.front().low == 0 && out.back().high < two_pi) out.push_back({two_pi, two_pi});
  return out;
}

bool ArcSet::is_full_turn() const noexcept {
  return intervals_.size() == 1 && intervals_[0] == Interval{0, two_pi};
}

Angle ArcSet::measure() const noexcept {
  double sum = 0;
  for (const auto& [low, high] : intervals_) sum += high - low;
  return Angle::radians(sum);
}

std::vector<Arc> ArcSet::arcs() const {
  std::vector<Arc> out;
  const bool across_zero = intervals_.size() > 1 && intervals_.front().low == 0;
  for (std::size_t i = across_zero ? 1 : 0; i < intervals_.size(); ++i) {
    const auto& [low, high] = intervals_[i];
    out.push_back({Angle::radians(low), Angle::radians(high - low)});
  }
  if (across_zero) {
    Arc& last = out.back();
    last.width = last.width + Angle::radians(intervals_.front().high);
    if (last.start.radians() == two_pi) last.start = Angle();
  }
  return out;
}

bool ArcSet::holds(const Interval& interval) const noexcept {
  const auto after = std::upper_bound(intervals_.begin(), intervals_.end(), interval.low,
                                      [](double low, const Interval& s) { return low < s.low; });
  return after != intervals_.begin() && interval.high <= std::prev(after)->high;
}

bool ArcSet::contains(Angle direction) const noexcept {
  const double at = wrapped(direction.radians());
  return holds({at, at});
}

bool ArcSet::contains(const Arc& arc) const noexcept {
  if (arc.width.radians() >= two_pi) return is_full_turn();
  const double low = wrapped(arc.start.radians()), high = low + arc.width.radians();
  return high < two_pi ? holds({low, high}) : holds({low, two_pi}) && holds({0, high - two_pi});
}

ArcSet ArcSet::united(const ArcSet& other) const {
  ArcSet out;
  std::vector<Interval> all = intervals_;
  all.insert(all.end(), other.intervals_.begin(), other.intervals_.end());
  out.intervals_ = merged(std::move(all));
  return out;
}

ArcSet ArcSet::complement() const {
  std::vector<Interval> between;
  double from = 0;
  for (const auto& [low, high] : intervals_) {
    if (low > from) between.push_back({from, low});
    from = high;
  }
  if (from < two_pi) between.push_back({from, two_pi});
  ArcSet out;
  out.intervals_ = merged(std::move(between));
  return out;
}

}  // namespace condyle::core
